// Runs under a controller: when it is asked, how long its answer holds, where the loop settles.
#include <doctest/doctest.h>

#include <cmath>

#include "cdcr/cdcr.hpp"
#include "support/cases.hpp"
#include "support/pid_loops.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

namespace tolerance {
/// A steady state at the end of a run long enough for the motion to die out [rad].
constexpr double settled = 1e-10;
/// Stretches in turn against one run: time counts from the start of each.
constexpr double in_turn = 1e-11;
}  // namespace tolerance

Trajectory run(const Model& model, Controller& controller, const VectorXd& times,
               Method method = Method::rk4, double step = 1e-3) {
  Options options = method == Method::rk4 ? fixed_step(step) : tightest();
  return simulate(model, q_start, qd_start, times, controller, method, options);
}

/// Run to rest under the controller from straight; the last bending vector.
VectorXd at_rest(const Model& model, Pid& pid, double duration) {
  const Trajectory run =
      simulate(model, VectorXd::Zero(2), VectorXd::Zero(2), Eigen::Vector2d(0.0, duration), pid,
               Method::rk4, fixed_step(1e-2));
  REQUIRE(run.status == Status::ok);
  return run.q.row(1).transpose();
}

/// Largest component along `direction` over a run from straight.
double farthest(const Model& model, Pid& pid, double duration, const VectorXd& direction) {
  const Trajectory run =
      simulate(model, VectorXd::Zero(2), VectorXd::Zero(2), even_times(0.0, duration, 2001), pid,
               Method::rk4, fixed_step(1e-2));
  REQUIRE(run.status == Status::ok);
  return (run.q * direction.normalized()).maxCoeff();
}

TEST_SUITE_BEGIN("controlled_runs");

TEST_CASE("tensions are held from the first time on, and renewed at each period") {
  const Model model(heavily_damped());
  // Powers of two, so that samples fall exactly on the controller's instants.
  const double period = 1.0 / 64.0, start = 0.5;
  const Index samples_per_period = 4, count = 10 * samples_per_period;
  Pid pid(model, gains(0.5, 1.0, 0.01, period));
  pid.set_reference(Eigen::Vector2d(0.1, 0.5));
  const Trajectory found =
      run(model, pid, even_times(start, start + 10.0 * period, count + 1), Method::dopri5);
  REQUIRE(found.status == Status::ok);
  Pid by_hand(model, pid.options());
  by_hand.set_reference(pid.reference());
  VectorXd tension(3);
  for (Index i = 0; i <= count; ++i) {
    CAPTURE(i);
    if (i % samples_per_period == 0) {
      const VectorXd before = tension;
      REQUIRE(by_hand.update(found.t[i], found.q.row(i).transpose(), found.qd.row(i).transpose(),
                             tension) == Status::ok);
      if (i > 0) CHECK(tension != before);
    }
    CHECK(found.tension.row(i).transpose() == tension);
  }
}

TEST_CASE("a controlled run is the run under the table of its tensions") {
  const Model model(heavily_damped());
  for (const Method method : {Method::rk4, Method::dopri5, Method::dop853}) {
    // The period divides neither the output grid nor the step.
    const double period = 0.0137;
    Pid pid(model, gains(0.8, 1.5, 0.02, period));
    pid.set_reference(Eigen::Vector2d(-0.4, 0.2));
    const VectorXd times = even_times(1.0, 2.0, 101);
    const Trajectory controlled = run(model, pid, times, method);
    REQUIRE(controlled.status == Status::ok);

    Index periods = 0;
    while (1.0 + static_cast<double>(periods) * period < 2.0) ++periods;
    VectorXd instants(periods);
    for (Index k = 0; k < periods; ++k) instants[k] = 1.0 + static_cast<double>(k) * period;
    Pid by_hand(model, pid.options());
    by_hand.set_reference(pid.reference());
    MatrixXd rows(periods, 3);
    VectorXd q = q_start, qd = qd_start, tension(3);
    for (Index k = 0; k < periods; ++k) {
      REQUIRE(by_hand.update(instants[k], q, qd, tension) == Status::ok);
      rows.row(k) = tension.transpose();
      if (k + 1 == periods) break;
      const Trajectory stretch =
          simulate(model, q, qd, Eigen::Vector2d(instants[k], instants[k + 1]),
                   CommandInput::constant(tension), method,
                   method == Method::rk4 ? fixed_step(1e-3) : tightest());
      q = stretch.q.row(1).transpose();
      qd = stretch.qd.row(1).transpose();
    }
    const Trajectory tabled =
        simulate(model, q_start, qd_start, times,
                 CommandInput::table(instants, rows, CommandInput::Interpolation::previous), method,
                 method == Method::rk4 ? fixed_step(1e-3) : tightest());
    REQUIRE(tabled.status == Status::ok);
    CHECK(residual(controlled.q, tabled.q) <= tolerance::in_turn);
    CHECK(residual(controlled.qd, tabled.qd) <= tolerance::in_turn);
    CHECK(residual(controlled.tension, tabled.tension) <= tolerance::in_turn);
  }
}

TEST_CASE("proportional action settles where the backbone balances it") {
  Robot robot = heavily_damped();
  robot.gravity.setZero();
  const Model model(robot);
  const double K = model.stiffness()[0], kp = 0.8;
  PidOptions options = gains(kp);
  options.feed_forward = false;
  Pid pid(model, options);
  for (const double phi : {0.0, 1.0, 2.5, -2.0}) {
    pid.set_reference(bending(0.6, phi));
    // K theta = kp (ref - theta)
    const VectorXd expected = kp / (K + kp) * pid.reference();
    CHECK(residual(at_rest(model, pid, 30.0), expected, 1.0) <= tolerance::settled);
  }
}

TEST_CASE("feed-forward and integral action each reach the reference under weight") {
  const Model model(heavily_damped());
  PidOptions integrating = gains(0.5, 1.0);
  integrating.feed_forward = false;
  for (const PidOptions& options : {gains(0.5), integrating}) {
    Pid pid(model, options);
    for (const double phi : {0.0, 1.0, 2.5, -2.0}) {
      pid.set_reference(bending(0.6, phi));
      CHECK(residual(at_rest(model, pid, 60.0), pid.reference(), 1.0) <= tolerance::settled);
    }
  }
  PidOptions neither = gains(0.5);
  neither.feed_forward = false;
  Pid pid(model, neither);
  pid.set_reference(bending(0.6, 1.0));
  CHECK((at_rest(model, pid, 60.0) - pid.reference()).norm() > 0.05);
}

TEST_CASE("without anti-windup a tight limit leads to overshoot") {
  Robot robot = heavily_damped();
  robot.gravity.setZero();
  robot.sections[0].damping = 0.4;
  const Model model(robot);
  // A tenth more than the 3.8 N on cable 1 that hold the reference.
  const Eigen::Vector2d reference(0.2, 0.0);
  PidOptions options = gains(0.5, 1.0);
  options.feed_forward = false;
  options.limits.max_tension =
      1.1 * model.stiffness()[0] * reference[0] / robot.sections[0].cable_radius;
  const auto overshoot = [&](bool anti_windup) {
    options.anti_windup = anti_windup;
    Pid pid(model, options);
    pid.set_reference(reference);
    CHECK(residual(at_rest(model, pid, 120.0), reference, 1.0) <= 1e-6);
    return farthest(model, pid, 20.0, reference) / 0.2 - 1.0;
  };
  const double with = overshoot(true), without = overshoot(false);
  CAPTURE(with);
  CAPTURE(without);
  CHECK(without > 0.05);
  CHECK(with < 0.5 * without);
}

TEST_CASE("two runs with one controller are the same, to the last bit") {
  const Model model(heavily_damped());
  Pid pid(model, gains(0.8, 1.5, 0.02));
  pid.set_reference(Eigen::Vector2d(-0.4, 0.2));
  const VectorXd times = even_times(0.0, 1.0, 77);
  for (const Method method : {Method::rk4, Method::dopri5, Method::dop853}) {
    const Trajectory first = run(model, pid, times, method);
    CHECK(pid.integral().norm() > 0.0);
    const Trajectory second = run(model, pid, times, method);
    CHECK(first.q == second.q);
    CHECK(first.tension == second.tension);
  }
}

TEST_CASE("cables and limits of the loop are kept along a run") {
  const Model model(heavily_damped());
  PidOptions options = gains(1.0);
  options.limits = {0.4, 3.0, {0, 1}};
  Pid pid(model, options);
  pid.set_reference(Eigen::Vector2d(0.9, -0.8));
  const Trajectory found = run(model, pid, even_times(0.0, 1.0, 101));
  REQUIRE(found.status == Status::ok);
  CHECK(found.tension.col(2).isZero(0.0));
  CHECK(found.tension.leftCols(2).minCoeff() == 0.4);
  CHECK(found.tension.maxCoeff() == 3.0);
}

TEST_CASE("a controller's failure ends the run") {
  class Failing final : public Controller {
   public:
    void reset() noexcept override { calls_ = 0; }
    Status update(double /*t*/, const ConstVectorRef& /*q*/, const ConstVectorRef& /*qd*/,
                  VectorRef tension) noexcept override {
      tension.setZero();
      return ++calls_ > good_ ? Status::invalid_tension : Status::ok;
    }
    double period() const noexcept override { return 0.125; }
    Index num_coordinates() const noexcept override { return any_size; }
    Index num_cables() const noexcept override { return any_size; }

    explicit Failing(int good) : good_(good) {}

   private:
    int good_, calls_ = 0;
  };
  const Model model(amouri2020());
  Failing failing(3);
  const Trajectory found = run(model, failing, even_times(0.0, 1.0, 65));
  CHECK(found.status == Status::invalid_tension);
  CHECK(found.t[found.t.size() - 1] == 0.375 - 1.0 / 64.0);

  Failing never(0);
  const Trajectory start = run(model, never, even_times(2.0, 3.0, 65));
  CHECK(start.status == Status::invalid_tension);
  REQUIRE(start.t.size() == 1);
  CHECK(start.t[0] == 2.0);
  CHECK(start.command.row(0).isZero());
}

/// Two sections with three cables in all, those of the first or of the second alone.
Robot two_sections(bool cables_at_first) {
  Robot robot = amouri2020();
  robot.sections.push_back(robot.sections[0]);
  robot.sections[cables_at_first ? 1 : 0].cable_angles.clear();
  return robot;
}

/// A run of `robot` under a Pid made for another one.
void check_refused(const Robot& robot, const Robot& other, const char* sentence) {
  const Model model(robot);
  Pid pid(Model(other), gains(1.0, 1.0));
  const VectorXd zero = VectorXd::Zero(model.num_coordinates());
  CHECK_THROWS_SENTENCE(simulate(model, zero, zero, even_times(0.0, 1.0, 2), pid), sentence);
}

TEST_CASE("a controller for a robot of other sizes is refused") {
  Robot two_cables = amouri2020();
  two_cables.sections[0].cable_angles = {0.0, 1.0};
  check_refused(amouri2020(), two_cables,
                "the controller was made for a robot of 2 coordinates and 2 cables, but the model "
                "has 2 coordinates and 3 cables");
  for (const bool at_first : {false, true}) {
    check_refused(two_sections(at_first), amouri2020(),
                  "the controller was made for a robot of 2 coordinates and 3 cables, but the "
                  "model has 4 coordinates and 3 cables");
    check_refused(amouri2020(), two_sections(at_first),
                  "the controller was made for a robot of 4 coordinates and 3 cables, but the "
                  "model has 2 coordinates and 3 cables");
  }
}

TEST_CASE("a controller that gives tensions does not drive a cable by length") {
  Robot by_length = amouri2020();
  by_length.sections[0].cable_stiffness = 1e3;
  check_refused(by_length, amouri2020(),
                "the controller drives cables by tension, but cable 1 of the robot is driven by "
                "length (its stiffness is not 0)");
}

TEST_CASE("a controller of a model that is not exact drives the robot all the same") {
  Robot heavier = amouri2020();
  heavier.payload = 0.01;
  Pid pid(Model(heavier), gains(1.0));
  CHECK(run(Model(amouri2020()), pid, even_times(0.0, 0.1, 2)).status == Status::ok);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
