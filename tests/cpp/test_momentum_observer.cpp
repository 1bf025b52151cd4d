// Momentum observer: the lag of a first order that it is, a force on the tip, in loops.
#include <doctest/doctest.h>

#include <cmath>

#include "cdcr/cdcr.hpp"
#include "support/allocations.hpp"
#include "support/controlled_robots.hpp"
#include "support/residual.hpp"
#include "support/settings.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

TEST_SUITE_BEGIN("momentum_observer");

TEST_CASE("what it tells of a moving robot is the force behind a lag of first order") {
  for (const NamedRobot& sample : controlled_robots()) {
    CAPTURE(sample.name);
    const Model model(sample.robot);
    const Index d = model.num_coordinates(), last = model.num_sections() - 1;
    MomentumObserverOptions options;
    options.period = model.has_rods() ? 1e-5 : 1e-4;
    options.bandwidth = 40.0;
    MomentumObserver observer(model, options);
    Simulator robot(model, options.period);
    VectorXd q = model.rest(), qd = VectorXd::Zero(d), command(model.num_cables());
    for (Index j = 0; j < command.size(); ++j) {
      const bool by_length = model.cables()[static_cast<std::size_t>(j)].length_driven();
      command[j] =
          by_length ? model.straight_lengths()[j] - 1e-3 : 1.0 + 0.3 * static_cast<double>(j % 3);
    }
    robot.reset(q, qd);
    observer.reset(q, qd, command);
    Wrenches wrenches(1);
    wrenches[0] = {last, 0.8, {0.02, -0.03, 0.01}, {0.0, 0.001, 0.0}};
    VectorXd lag = VectorXd::Zero(d), force(d), before(d);
    double most = 0.0;
    for (int k = 0; k <= 1200; ++k) {
      q = robot.q();
      qd = robot.qd();
      REQUIRE(observer.update(robot.time(), {}, command, q, qd) == Status::ok);
      force.setZero();
      add_wrench_force(model, q, wrenches, force);
      if (k > 0) {  // the same trapezoidal rule
        const double half = 0.5 * options.bandwidth * options.period;
        lag = ((1.0 - half) * lag + half * (force + before)) / (1.0 + half);
        most = std::fmax(most, (observer.generalized_force() - lag).lpNorm<Eigen::Infinity>());
      }
      before = force;
      REQUIRE(robot.step(command, wrenches) == Status::ok);
    }
    CHECK(residual(most, 0.0, lag.lpNorm<Eigen::Infinity>()) <= 2e-2);
  }
}

/// The force on the tip that a loop with noise finds, at the end of a second with that force, and
/// what the loop has been told.
Vector3d force_on_tip(const Model& model, const Vector3d& force, std::vector<Sensor> sensors,
                      Estimator* states) {
  ComputedTorqueOptions torque;
  torque.kp = 64.0;
  torque.kd = 16.0;
  torque.limits.tension.min_tension = 1.0;
  ComputedTorque controller(model, torque);
  VectorXd bent = VectorXd::Constant(model.num_coordinates(), 0.3);
  controller.set_reference(bent);
  MomentumObserverOptions options;
  options.bandwidth = 10.0;
  options.force_at = Place{model.num_sections() - 1, 1.0};
  MomentumObserver observer(model, options, states);
  LoopOptions how;
  how.sensors = std::move(sensors);
  Loop loop(model, controller, how, &observer);
  loop.reset(bent, VectorXd::Zero(bent.size()));
  Wrenches wrenches(1);
  wrenches[0] = {model.num_sections() - 1, 1.0, force};
  const LoopRun found = run(loop, 1.0, 1000, wrenches);
  REQUIRE(found.status == Status::ok);
  CHECK(allocations_of([&] { (void)loop.step(wrenches); }) == 0);
  const std::vector<std::string> names = observer.value_names();
  CHECK(found.estimated.cols() == static_cast<Index>(names.size()));
  CHECK(names[0] == "Q_q1_x");
  CHECK(names[static_cast<std::size_t>(bent.size())] == "force_x");
  return observer.force();
}

TEST_CASE("a force on the tip is found within a tenth, from noisy sensors") {
  const Model model(upright(3));
  const Vector3d force(0.3, -0.2, 0.1);
  Sensor q, qd;
  q.noise = 1e-4;
  qd.kind = Sensor::Kind::rates;
  qd.noise = 1e-3;
  const Vector3d found = force_on_tip(model, force, {q, qd}, nullptr);
  CAPTURE(found.transpose());
  CHECK((found - force).norm() <= 0.1 * force.norm());

  KalmanOptions options;
  options.sensors.resize(1);
  options.sensors[0].noise = 2e-6;
  ExtendedKalman states(model, options);
  const Vector3d without_rates = force_on_tip(model, force, options.sensors, &states);
  CAPTURE(without_rates.transpose());
  CHECK((without_rates - force).norm() <= 0.1 * force.norm());
}

TEST_CASE("what does not fit is refused in a sentence") {
  const Model model(upright(1));
  MomentumObserverOptions options;
  options.bandwidth = 0.0;
  CHECK_THROWS_SENTENCE(MomentumObserver(model, options),
                        "bandwidth must be > 0 rad/s and finite, got 0");
  options = {};
  options.damping = 0.0;
  CHECK_THROWS_SENTENCE(MomentumObserver(model, options),
                        "damping must be > 0 1/rad and finite, got 0");
  options = {};
  options.force_at = Place{0, 1.5};
  CHECK_THROWS_SENTENCE(
      MomentumObserver(model, options),
      "force_at must be a section 0 to 0 and a fraction 0 to 1, got section 0 and fraction 1.5");
  KalmanOptions kalman;
  kalman.sensors.resize(1);
  kalman.sensors[0].noise = 1e-3;
  kalman.period = 2e-3;
  ExtendedKalman states(model, kalman);
  CHECK_THROWS_SENTENCE(
      MomentumObserver(model, {}, &states),
      "the observer's period must be that of the estimator it asks, 0.002 s, got 0.001 s");
  MomentumObserver observer(model);
  const Model other(upright(2));
  ComputedTorque controller(other);
  CHECK_THROWS_SENTENCE(Loop(other, controller, {}, &observer),
                        "the observer was made for a robot of 2 coordinates and 3 cables, but the "
                        "model has 4 coordinates and 6 cables");
  VectorXd q = VectorXd::Zero(3), qd = VectorXd::Zero(2);
  CHECK(observer.update(0.0, {}, Vector3d::Zero(), qd, qd) == Status::not_started);
  observer.reset(qd, qd, Vector3d::Zero());
  CHECK(observer.update(0.0, {}, Vector3d::Zero(), q, qd) == Status::wrong_size);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
