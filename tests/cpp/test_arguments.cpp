// Arguments of runs that are refused: options, times, states, tables and functions of tension.
#include <doctest/doctest.h>

#include <functional>
#include <limits>

#include "cdcr/simulate.hpp"
#include "support/cases.hpp"
#include "support/runs.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();
using Interpolation = CommandInput::Interpolation;

void check_option(const std::function<void(Options&)>& change, const char* sentence) {
  Options options;
  change(options);
  CHECK_THROWS_SENTENCE(validate(options), sentence);
  // And in a run.
  const Model model(amouri2020());
  CHECK_THROWS_SENTENCE(
      simulate(model, VectorXd::Zero(2), VectorXd::Zero(2), even_times(0.0, 1.0, 2),
               no_tension(model), Method::dopri5, options),
      sentence);
}

void check_run(const VectorXd& q, const VectorXd& qd, const VectorXd& times,
               const CommandInput& input, const char* sentence) {
  const Model model(amouri2020());
  CHECK_THROWS_SENTENCE(simulate(model, q, qd, times, input), sentence);
}

const Eigen::Vector2d zero(0.0, 0.0);
const Eigen::Vector2d second(0.0, 1.0);
CommandInput none() {
  return CommandInput::constant(VectorXd::Zero(3));
}

TEST_SUITE_BEGIN("arguments");

TEST_CASE("options") {
  CHECK_NOTHROW(validate(Options()));
  check_option([](Options& o) { o.rtol = 1e-15; },
               "rtol must be at least 1e-14 and below 1, got 1e-15");
  check_option([](Options& o) { o.rtol = 1.0; }, "rtol must be at least 1e-14 and below 1, got 1");
  check_option([](Options& o) { o.rtol = nan; },
               "rtol must be at least 1e-14 and below 1, got nan");
  check_option([](Options& o) { o.atol = 0.0; }, "atol must be > 0 and finite, got 0");
  check_option([](Options& o) { o.atol = inf; }, "atol must be > 0 and finite, got inf");
  check_option([](Options& o) { o.step = 0.0; }, "step must be > 0 s and finite, got 0");
  check_option([](Options& o) { o.step = nan; }, "step must be > 0 s and finite, got nan");
  check_option([](Options& o) { o.max_step = -1.0; },
               "max_step must be >= 0 s and finite (0: no limit), got -1");
  check_option([](Options& o) { o.max_steps = 0; }, "max_steps must be at least 1, got 0");
}

TEST_CASE("methods of CVODE are not in this library") {
  const Model model(amouri2020());
  for (const Method method : {Method::bdf, Method::adams}) {
    CHECK_THROWS_SENTENCE(simulate(model, zero, zero, second, none(), method),
                          "methods bdf and adams are made by make_cvode_integrator of "
                          "cdcr/cvode.hpp");
  }
}

TEST_CASE("states") {
  check_run(Eigen::Vector3d::Zero(), zero, second, none(),
            "q0 must be 2 finite values, got [0 0 0]");
  check_run(Eigen::Vector2d(nan, 0.0), zero, second, none(),
            "q0 must be 2 finite values, got [nan   0]");
  check_run(zero, VectorXd(0), second, none(), "qd0 must be 2 finite values, got []");
  check_run(zero, Eigen::Vector2d(0.0, inf), second, none(),
            "qd0 must be 2 finite values, got [  0 inf]");
  check_run(Eigen::Vector2d(0.0, -9.5), zero, second, none(),
            "q0 must bend each section by at most 3 pi rad, got 9.5 rad in section 1");
}

TEST_CASE("times") {
  check_run(zero, zero, VectorXd(0), none(), "t must hold at least one time, got none");
  check_run(zero, zero, Eigen::Vector3d(0.0, 1.0, 1.0), none(),
            "t must be finite and strictly increasing, got 1 s at index 2 after 1 s");
  check_run(zero, zero, Eigen::Vector2d(0.0, -1.0), none(),
            "t must be finite and strictly increasing, got -1 s at index 1 after 0 s");
  check_run(zero, zero, Eigen::Vector2d(nan, 1.0), none(),
            "t must be finite and strictly increasing, got nan s at index 0");
  check_run(zero, zero, Eigen::Vector2d(0.0, inf), none(),
            "t must be finite and strictly increasing, got inf s at index 1 after 0 s");
}

TEST_CASE("constant tensions") {
  CHECK_THROWS_SENTENCE(
      CommandInput::constant(Eigen::Vector3d(0.0, -5.0, 0.0)),
      "tension[1] (cable 2) must be finite and >= 0 N (a cable cannot push), got -5");
  CHECK_THROWS_SENTENCE(
      CommandInput::constant(Eigen::Vector3d(nan, 0.0, 0.0)),
      "tension[0] (cable 1) must be finite and >= 0 N (a cable cannot push), got nan");
  CHECK_THROWS_SENTENCE(
      CommandInput::constant(Eigen::Vector3d(0.0, 0.0, inf)),
      "tension[2] (cable 3) must be finite and >= 0 N (a cable cannot push), got inf");
  check_run(zero, zero, second, CommandInput::constant(VectorXd::Zero(2)),
            "tension must have one value for each of the 3 cables, got 2");
}

TEST_CASE("tables of tension") {
  const MatrixXd ones = MatrixXd::Ones(2, 3);
  CHECK_THROWS_SENTENCE(
      CommandInput::table(VectorXd::Zero(3), ones, Interpolation::linear),
      "a tension table needs one row of values for each time, got 3 times and 2 rows");
  CHECK_THROWS_SENTENCE(
      CommandInput::table(VectorXd(0), MatrixXd(0, 3), Interpolation::linear),
      "a tension table needs one row of values for each time, got 0 times and 0 rows");
  CHECK_THROWS_SENTENCE(
      CommandInput::table(Eigen::Vector2d(1.0, 1.0), ones, Interpolation::previous),
      "the times of a tension table must be finite and strictly increasing, got 1 s at index 1 "
      "after 1 s");
  CHECK_THROWS_SENTENCE(
      CommandInput::table(Eigen::Vector2d(nan, 1.0), ones, Interpolation::previous),
      "the times of a tension table must be finite and strictly increasing, got nan s at index 0");
  MatrixXd pushing = ones;
  pushing(1, 2) = -0.5;
  CHECK_THROWS_SENTENCE(
      CommandInput::table(second, pushing, Interpolation::linear),
      "tension[1, 2] (cable 3) must be finite and >= 0 N (a cable cannot push), got -0.5");
  check_run(zero, zero, second,
            CommandInput::table(second, MatrixXd::Ones(2, 4), Interpolation::linear),
            "tension must have one value for each of the 3 cables, got 4");
}

TEST_CASE("functions of tension") {
  const auto law = [](double, const ConstVectorRef&, const ConstVectorRef&, VectorRef) {};
  CHECK_THROWS_SENTENCE(CommandInput::function(nullptr, 3), "the tension function is empty");
  CHECK_THROWS_SENTENCE(CommandInput::function(law, 3, {0.5, 0.25}),
                        "break_points must be finite and strictly increasing, got 0.25 s at index "
                        "1 after 0.5 s");
  check_run(zero, zero, second, CommandInput::function(law, 1),
            "tension must have one value for each of the 3 cables, got 1");
}

TEST_CASE("segments of an input") {
  const CommandInput table = CommandInput::table(Eigen::Vector3d(0.0, 1.0, 2.0),
                                                 MatrixXd::Ones(3, 1), Interpolation::previous);
  CHECK(table.num_cables() == 1);
  CHECK(table.break_points().size() == 3);
  CHECK(table.segment(-0.1) == 0);
  CHECK(table.segment(0.0) == 1);
  CHECK(table.segment(1.999) == 2);
  CHECK(table.segment(2.0) == 3);
  CHECK(none().break_points().empty());
  CHECK(none().segment(123.0) == 0);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
