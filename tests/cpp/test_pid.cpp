// The PID loop: what it asks for, how it ends, and what it refuses.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "cdcr/allocation.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/pid.hpp"
#include "cdcr/simulate.hpp"
#include "support/allocations.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/throws.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const Eigen::Vector2d zero(0.0, 0.0), goal(0.3, -0.2);

Model upright() {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  return Model(robot);
}

PidOptions gains(double kp, double ki, double kd) {
  PidOptions options;
  options.kp = kp;
  options.ki = ki;
  options.kd = kd;
  options.period = 1.0 / 512.0;
  return options;
}

/// Distance from the goal at the end of a run from straight.
double final_error(const Model& model, Pid& pid, double duration) {
  pid.set_reference(goal);
  const Trajectory run = simulate(model, zero, zero, even_times(0.0, duration, 101), pid);
  REQUIRE(run.status == Status::ok);
  return (run.q.row(100).transpose() - goal).norm();
}

TEST_SUITE_BEGIN("pid");

TEST_CASE("at the reference it asks for what holds the robot still") {
  const Model model = upright();
  Data data(model);
  Pid pid(model, gains(1.0, 0.5, 0.1));
  pid.set_reference(goal);
  VectorXd tension(3), hold(2);
  CHECK(pid.update(0.0, goal, zero, tension) == Status::ok);
  potential_gradient(model, data, goal, hold);
  CHECK(residual(model.actuation_matrix() * tension, hold) <= tolerance::rounding);
  CHECK(tension.minCoeff() >= 0.0);
  CHECK(pid.integral() == zero);
}

TEST_CASE("each gain does what its name says") {
  const Model model = upright();
  const Eigen::Vector2d q(0.1, 0.1), qd(0.5, -1.0);
  const auto force = [&](const PidOptions& options) -> VectorXd {
    Pid pid(model, options);
    pid.set_reference(goal);
    VectorXd tension(3);
    REQUIRE(pid.update(0.0, q, qd, tension) == Status::ok);  // builds the integral up
    REQUIRE(pid.update(0.0, q, qd, tension) == Status::ok);
    return model.actuation_matrix() * tension;
  };
  const VectorXd error = goal - q, base = force(gains(0.0, 0.0, 0.0));
  const double period = gains(0.0, 0.0, 0.0).period;
  CHECK(residual(force(gains(2.0, 0.0, 0.0)) - base, 2.0 * error) <= tolerance::cancelled);
  CHECK(residual(force(gains(0.0, 3.0, 0.0)) - base, 3.0 * period * error) <=
        tolerance::cancelled / period);
  CHECK(residual(force(gains(0.0, 0.0, 0.4)) - base, -0.4 * qd) <= tolerance::cancelled);
}

TEST_CASE("the loop reaches its reference and stays") {
  const Model model = upright();
  Pid pid(model, gains(0.5, 0.0, 0.1));
  CHECK(final_error(model, pid, 5.0) < 1e-6);
}

TEST_CASE("without feed-forward the integral takes the error away, and without it stays") {
  const Model model = upright();
  PidOptions options = gains(0.5, 0.0, 0.1);
  options.feed_forward = false;
  Pid without(model, options);
  CHECK(final_error(model, without, 20.0) > 0.05);
  options.ki = 0.5;
  Pid with(model, options);
  CHECK(final_error(model, with, 20.0) < 1e-3);
}

TEST_CASE("tensions are held over each period and runs are repeatable, to the last bit") {
  const Model model = upright();
  PidOptions options = gains(0.5, 0.3, 0.1);
  options.period = 0.125;
  Pid pid(model, options);
  pid.set_reference(goal);
  const VectorXd times = even_times(0.0, 1.0, 65);  // eight samples a period
  const Trajectory run = simulate(model, zero, zero, times, pid);
  const Trajectory again = simulate(model, zero, zero, times, pid);
  CHECK(run.q == again.q);
  CHECK(run.tension == again.tension);
  for (Index i = 0; i < 64; ++i) CHECK(run.tension.row(i) == run.tension.row(i - i % 8));
  CHECK(run.tension.row(8) != run.tension.row(7));
}

TEST_CASE("anti-windup stops integrating what the tension limits withhold") {
  const Model model = upright();
  for (const bool anti_windup : {true, false}) {
    PidOptions options = gains(0.0, 1.0, 0.0);
    options.anti_windup = anti_windup;
    options.limits.max_tension = 0.1;
    Pid pid(model, options);
    pid.set_reference(goal);
    VectorXd tension(3);
    for (int i = 0; i < 100; ++i) REQUIRE(pid.update(0.0, zero, zero, tension) == Status::ok);
    CHECK((pid.integral().norm() == 0.0) == anti_windup);
    CHECK(tension.maxCoeff() <= 0.1);
    pid.reset();
    CHECK(pid.integral() == zero);
  }
}

TEST_CASE("update allocates nothing and a state that is no number is refused") {
  const Model model = upright();
  Pid pid(model, gains(0.5, 0.3, 0.1));
  VectorXd tension(3);
  Status status = Status::ok;
  CHECK(allocations_of([&] { status = pid.update(0.0, goal, goal, tension); }) == 0);
  CHECK(status == Status::ok);
  const Eigen::Vector2d bad(nan, 0.0);
  CHECK(pid.update(0.0, bad, goal, tension) == Status::non_finite_state);
  CHECK(pid.update(0.0, goal, bad, tension) == Status::non_finite_state);
}

TEST_CASE("bad set-up is refused with a sentence") {
  const Model model = upright();
  PidOptions options;
  CHECK_THROWS_SENTENCE(Pid(model, gains(-1.0, 0.0, 0.0)),
                        "kp must be >= 0 N m/rad and finite, got -1");
  CHECK_THROWS_SENTENCE(Pid(model, gains(0.0, nan, 0.0)),
                        "ki must be >= 0 N m/(rad s) and finite, got nan");
  CHECK_THROWS_SENTENCE(Pid(model, gains(0.0, 0.0, -0.5)),
                        "kd must be >= 0 N m s/rad and finite, got -0.5");
  options.period = 0.0;
  CHECK_THROWS_SENTENCE(Pid(model, options), "period must be > 0 s and finite, got 0");
  Pid pid(model, gains(1.0, 0.0, 0.0));
  CHECK_THROWS_SENTENCE(pid.set_reference(Eigen::Vector2d(10.0, 0.0)),
                        "reference must be 2 finite values that bend each section by at most 3 pi "
                        "rad, got [10  0]");
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
