// Estimators in closed loops, and what they refuse.
#include <doctest/doctest.h>

#include <cmath>

#include "cdcr/cdcr.hpp"
#include "support/allocations.hpp"
#include "support/controlled_robots.hpp"
#include "support/filters.hpp"
#include "support/settings.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

constexpr double step = 1e-3;

TEST_SUITE_BEGIN("estimators");

TEST_CASE("in a loop the controller is told the estimate, and nothing is allocated") {
  // CDCR_TEST_COUNT=1000 makes all periods of the promise; short in everyday runs.
  const long many = test_count() >= 1000 ? 100000 : 200;
  for (const NamedRobot& sample : controlled_robots()) {
    CAPTURE(sample.name);
    const Model model(sample.robot);
    const long periods = model.has_rods() ? many / 20 : many;
    ComputedTorqueOptions torque;
    torque.kp = 25.0;
    torque.kd = 10.0;
    torque.limits.tension.min_tension = 0.5;
    ComputedTorque controller(model, torque);
    controller.set_reference(model.rest().array() + 0.02);
    LoopOptions how;
    how.substeps = model.has_rods() ? 40 : 1;
    how.sensors.resize(4);
    const auto set = [&](std::size_t i, Sensor::Kind kind, double noise, double delay) {
      how.sensors[i].kind = kind;
      how.sensors[i].noise = noise;
      how.sensors[i].delay = delay;
    };
    set(0, Sensor::Kind::lengths, 1e-5, 0.0);
    set(1, Sensor::Kind::tensions, 1e-2, 0.0);
    set(2, Sensor::Kind::tip, 1e-4, 2.0 * step);
    set(3, Sensor::Kind::curvature, 1e-2, step);
    for (Index i = 0; i < model.num_sections(); ++i) {
      how.sensors[3].places.push_back({i, 0.25});
      how.sensors[3].places.push_back({i, 0.75});
    }
    KalmanOptions options;
    options.sensors = how.sensors;
    options.substeps = how.substeps;
    options.deviation = 1e-3;
    options.rate_deviation = 1e-3;
    ExtendedKalman extended(model, options);
    options.force_at = Place{0, 1.0};
    options.variants = {stiffer(sample.robot)};
    options.share_deviation = 0.1;
    options.force_deviation = 0.1;
    ExtendedKalman augmented(model, options);
    UnscentedKalman unscented(model, options);
    for (KalmanFilter* filter :
         std::initializer_list<KalmanFilter*>{&extended, &augmented, &unscented}) {
      Loop loop(model, controller, how, filter);
      loop.reset(model.rest(), VectorXd::Zero(model.num_coordinates()));
      Status status = Status::ok;
      VectorXd before = loop.q();
      CHECK(allocations_of([&] {
              for (long k = 0; k < periods && status == Status::ok; ++k) {
                before = loop.q();
                status = loop.step();
              }
            }) == 0);
      CHECK(status == Status::ok);
      CHECK(loop.told_q() != before);
      const VectorXd off = loop.told_q() - before;
      // What is told is two steps newer than what the covariance is of.
      const auto spread = filter->covariance().diagonal().array().sqrt();
      const VectorXd most =
          spread.head(off.size()) + 2.0 * step * spread.segment(off.size(), off.size());
      CAPTURE(off.transpose());
      CAPTURE(most.transpose());
      CHECK((off.cwiseAbs().array() <= 5.0 * most.array()).all());
      CHECK(loop.told_q() == filter->state().head(model.num_coordinates()));
      const MatrixXd& P = filter->covariance();
      CHECK((P - P.transpose()).isZero(0.0));
      CHECK(P.llt().info() == Eigen::Success);
      CHECK(filter->diagnostics().measured > 0);
    }
  }
}

TEST_CASE("what does not fit is refused in a sentence") {
  const Model model(upright(1));
  KalmanOptions options;
  const auto refuses = [&](const char* words) {
    CHECK_THROWS_SENTENCE(ExtendedKalman(model, options), words);
    options = of_lengths(1e-4);
  };
  refuses("an estimator needs sensors");
  options.sensors[0].noise = 0.0;
  refuses("noise of sensor 1 must be > 0 for an estimator, got 0");
  options.sensors[0].delay = 1.5e-3;
  refuses(
      "delay of sensor 1, for an estimator, must be a whole number of steps of 0.001 s, 0 to 1e9, "
      "got 0.0015 s");
  options.sensors[0].period = 1.5e-3;
  refuses(
      "period of sensor 1, for an estimator, must be a whole number of steps of 0.001 s, 1 to "
      "1e9, got 0.0015 s");
  options.period = 0.0;
  refuses("period must be > 0 s and finite, got 0");
  options.substeps = 0;
  refuses("substeps must be 1 to 10000, got 0");
  options.acceleration_noise = Vector3d(1.0, 2.0, 3.0);
  refuses("acceleration_noise must be one value, or 2, >= 0 rad/s^1.5, got [1 2 3]");
  options.force_at = Place{1, 0.5};
  refuses(
      "force_at must be a section 0 to 0 and a fraction 0 to 1, got section 1 and fraction 0.5");
  options.variants = {Model(upright(2))};
  refuses("variant 1 must have 2 coordinates and 3 cables as the model has, got 4 and 6");
  Robot by_length = upright(1);
  for (Section& section : by_length.sections) section.cable_stiffness = 1e3;
  options.variants = {Model(by_length)};
  refuses(
      "cable 1 of variant 1 must be driven by tension as the model's, got one driven by length");
  options.start = Vector3d::Zero();
  refuses("start must be 2 finite values, got [0 0 0]");
  options.deviation = -1.0;
  refuses("deviation must be >= 0 rad and finite, got -1");
  CHECK_THROWS_SENTENCE(UnscentedKalman(model, options, {0.0, 2.0, 0.0}),
                        "spread must be > 0 1 and finite, got 0");
  CHECK_THROWS_SENTENCE(UnscentedKalman(model, options, {1.0, 2.0, -4.0}),
                        "kappa must be above -4, the size of the state, and finite, got -4");

  ExtendedKalman filter(model, options);
  ComputedTorque controller(model);
  LoopOptions how;
  CHECK_THROWS_SENTENCE(Loop(model, controller, how, &filter),
                        "the estimator hears 1 sensors, which must be of the same kinds, places, "
                        "periods and delays as those of the loop, in the same order");
  const Model other(upright(2));
  ComputedTorque of_other(other);
  CHECK_THROWS_SENTENCE(Loop(other, of_other, how, &filter),
                        "the estimator was made for a robot of 2 coordinates and 3 cables, but the "
                        "model has 4 coordinates and 6 cables");
  VectorXd q = VectorXd::Zero(2), qd = q;
  CHECK(filter.update(0.0, {}, Vector3d::Zero(), q, qd) == Status::not_started);
  filter.reset(q, qd, Vector3d::Zero());
  CHECK(filter.update(0.0, {}, Vector3d::Zero(), q, qd) == Status::wrong_size);
}

TEST_CASE("one that takes up the memory of another goes on as that") {
  const Model model(upright(2));
  KalmanOptions options = of_lengths(1e-4);
  options.sensors[0].delay = 2.0 * step;
  options.actuators.resize(1);
  options.actuators[0].time_constant = 0.01;
  options.actuators[0].dead_time = step;
  ExtendedKalman one(model, options), other(model, options);
  MomentumObserver heard(model), also(model);
  const VectorXd zero = VectorXd::Zero(4);
  one.reset(zero, zero, VectorXd::Zero(6));
  heard.reset(zero, zero, VectorXd::Zero(6));
  VectorXd q = zero, qd = zero, q2 = zero, qd2 = zero, lengths = VectorXd::Zero(6);
  for (int k = 0; k < 12; ++k) {
    const VectorXd at = VectorXd::Constant(4, 0.01 * std::sin(k)), rate = 0.5 * at;
    const VectorXd command = VectorXd::Constant(6, 1.0 + k);
    cable_lengths(model, at, lengths);
    if (k == 6) {
      other.set_memory(one.memory());
      also.set_memory(heard.memory());
    }
    CHECK(one.update(0.0, {{lengths, true}}, command, q, qd) == Status::ok);
    if (k >= 6) CHECK(other.update(0.0, {{lengths, true}}, command, q2, qd2) == Status::ok);
    q = q2 = at;
    qd = qd2 = rate;
    CHECK(heard.update(0.0, {}, command, q, qd) == Status::ok);
    if (k >= 6) CHECK(also.update(0.0, {}, command, q2, qd2) == Status::ok);
  }
  CHECK(other.state() == one.state());
  CHECK(other.covariance() == one.covariance());
  CHECK(also.generalized_force() == heard.generalized_force());
  CHECK_THROWS_SENTENCE(also.set_memory(zero), "memory must be 50 numbers, got 4");
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
