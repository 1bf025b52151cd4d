// Actuators and sensors of loops, against closed forms.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "cdcr/cdcr.hpp"
#include "support/allocations.hpp"
#include "support/controlled_robots.hpp"
#include "support/residual.hpp"

namespace cdcr::test {
namespace {

constexpr double step = 1e-3;

TEST_SUITE_BEGIN("actuators_sensors");

TEST_CASE("lag, dead time, rate, limits and resolution follow their closed forms") {
  const Model model(upright(1));
  const auto answer = [&](const Actuator& actuator, int steps, double asked) {
    Actuators actuators(model, {actuator}, step);
    const VectorXd zero = VectorXd::Zero(3);
    actuators.reset(zero);
    VectorXd found(steps);
    for (int k = 0; k < steps; ++k) {
      CHECK(allocations_of([&] { actuators.step(Vector3d(asked, 0.0, 0.0), zero); }) == 0);
      found[k] = actuators.given()[0];
    }
    return found;
  };
  Actuator lag;
  lag.time_constant = 0.02;
  const VectorXd lagging = answer(lag, 50, 4.0);
  for (int k = 0; k < 50; ++k) {
    const double from = 1.0 - std::exp(-k * step / 0.02);
    const double to = 1.0 - std::exp(-(k + 1) * step / 0.02);
    CHECK(residual(lagging[k], 4.0 * (from + to) / 2.0) <= 1e-13);
  }
  Actuator late;
  late.dead_time = 5e-3;
  CHECK(answer(late, 7, 4.0) == (VectorXd(7) << 0, 0, 0, 0, 0, 4, 4).finished());
  Actuator slow;
  slow.max_rate = 1000.0;
  CHECK(residual(answer(slow, 5, 2.5), (VectorXd(5) << 0.5, 1.5, 2.25, 2.5, 2.5).finished()) <=
        1e-14);
  Actuator coarse;
  coarse.resolution = 0.25;
  coarse.min_command = 0.1;
  coarse.max_command = 3.0;
  CHECK(answer(coarse, 1, 1.6)[0] == 1.5);
  CHECK(answer(coarse, 1, 0.0)[0] == 0.1);
  CHECK(answer(coarse, 1, 9.0)[0] == 3.0);
}

TEST_CASE("a winch is a critically damped loop that gives way by F/(m w^2), within its torque") {
  const Model model(by_length(1));
  Winch winch;
  winch.drum_radius = 0.01;
  winch.gear = 20.0;
  winch.inertia = 1e-6;
  winch.bandwidth = 50.0;
  CHECK(residual(winch.mass(), 4.0) <= 1e-14);
  Actuator actuator;
  actuator.winch = winch;
  const double fine = 1e-5;
  Actuators actuators(model, {actuator}, fine);
  VectorXd start = VectorXd::Constant(3, 0.3);
  actuators.reset(start);
  const VectorXd none = VectorXd::Zero(3), pull = VectorXd::Constant(3, 10.0);
  const VectorXd asked = VectorXd::Constant(3, 0.28);
  for (int k = 1; k <= 4000; ++k) {
    actuators.step(asked, none);
    if (k % 1000 != 0) continue;
    const double wt = 50.0 * (k - 0.5) * fine;
    CHECK(residual(actuators.given()[0] - 0.28, 0.02 * (1.0 + wt) * std::exp(-wt), 0.02) <= 2e-3);
  }
  for (int k = 0; k < 100000; ++k) actuators.step(asked, pull);
  CHECK(residual(actuators.given()[0] - 0.28, 10.0 / (4.0 * 2500.0), 1e-3) <= 1e-6);
  // A motor that is too weak lets the cable go.
  actuator.winch->max_torque = 0.004;  // 8 N on the cable
  Actuators weak(model, {actuator}, fine);
  weak.reset(start);
  for (int k = 0; k < 10000; ++k) weak.step(asked, pull);
  CHECK(residual(weak.given()[0] - 0.3, 0.5 * (10.0 - 8.0) / 4.0 * 0.01, 1e-4) <= 1e-2);
}

TEST_CASE("sensors: each kind tells its value, late and biased as asked, with noise as deep") {
  const Model model(slender());
  Random random;
  INFO(random);
  const Index d = model.num_coordinates(), c = model.num_cables();
  const VectorXd q = random.vector(d, 0.1), qd = random.vector(d, 0.5);
  const VectorXd command = VectorXd::LinSpaced(c, 1.0, 2.0);
  const auto told = [&](const Sensor& sensor) {
    SensorChannel channel(model, sensor, step);
    channel.reset(q, qd, command);
    CHECK(allocations_of([&] { channel.step(0, q, qd, command); }) == 0);
    return channel.value();
  };
  VectorXd lengths(c);
  cable_lengths(model, q, lengths);
  Sensor sensor;
  CHECK(told(sensor) == q);
  sensor.kind = Sensor::Kind::rates;
  CHECK(told(sensor) == qd);
  sensor.kind = Sensor::Kind::lengths;
  CHECK(told(sensor) == lengths);
  sensor.kind = Sensor::Kind::tensions;
  sensor.bias = 0.5;
  CHECK(told(sensor) == VectorXd(command.array() + 0.5));
  sensor.bias = 0.0;
  sensor.kind = Sensor::Kind::tip;
  CHECK(told(sensor) == VectorXd(tip(model, q).p));
  sensor.kind = Sensor::Kind::orientation;
  const Matrix3d R = tip(model, q).R;
  const auto turned = [&] {
    const Vector3d v = told(sensor);
    return Matrix3d(Eigen::AngleAxisd(v.norm(), v.normalized()));
  };
  CHECK(residual(turned(), R) <= 1e-14);
  sensor.bias = 0.2;  // about each of its own axes
  const Vector3d axis = Vector3d::Ones().normalized();
  CHECK(residual(turned(), R * Eigen::AngleAxisd(0.2 * std::sqrt(3.0), axis)) <= 1e-14);
  sensor.bias = 0.0;
  sensor.kind = Sensor::Kind::curvature;
  sensor.places = {{1, 0.0}, {1, 1.0}, {1, 0.5}};
  const double l = model.robot().sections[1].length;
  const VectorXd own = q.tail(6);  // three bending vectors
  const VectorXd bent = told(sensor) * l;
  CHECK(residual(bent.segment<2>(0), own.segment<2>(0) - own.segment<2>(2) + own.segment<2>(4),
                 0.1) <= 1e-14);
  CHECK(residual(bent.segment<2>(2), own.segment<2>(0) + own.segment<2>(2) + own.segment<2>(4),
                 0.1) <= 1e-14);
  CHECK(residual(bent.segment<2>(4), own.segment<2>(0) - 0.5 * own.segment<2>(4), 0.1) <= 1e-14);

  Sensor noisy;
  noisy.period = 2.0 * step;
  noisy.delay = 3.0 * step;
  noisy.noise = 0.1;
  SensorChannel channel(model, noisy, step);
  channel.reset(q, qd, command);
  double sum = 0.0, squares = 0.0;
  long count = 0;
  for (int k = 0; k < 40000; ++k) {
    const bool fresh = channel.step(k, q, qd, command);
    CHECK(fresh == (k >= 3 && (k - 3) % 2 == 0));
    if (!fresh) continue;
    const VectorXd error = channel.value() - q;
    sum += error.sum();
    squares += error.squaredNorm();
    count += error.size();
  }
  const auto n = static_cast<double>(count);
  CHECK(std::abs(sum / n) < 5.0 * 0.1 / std::sqrt(n));
  CHECK(std::abs(squares / n / 0.01 - 1.0) < 5.0 * std::sqrt(2.0 / n));
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
