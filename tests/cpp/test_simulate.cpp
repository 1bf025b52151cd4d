// Runs: where they stop, what they sample, what the inputs do to them.
#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "cdcr/simulate.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

using Interpolation = CommandInput::Interpolation;

const Eigen::Vector2d q_start(0.5, -0.2), qd_start(0.0, 1.0);
const std::vector<Method> own_methods = {Method::dopri5, Method::dop853, Method::rk4};

Model upright() {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  return Model(robot);
}

Trajectory run_of(const Model& model, const VectorXd& times, const CommandInput& input,
                  Method method, const Options& options = {}) {
  const Trajectory run = simulate(model, q_start, qd_start, times, input, method, options);
  REQUIRE(run.status == Status::ok);
  CHECK(run.message.empty());
  CHECK(run.t == times);
  return run;
}

VectorXd last_row(const RowMatrixXd& rows) {
  return rows.row(rows.rows() - 1).transpose();
}

TEST_SUITE_BEGIN("simulate");

TEST_CASE("the first sample is the initial state and a single time is a run") {
  const Model model = upright();
  for (const Method method : own_methods) {
    const Trajectory run = run_of(model, VectorXd::Constant(1, 3.0), no_tension(model), method);
    CHECK(run.q.row(0).transpose() == q_start);
    CHECK(run.qd.row(0).transpose() == qd_start);
    CHECK(run.stats.steps == 0);
  }
}

TEST_CASE("a run does not depend on where it is sampled, to the last bit") {
  const Model model = upright();
  MatrixXd rows = MatrixXd::Zero(2, 3);
  rows(1, 2) = 4.0;
  const CommandInput table =
      CommandInput::table(Eigen::Vector2d(0.0, 0.7071), rows, Interpolation::previous);
  for (const Method method : own_methods) {
    const Trajectory coarse = run_of(model, even_times(0.0, 2.0, 5), table, method);
    const Trajectory fine = run_of(model, even_times(0.0, 2.0, 4001), table, method);
    CHECK(coarse.stats.steps == fine.stats.steps);
    if (method == Method::dop853) {  // three more in each step that is sampled
      CHECK(coarse.stats.evaluations < fine.stats.evaluations);
    } else {
      CHECK(coarse.stats.evaluations == fine.stats.evaluations);
    }
    for (Index i = 0; i < 5; ++i) {
      CHECK(coarse.q.row(i) == fine.q.row(1000 * i));
      CHECK(coarse.qd.row(i) == fine.qd.row(1000 * i));
    }
  }
}

TEST_CASE("a run does not depend on when it starts") {
  const Model model = upright();
  const VectorXd times = even_times(0.0, 1.0, 9);  // exact in binary, so are the later times
  for (const Method method : own_methods) {
    const Trajectory now = run_of(model, times, no_tension(model), method);
    const Trajectory later =
        run_of(model, times + VectorXd::Constant(9, 8.0), no_tension(model), method);
    CHECK(residual(later.q, now.q) <= tolerance::run);
  }
}

TEST_CASE("a jump in a table is hit exactly: the run goes on as one that starts there") {
  const Model model = upright();
  const double jump = 0.31830988;
  MatrixXd rows(2, 3);
  rows << 3.0, 0.0, 1.0, 0.0, 6.0, 0.0;
  const CommandInput table =
      CommandInput::table(Eigen::Vector2d(0.0, jump), rows, Interpolation::previous);
  for (const Method method : own_methods) {
    const Trajectory whole = run_of(model, Eigen::Vector3d(0.0, jump, 1.0), table, method);
    const Trajectory before =
        run_of(model, Eigen::Vector2d(0.0, jump), CommandInput::constant(rows.row(0)), method);
    const Trajectory after =
        simulate(model, last_row(before.q), last_row(before.qd), Eigen::Vector2d(jump, 1.0),
                 CommandInput::constant(rows.row(1)), method);
    CHECK(whole.q.row(1) == before.q.row(1));
    CHECK(residual(whole.q.row(2), after.q.row(1)) <= tolerance::run);
    CHECK(residual(whole.qd.row(2), after.qd.row(1)) <= tolerance::run);
    CHECK(whole.tension.row(0) == rows.row(0));
    CHECK(whole.tension.row(1) == rows.row(1));  // at a jump, the value after it
  }
}

TEST_CASE("before its first time a table holds its first row, after its last its last") {
  const Model model = upright();
  MatrixXd rows(2, 3);
  rows << 2.0, 0.0, 0.0, 2.0, 0.0, 0.0;
  for (const Interpolation interpolation : {Interpolation::previous, Interpolation::linear}) {
    const CommandInput table = CommandInput::table(Eigen::Vector2d(0.25, 0.5), rows, interpolation);
    const Trajectory run =
        run_of(model, even_times(0.0, 1.0, 9), table, Method::dopri5, tightest());
    const Trajectory constant =
        run_of(model, even_times(0.0, 1.0, 9), CommandInput::constant(rows.row(0)), Method::dopri5,
               tightest());
    CHECK(residual(run.q, constant.q) <= tolerance::run);
    CHECK(run.tension == constant.tension);
  }
}

TEST_CASE("tables give the tensions they say") {
  const Model model = upright();
  MatrixXd rows(2, 3);
  rows << 1.0, 0.0, 4.0, 3.0, 2.0, 0.0;
  const VectorXd times = even_times(0.0, 1.0, 5);
  const Eigen::Vector2d breaks(0.0, 1.0);
  const Trajectory held = run_of(
      model, times, CommandInput::table(breaks, rows, Interpolation::previous), Method::dopri5);
  const Trajectory ramp = run_of(
      model, times, CommandInput::table(breaks, rows, Interpolation::linear), Method::dopri5);
  for (Index i = 0; i < 5; ++i) {
    CHECK(held.tension.row(i) == rows.row(i < 4 ? 0 : 1));
    const double share = 0.25 * static_cast<double>(i);
    const VectorXd expected = (1.0 - share) * rows.row(0) + share * rows.row(1);
    CHECK(residual(ramp.tension.row(i).transpose(), expected) <= tolerance::rounding);
  }
}

TEST_CASE("a linear table equals the function it draws") {
  const Model model = upright();
  MatrixXd rows(3, 3);
  rows << 0.0, 1.0, 0.0, 5.0, 0.0, 0.0, 0.0, 0.0, 2.0;
  const Eigen::Vector3d breaks(0.1, 0.4, 0.9);
  const auto tent = [&](double t, const ConstVectorRef&, const ConstVectorRef&, VectorRef F) {
    const Index from = t < 0.4 ? 0 : 1;
    double share = (t - breaks[from]) / (breaks[from + 1] - breaks[from]);
    share = std::fmin(std::fmax(share, 0.0), 1.0);
    F = (1.0 - share) * rows.row(from) + share * rows.row(from + 1);
  };
  const VectorXd times = even_times(0.0, 1.2, 25);
  const Trajectory table =
      run_of(model, times, CommandInput::table(breaks, rows, Interpolation::linear), Method::dopri5,
             tightest());
  const Trajectory function = run_of(model, times, CommandInput::function(tent, 3, {0.1, 0.4, 0.9}),
                                     Method::dopri5, tightest());
  CHECK(residual(function.q, table.q) <= tolerance::run);
}

TEST_CASE("a function of time and state drives the robot, feedback included") {
  const Model model = upright();
  const Eigen::Vector3d constant(2.0, 1.0, 0.0);
  double last_time = -1.0;
  const auto recorded = [&](double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                            VectorRef F) {
    CHECK(q.size() == 2);
    CHECK(qd.size() == 2);
    last_time = t;
    F = constant;
  };
  for (const Method method : own_methods) {
    const VectorXd times = even_times(0.0, 0.5, 6);
    Options options;
    options.max_step = 0.01;
    const Trajectory plain =
        run_of(model, times, CommandInput::constant(constant), method, options);
    const Trajectory called =
        run_of(model, times, CommandInput::function(recorded, 3), method, options);
    CHECK(called.q == plain.q);
    CHECK(last_time == 0.5);
  }
  // A law that pulls against the bend and its rate keeps the upright robot nearer to straight.
  const auto law = [](double, const ConstVectorRef& q, const ConstVectorRef& qd, VectorRef F) {
    const double wanted = -20.0 * q[0] - 3.0 * qd[0];
    F << std::fmax(0.0, wanted), std::fmax(0.0, -wanted), std::fmax(0.0, -wanted);
  };
  const VectorXd times = even_times(0.0, 10.0, 101);
  const Trajectory controlled =
      run_of(model, times, CommandInput::function(law, 3), Method::dopri5);
  const Trajectory free = run_of(model, times, no_tension(model), Method::dopri5);
  CHECK(controlled.q.col(0).tail(20).cwiseAbs().maxCoeff() <
        0.1 * free.q.col(0).tail(20).cwiseAbs().maxCoeff());
}

TEST_CASE("what a tension function throws reaches the caller") {
  const Model model = upright();
  const auto failing = [](double t, const ConstVectorRef&, const ConstVectorRef&, VectorRef F) {
    if (t > 0.2) throw std::runtime_error("load cell lost");
    F.setOnes();
  };
  for (const Method method : own_methods) {
    CHECK_THROWS_WITH_AS(simulate(model, q_start, qd_start, even_times(0.0, 1.0, 11),
                                  CommandInput::function(failing, 3), method),
                         "load cell lost", std::runtime_error);
  }
}

TEST_CASE("progress is told times that grow, and the steps do not depend on it") {
  const Model model = upright();
  for (const Method method : own_methods) {
    std::vector<double> told;
    const VectorXd times = even_times(0.0, 20.0, 3);
    const Trajectory run = simulate(model, q_start, qd_start, times, no_tension(model), method,
                                    tightest(), make_integrator, [&](double t) {
                                      told.push_back(t);
                                      return true;
                                    });
    REQUIRE(run.status == Status::ok);
    CHECK(told.size() > 2);
    for (std::size_t i = 1; i < told.size(); ++i) CHECK(told[i] > told[i - 1]);
    CHECK(run.q == run_of(model, times, no_tension(model), method, tightest()).q);
  }
}

TEST_CASE("the statistics count") {
  const Model model = upright();
  const Trajectory fixed =
      run_of(model, even_times(0.0, 1.0, 2), no_tension(model), Method::rk4, fixed_step(0.01));
  CHECK(fixed.stats.steps == 100);
  CHECK(fixed.stats.rejected == 0);
  CHECK(fixed.stats.evaluations >= 400);
  const Trajectory adaptive =
      run_of(model, even_times(0.0, 1.0, 2), no_tension(model), Method::dopri5);
  CHECK(adaptive.stats.steps > 10);
  CHECK(adaptive.stats.evaluations >= 6 * (adaptive.stats.steps + adaptive.stats.rejected));
  CHECK(adaptive.stats.jacobians == 0);
  CHECK(adaptive.stats.newton_failures == 0);
}

TEST_CASE("a robot that is straight but for rounding starts as a straight one does") {
  const Model model = upright();
  const VectorXd times = even_times(1.0, 2.0, 11), rest = VectorXd::Zero(2);
  const CommandInput pull = CommandInput::constant(Eigen::Vector3d(5.0, 0.0, 0.0));
  for (const Method method : own_methods) {
    for (const double off : {1e-15, 1e-14, 1e-13, 1e-12}) {
      CAPTURE(off);
      const auto from = [&](double q) {
        return simulate(model, Eigen::Vector2d(q, 0.0), rest, times, pull, method);
      };
      const Trajectory run = from(off);
      REQUIRE(run.status == Status::ok);
      CHECK(largest(run.q - from(0.0).q) < 1e-6);
    }
  }
}

TEST_CASE("max_step bounds the steps of Dormand-Prince") {
  const Model model = upright();
  Options options = tolerances(1e-3, 1e-3);
  options.max_step = 0.005;
  const Trajectory run =
      run_of(model, even_times(0.0, 1.0, 2), no_tension(model), Method::dopri5, options);
  CHECK(run.stats.steps >= 198);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
