// Kalman filters: slopes against differences, consistency, late sensors, force and shares.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "cdcr/cdcr.hpp"
#include "control/measurement.hpp"
#include "estimation/augmented_motion.hpp"
#include "estimation/measurement_slopes.hpp"
#include "support/controlled_robots.hpp"
#include "support/filters.hpp"
#include "support/residual.hpp"
#include "support/settings.hpp"

namespace cdcr::test {
namespace {

constexpr double step = 1e-3;

/// Central differences of fourth order in steps of 1e-3, of what changes smoothly.
constexpr double by_differences = 1e-9;

template <class Function>
MatrixXd differences(const VectorXd& x, Index rows, const Function& f) {
  constexpr double h = 1e-3;
  MatrixXd out(rows, x.size());
  for (Index k = 0; k < x.size(); ++k) {
    const auto at = [&](double side) {
      VectorXd moved = x;
      moved[k] += side * h;
      return VectorXd(f(moved));
    };
    out.col(k) = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
  }
  return out;
}

TEST_SUITE_BEGIN("kalman_filters");

TEST_CASE("slopes of accelerations with force and shares, and of every sensor, by differences") {
  for (const NamedRobot& sample : controlled_robots()) {
    CAPTURE(sample.name);
    const Model model(sample.robot);
    Random random;
    INFO(random);
    const Index d = model.num_coordinates(), c = model.num_cables();
    const std::vector<Model> variants{heavier(sample.robot), stiffer(sample.robot)};
    VectorXd command = random.vector(c, 0.5).array() + 2.0;
    for (Index j = 0; j < c; ++j) {
      if (model.cables()[static_cast<std::size_t>(j)].length_driven()) {
        command[j] = model.straight_lengths()[j] - 0.02;
      }
    }
    detail::AugmentedMotion motion(model, variants, Place{0, 0.7}, step, 1);
    VectorXd x(motion.size());
    x << random.vector(d, 0.2), random.vector(d, 0.5), random.vector(3, 0.5), 0.3, 0.6;
    MatrixXd slopes(d, x.size());
    motion.slopes(x, command, slopes);
    const auto acceleration = [&](const VectorXd& at) {
      VectorXd qdd(d);
      motion.accelerate(at, command, qdd);
      return qdd;
    };
    CHECK(residual(slopes, differences(x, d, acceleration)) <= by_differences);

    using Kind = Sensor::Kind;
    for (const Kind kind :
         {Kind::coordinates, Kind::rates, Kind::lengths, Kind::tensions, Kind::tip,
          Kind::orientation, Kind::curvature, Kind::base_force, Kind::base_moment}) {
      CAPTURE(static_cast<int>(kind));
      Sensor sensor;
      sensor.kind = kind;
      if (kind == Kind::curvature) sensor.places = {{0, 0.3}, {0, 1.0}};
      detail::MeasurementSlopes one(motion, sensor);
      one.update(x, command);
      const VectorXd expected = one.value();
      const MatrixXd found = one.slopes();
      const auto told = [&](const VectorXd& at) {
        one.update_value(at, command);
        VectorXd error = VectorXd::Zero(expected.size());
        detail::find_error(kind, one.value(), expected, error);
        return error;
      };
      const MatrixXd wanted = differences(x, expected.size(), told);
      CHECK(residual(found, wanted, 1.0 + wanted.cwiseAbs().maxCoeff()) <= by_differences);
    }
  }
}

TEST_CASE("shares of payload and stiffness move as a robot that has as much of them") {
  for (const NamedRobot& sample : controlled_robots()) {
    CAPTURE(sample.name);
    const Model model(sample.robot);
    Robot changed = sample.robot;
    changed.payload += 0.4 * 0.05;
    for (Section& section : changed.sections) section.youngs_modulus *= 1.0 + 0.3 * 0.5;
    const Model truth(changed);
    Data data(truth);
    Random random;
    const Index d = model.num_coordinates();
    const VectorXd q = random.vector(d, 0.2), qd = random.vector(d, 0.5);
    VectorXd command = model.straight_lengths(), x(2 * d + 2), found(d), wanted(d);
    for (Index j = 0; j < command.size(); ++j) {
      const bool by_length = model.cables()[static_cast<std::size_t>(j)].length_driven();
      command[j] = by_length ? command[j] - 0.02 : 2.0;
    }
    x << q, qd, 0.4, 0.3;
    const std::vector<Model> variants{heavier(sample.robot), stiffer(sample.robot)};
    detail::AugmentedMotion motion(model, variants, std::nullopt, step, 1);
    motion.accelerate(x, command, found);
    forward_dynamics(truth, data, q, qd, command, wanted);
    CHECK(residual(found, wanted) <= 1e-12);
  }
}

/// A robot that is shaken as the filter believes, and a filter that begins as wrong as it believes:
/// the means, over a run, of squared errors and innovations over what the filter expects.
struct Consistency {
  double errors = 0.0, innovations = 0.0;
  double values = 0.0;  // in all innovations
};

template <class Filter>
Consistency consistency(const Model& model, const KalmanOptions& options, int periods,
                        unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  const auto draw = [&](Index size, double deviation) {
    return VectorXd(VectorXd::NullaryExpr(size, [&] { return deviation * normal(generator); }));
  };
  const Index d = model.num_coordinates();
  Simulator robot(model, options.period, options.substeps);
  VectorXd q = draw(d, 0.05), qd = VectorXd::Zero(d);
  robot.reset(q, qd);
  VectorXd command = VectorXd::Constant(model.num_cables(), 2.0);
  command[0] = 6.0;
  std::vector<SensorChannel> channels;
  std::vector<Measurement> told;
  for (Sensor sensor : options.sensors) {
    sensor.seed = generator();
    channels.emplace_back(model, sensor, options.period);
    channels.back().reset(q, qd, command);
    told.push_back({channels.back().value(), false});
  }
  Filter filter(model, options);
  filter.reset(q + draw(d, options.deviation), qd + draw(d, options.rate_deviation), command);
  Consistency found;
  VectorXd at(d), rate(d), off(2 * d);
  for (int k = 0; k < periods; ++k) {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      told[i].fresh = channels[i].step(k, robot.q(), robot.qd(), command);
      told[i].value = channels[i].value();
    }
    REQUIRE(filter.update(robot.time(), told, command, at, rate) == Status::ok);
    off << at - robot.q(), rate - robot.qd();
    found.errors += off.dot(filter.covariance().llt().solve(off)) / periods;
    found.innovations += filter.diagnostics().innovation;
    found.values += static_cast<double>(filter.diagnostics().measured);
    REQUIRE(robot.step(command) == Status::ok);
    const double shake = options.acceleration_noise[0] * std::sqrt(options.period);
    robot.reset(robot.q(), robot.qd() + draw(d, shake), 0.0, k + 1);
  }
  return found;
}

TEST_CASE("innovations are as large as the filters expect, and errors") {
  // CDCR_TEST_COUNT=100: 200 seeds of 400 periods.
  const bool all = test_count() >= 100;
  const int seeds = all ? 200 : 12, periods = all ? 400 : 60;
  const Model model(upright(2));
  KalmanOptions options;
  options.acceleration_noise[0] = 2.0;
  options.deviation = 0.03;
  options.rate_deviation = 0.3;
  options.sensors.resize(2);
  options.sensors[0].kind = Sensor::Kind::lengths;
  options.sensors[0].noise = 1e-4;
  options.sensors[1].kind = Sensor::Kind::orientation;
  options.sensors[1].noise = 0.02;
  options.sensors[1].period = 3.0 * step;
  const auto check = [&](auto run) {
    Consistency sum;
    for (int seed = 1; seed <= seeds; ++seed) {
      const Consistency one = run(static_cast<unsigned>(seed));
      sum.errors += one.errors / seeds;
      sum.innovations += one.innovations;
      sum.values += one.values;
    }
    // Chi-square with as many degrees: its mean and, five deviations wide, its spread. Errors of
    // successive periods are alike, so that each seed counts once.
    const double degrees = 2.0 * static_cast<double>(model.num_coordinates());
    CAPTURE(sum.innovations / sum.values);
    CAPTURE(sum.errors / degrees);
    CHECK(std::abs(sum.innovations - sum.values) <= 5.0 * std::sqrt(2.0 * sum.values));
    CHECK(std::abs(sum.errors - degrees) <= 5.0 * std::sqrt(2.0 * degrees / seeds));
  };
  check([&](unsigned seed) { return consistency<ExtendedKalman>(model, options, periods, seed); });
  check([&](unsigned seed) { return consistency<UnscentedKalman>(model, options, periods, seed); });
}

TEST_CASE("values of a late sensor count for the time at which they were measured") {
  const Model model(upright(1));
  KalmanOptions options;
  options.acceleration_noise[0] = 1.0;
  options.deviation = 0.03;
  options.sensors.resize(2);
  options.sensors[0].kind = Sensor::Kind::lengths;
  options.sensors[0].noise = 1e-4;
  options.sensors[1].kind = Sensor::Kind::tip;
  options.sensors[1].noise = 1e-4;
  options.sensors[1].period = 2.0 * step;
  options.sensors[1].delay = 7.0 * step;
  const Consistency late = consistency<ExtendedKalman>(model, options, 2000, 3);
  CHECK(late.values == 3.0 * 1993 + 3.0 * 997);
  CHECK(std::abs(late.innovations - late.values) <= 5.0 * std::sqrt(2.0 * late.values));
}

/// A robot at rest under a pull and a wrench, heard for a second by a filter of another robot.
template <class Filter>
Filter after_a_second(const Model& model, const Wrenches& wrenches, const Model& believed,
                      const KalmanOptions& options) {
  const VectorXd zero = VectorXd::Zero(model.num_coordinates());
  VectorXd command = VectorXd::Constant(model.num_cables(), 1.0);
  command[0] = 5.0;
  Simulator robot(model, options.period, options.substeps);
  robot.reset(zero, zero);
  std::vector<SensorChannel> channels;
  std::vector<Measurement> told;
  for (const Sensor& sensor : options.sensors) {
    channels.emplace_back(model, sensor, options.period);
    channels.back().reset(zero, zero, command);
    told.push_back({channels.back().value(), false});
  }
  Filter filter(believed, options);
  filter.reset(zero, zero, command);
  VectorXd q(zero), qd(zero);
  for (int k = 0; k < 1000; ++k) {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      told[i].fresh = channels[i].step(k, robot.q(), robot.qd(), command);
      told[i].value = channels[i].value();
    }
    REQUIRE(filter.update(robot.time(), told, command, q, qd) == Status::ok);
    REQUIRE(robot.step(command, wrenches) == Status::ok);
  }
  return filter;
}

TEST_CASE("a force on the tip is found within a tenth from cable lengths alone") {
  const Model model(upright(3));
  KalmanOptions options = of_lengths(1e-5);
  options.force_at = Place{2, 1.0};
  options.force_noise = 0.05;
  const Vector3d force(0.15, -0.1, 0.0);
  Wrenches wrenches(1);
  wrenches[0] = {2, 1.0, force};
  const auto check = [&](const KalmanFilter& filter) {
    CHECK(filter.value_names() == std::vector<std::string>{"force_x", "force_y", "force_z"});
    VectorXd found(3), deviations(3);
    filter.write_values(found, deviations);
    CAPTURE(found.transpose());
    CHECK((found - force).head<2>().norm() <= 0.1 * force.norm());
    CHECK(((found - force).cwiseAbs().array() <= 4.0 * deviations.array()).all());
  };
  check(after_a_second<ExtendedKalman>(model, wrenches, model, options));
  check(after_a_second<UnscentedKalman>(model, wrenches, model, options));
}

TEST_CASE("payload and stiffness are found as shares of what sets variants apart") {
  const Robot robot = upright(2);
  Robot loaded = robot;
  loaded.payload += 0.01;
  for (Section& section : loaded.sections) section.youngs_modulus *= 1.05;
  KalmanOptions options = of_lengths(1e-5);
  options.share_deviation = 0.15;
  options.variants = {heavier(robot), stiffer(robot)};  // by 0.05 kg, and half as much again
  const auto check = [&](const KalmanFilter& filter) {
    VectorXd found(2), deviations(2);
    filter.write_values(found, deviations);
    CAPTURE(found.transpose());
    CAPTURE(deviations.transpose());
    CHECK(std::abs(found[0] - 0.2) <= std::min(0.04, 4.0 * deviations[0]));
    CHECK(std::abs(found[1] - 0.1) <= std::min(0.02, 4.0 * deviations[1]));
  };
  check(after_a_second<ExtendedKalman>(Model(loaded), {}, Model(robot), options));
  check(after_a_second<UnscentedKalman>(Model(loaded), {}, Model(robot), options));
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
