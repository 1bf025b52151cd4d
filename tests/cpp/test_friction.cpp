// Friction of cables in their holes: it takes energy and never gives any, and is Capstan's.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cdcr/simulate.hpp"
#include "support/cable_robots.hpp"
#include "support/element_sum.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

/// Friction power is a difference of powers; this share of their size may be rounding.
constexpr double power_rounding = 2e-15;
/// The energy of a run whose friction has kinks, by Simpson's rule over 20001 samples.
constexpr double balance_by_samples = 1e-6;
/// The same around a loop with a turning point, by the trapezoidal rule.
constexpr double loop_by_samples = 1e-5;

/// Rate of the length of cable j within section k, and size of the powers in a state.
double rate_within(const Model& model, Index j, Index k, const VectorXd& qd) {
  return -model.actuation_matrix().col(j).segment(2 * k, 2).dot(qd.segment(2 * k, 2));
}

double power_scale(const Model& model, const VectorXd& qd, const VectorXd& tension) {
  double scale = 0.0;
  for (Index j = 0; j < model.num_cables(); ++j) {
    for (Index k = 0; k < model.num_sections(); ++k) {
      scale += tension[j] * std::abs(rate_within(model, j, k, qd));
    }
  }
  return scale;
}

/// Whether some cable slides one way where it enters a section and the other where it leaves it.
bool turns_within_a_section(const Model& model, const VectorXd& qd) {
  for (Index j = 0; j < model.num_cables(); ++j) {
    double beyond = 0.0;
    for (Index k = model.num_sections() - 1; k >= 0; --k) {
      const double before = beyond + rate_within(model, j, k, qd);
      if (before * beyond < 0.0) return true;
      beyond = before;
    }
  }
  return false;
}

/// Makes one cable stand still near the middle of a section, where the mean of its speed and the
/// mean weighted by tension may differ in sign.
void stop_mid_section(const Model& model, Random& random, VectorXd& qd) {
  const Index j = random.integer(0, static_cast<int>(model.num_cables()) - 1);
  const Index end = model.cables()[static_cast<std::size_t>(j)].end_section;
  if (end == 0) return;
  const Index k = random.integer(0, static_cast<int>(end) - 1);
  double beyond = 0.0;
  for (Index i = k + 1; i <= end; ++i) beyond += rate_within(model, j, i, qd);
  const double off = random.uniform(-1.0, 1.0) * random.logarithmic(1e-6, 1.0);
  const double rate = rate_within(model, j, k, qd);
  if (rate != 0.0) qd.segment(2 * k, 2) *= -2.0 * beyond * (1.0 + off) / rate;
}

/// Table 1 with one cable and its coefficient of friction.
Model rubbing_table_1(double mu, double sliding_speed = 1e-3) {
  Robot robot = amouri2020();
  robot.sections[0].cable_angles = {0.0};
  robot.sections[0].cable_friction = mu;
  robot.sliding_speed = sliding_speed;
  return Model(robot);
}

TEST_SUITE_BEGIN("friction");

TEST_CASE("friction never gives work") {
  Random random;
  INFO(random);
  double worst = 0.0;
  int states = 0, turning = 0, taking = 0;
  for (int robots = 0; robots < 250; ++robots) {
    const Model model(rubbing_chain(random, 1 + robots % 5));
    for (int i = 0; i < 120; ++i, ++states) {
      const VectorXd q = random_shape(model, random);
      VectorXd qd = random.vector(model.num_coordinates(), random.logarithmic(1e-6, 10.0));
      if (i % 2 == 1) stop_mid_section(model, random, qd);
      const VectorXd command = random_command(model, q, 50.0, random);
      const double scale = power_scale(model, qd, tensions_of(model, q, qd, command));
      const double power = friction_power(model, q, qd, command);
      if (!(power >= worst * scale)) worst = power / scale;
      turning += turns_within_a_section(model, qd) ? 1 : 0;
      taking += power > power_rounding * scale ? 1 : 0;
    }
  }
  MESSAGE(states << " states, in " << turning << " a cable turns within a section, in " << taking
                 << " friction takes power; least power over its scale " << worst);
  CHECK(worst >= -power_rounding * tolerance_scale());
  CHECK(turning > states / 4);
  CHECK(taking > states / 2);
}

TEST_CASE("without friction the cables pull as if there were no holes") {
  Random random;
  INFO(random);
  for (int n = 1; n <= 5; ++n) {
    Robot robot = rubbing_chain(random, n);
    for (Section& section : robot.sections) section.cable_friction = 0.0;
    for (Cable& cable : robot.cables) cable.friction = 0.0;
    const Model smooth(robot);
    robot.cables.back().friction = 0.3;  // one cable rubs, and pulls with 0 N
    const Model rough(robot);
    CHECK(!smooth.has_friction());
    CHECK(rough.has_friction());
    for (int i = 0; i < 100; ++i) {
      const VectorXd q = random_shape(smooth, random);
      const VectorXd qd = random.vector(q.size(), 10.0);
      VectorXd command = random_command(smooth, q, 50.0, random);
      const Index last = command.size() - 1;
      command[last] = robot.cables.back().length_driven() ? 1e3 : 0.0;
      VectorXd plain(q.size());
      const VectorXd tension = tensions_of(smooth, q, qd, command);
      actuation_force(smooth, tension, plain);
      const VectorXd force = cable_force_of(smooth, q, qd, command);
      const double scale = largest(smooth.actuation_matrix().cwiseAbs() * tension);
      CHECK(residual(force, plain, scale) <= tolerance::rounding);
      CHECK(cable_force_of(rough, q, qd, command) == force);
      CHECK(std::abs(friction_power(smooth, q, qd, command)) <=
            power_rounding * power_scale(smooth, qd, tension));
    }
  }
}

TEST_CASE("a coefficient that vanishes leaves the frictionless force") {
  Random random;
  INFO(random);
  Robot robot = rubbing_chain(random, 3);
  for (Cable& cable : robot.cables) cable.friction.reset();
  const auto with = [&robot](double mu) {
    for (Section& section : robot.sections) section.cable_friction = mu;
    return Model(robot);
  };
  const Model smooth = with(0.0), rough = with(1e-18);
  const VectorXd q = random_bending(3, 2.0, random), qd = random.vector(6, 5.0);
  const VectorXd command = random_command(smooth, q, 50.0, random);
  CHECK(residual(cable_force_of(rough, q, qd, command), cable_force_of(smooth, q, qd, command)) <=
        tolerance::rounding);
}

TEST_CASE("a cable at rest does not rub") {
  Random random;
  INFO(random);
  for (int n = 1; n <= 5; ++n) {
    const Model model(rubbing_chain(random, n));
    const VectorXd q = random_bending(n, 2.0, random), qd = VectorXd::Zero(2 * n);
    const VectorXd command = random_command(model, q, 50.0, random);
    VectorXd plain(2 * n);
    const VectorXd tension = tensions_of(model, q, qd, command);
    actuation_force(model, tension, plain);
    const double scale = largest(model.actuation_matrix().cwiseAbs() * tension);
    CHECK(residual(cable_force_of(model, q, qd, command), plain, scale) <= tolerance::rounding);
    CHECK(residual(friction_power(model, q, qd, command), 0.0, 1.0) <= 0.0);
  }
}

TEST_CASE("at full sliding the tension falls or grows by exp(mu theta), section by section") {
  Random random;
  INFO(random);
  for (int n = 1; n <= 5; ++n) {
    Robot robot = amouri2020();
    robot.sections = std::vector<Section>(static_cast<std::size_t>(n), robot.sections[0]);
    for (Section& section : robot.sections) {
      section.cable_angles = {0.0};
      section.cable_friction = random.uniform(0.05, 0.6);
    }
    const Model model(robot);
    const VectorXd q = random_bending(n, 2.5, random);
    const VectorXd F = random.vector(n, 25.0).array() + 25.0;
    VectorXd qd = VectorXd::Zero(2 * n);
    for (Index i = 0; i < n; ++i) qd[2 * i] = random.uniform(2.0, 10.0);
    for (const double way : {1.0, -1.0}) {  // pulled, paid out
      const MatrixXd along = tensions_along_of(model, q, way * qd, F);
      for (Index j = 0; j < n; ++j) {
        CHECK(along(0, j) == F[j]);
        double turn = 0.0;
        for (Index k = 0; k <= j; ++k) {
          turn += model.friction()(k, j) * q.segment(2 * k, 2).norm();
          CHECK(residual(along(k + 1, j), F[j] * std::exp(-way * turn)) <= tolerance::rounding);
        }
        for (Index k = j + 1; k < n; ++k) CHECK(along(k + 1, j) == 0.0);
      }
    }
  }
}

TEST_CASE("a section feels the mean of the tension along it") {
  // Mean of e^-zx over [0, 1], by quadrature for z of any size; small z pass the switch from
  // closed form to series at 1e-2.
  const double mu = 0.5;
  const Model model = rubbing_table_1(mu);
  const VectorXd F = VectorXd::Constant(1, 10.0);
  std::vector<double> sizes = {1e-300, 1e-12, 1e-6, 1e-3, 9.999999e-3, 1.0000001e-2, 1.1e-2};
  for (int i = 1; i <= 40; ++i) sizes.push_back(0.1 * i);
  for (const double size : sizes) {
    for (const double way : {1.0, -1.0}) {
      CAPTURE(way * size);
      const VectorXd q = Eigen::Vector2d(size / mu, 0.0), qd = Eigen::Vector2d(5.0 * way, 0.0);
      Real mean = 0.0L;
      for (std::size_t i = 0; i < num_gauss; ++i) {
        mean += gauss().weight[i] * std::exp(-static_cast<Real>(way * mu * q[0]) * gauss().node[i]);
      }
      const VectorXd force = cable_force_of(model, q, qd, F);
      CHECK(residual(force[0], mean * F[0] * model.actuation_matrix()(0, 0)) <=
            tolerance::rounding);
    }
  }
}

TEST_CASE("a cable's own coefficient stands in for those of the sections") {
  Robot robot = amouri2020();
  robot.sections = std::vector<Section>(2, robot.sections[0]);
  robot.sections[0].cable_angles.clear();
  robot.sections[1].cable_angles.clear();
  robot.sections[0].cable_friction = 0.1;
  robot.sections[1].cable_friction = 0.2;
  robot.cables = {{0.02, 0.0, 1, 0.0, 0.0, std::nullopt}, {0.02, 0.0, 1, 0.0, 0.0, 0.4}};
  const Model model(robot);
  MatrixXd expected(2, 2);
  expected << 0.1, 0.4, 0.2, 0.4;
  CHECK(model.friction() == expected);
  VectorXd q(4), qd(4);
  q << 1.0, 0.0, 0.6, 0.8;
  qd << 5.0, 0.0, 5.0, 0.0;
  const MatrixXd along = tensions_along_of(model, q, qd, Eigen::Vector2d(7.0, 7.0));
  CHECK(residual(along(2, 0), 7.0 * std::exp(-0.3)) <= tolerance::rounding);
  CHECK(residual(along(2, 1), 7.0 * std::exp(-0.8)) <= tolerance::rounding);
}

/// Work [J] over a run: of the tensions at the base, and what damping and friction take.
struct Work {
  double cables = 0.0, damping = 0.0, friction = 0.0;
};

/// Weights of the composite Simpson rule, samples evenly spaced and odd in number.
double simpson(Index i, Index count) {
  if (i == 0 || i == count - 1) return 1.0 / 3.0;
  return i % 2 == 1 ? 4.0 / 3.0 : 2.0 / 3.0;
}

Work work_of(const Model& model, const Trajectory& run) {
  Work work;
  const Index count = run.t.size();
  const double h = run.t[1] - run.t[0];
  for (Index i = 0; i < count; ++i) {
    const VectorXd q = run.q.row(i).transpose(), qd = run.qd.row(i).transpose();
    const VectorXd F = run.tension.row(i).transpose();
    const double weight = h * simpson(i, count);
    work.cables += weight * F.dot(model.actuation_matrix().transpose() * qd);
    work.friction += weight * friction_power(model, q, qd, run.command.row(i).transpose());
    for (Index k = 0; k < model.num_sections(); ++k) {
      work.damping += weight * model.damping()[k] * qd.segment(2 * k, 2).squaredNorm();
    }
  }
  return work;
}

TEST_CASE("energy changes by the work of the cables less damping and friction") {
  Robot robot = parts_with_cables(3, 0.0, 0.0);
  robot.gravity = {0.0, 0.0, 9.81};
  robot.sliding_speed = 0.05;
  for (Section& section : robot.sections) section.cable_friction = 0.4;
  for (Section& section : robot.sections) section.damping = 2e-3;
  const Model model(robot);
  VectorXd q0(6), qd0(6), F(9);
  q0 << 0.5, 0.2, -0.3, 0.4, 0.2, -0.6;
  qd0 << 1.0, -2.0, 0.5, 1.5, -1.0, 3.0;
  F << 6.0, 1.0, 3.0, 2.0, 8.0, 0.0, 4.0, 5.0, 1.0;
  const Trajectory run =
      simulate(model, q0, qd0, even_times(0.0, 2.0, 20001), CommandInput::constant(F),
               Method::dopri5, tolerances(1e-12, 1e-14));
  REQUIRE(run.status == Status::ok);
  const Work work = work_of(model, run);
  const VectorXd energy = total_energies(model, run);
  const double gained = energy[energy.size() - 1] - energy[0];
  // Constant tensions: their work is F times the length that came out at the base.
  const VectorXd end = run.q.row(run.q.rows() - 1).transpose();
  const double pulled = F.dot(lengths_of(model, q0) - lengths_of(model, end));
  CHECK(residual(work.cables, pulled) <= balance_by_samples);
  const Residual off = residual(gained, pulled - work.damping - work.friction, work.friction);
  MESSAGE("work of the cables " << pulled << " J, damping takes " << work.damping << " J, friction "
                                << work.friction << " J, off by " << off << " of friction's");
  CHECK(work.friction > 0.1 * pulled);
  CHECK(off <= balance_by_samples);
}

/// Tension raised to 40 N and let go again over 20 s; area of the loop of tension over length.
struct Loop {
  double area, left, angle_gap;  // [J]; energy at the end [J]; theta released less theta pulled
                                 // at half tension [rad]
  Work work;
};

Loop pull_and_release(double mu) {
  // The cable slides at 4e-3 m/s or so: far above the sliding speed.
  Robot robot = amouri2020();
  robot.sections[0].cable_angles = {0.0};
  robot.sections[0].cable_friction = mu;
  robot.sections[0].damping = 5e-3;
  robot.sliding_speed = 1e-4;
  const Model model(robot);
  MatrixXd tension(3, 1);
  tension << 0.0, 40.0, 0.0;
  const auto input =
      CommandInput::table(Vector3d(0.0, 10.0, 20.0), tension, CommandInput::Interpolation::linear);
  const Trajectory run =
      simulate(model, VectorXd::Zero(2), VectorXd::Zero(2), even_times(0.0, 21.0, 42001), input,
               Method::dopri5, tolerances(1e-8, 1e-10));
  REQUIRE(run.status == Status::ok);
  const VectorXd end = total_energies(model, run).tail(1);
  Loop loop{0.0, end[0], run.q(30000, 0) - run.q(10000, 0), work_of(model, run)};
  const double radius = model.actuation_matrix()(0, 0);
  for (Index i = 1; i < run.t.size(); ++i) {
    loop.area += radius * 0.5 * (run.tension(i, 0) + run.tension(i - 1, 0)) *
                 (run.q(i, 0) - run.q(i - 1, 0));
  }
  return loop;
}

TEST_CASE("a slow pull and release encloses the work of friction") {
  const Loop rough = pull_and_release(0.3), smooth = pull_and_release(0.0);
  MESSAGE("mu = 0.3: area " << rough.area << " J, friction " << rough.work.friction
                            << " J, damping " << rough.work.damping << " J, theta gap "
                            << rough.angle_gap << " rad; mu = 0: area " << smooth.area
                            << " J, theta gap " << smooth.angle_gap << " rad");
  CHECK(residual(rough.area, rough.work.friction + rough.work.damping + rough.left, rough.area) <=
        loop_by_samples);
  CHECK(residual(smooth.area, smooth.work.damping + smooth.left, rough.area) <= loop_by_samples);
  CHECK(rough.work.damping < 0.1 * rough.work.friction);
  CHECK(smooth.area < 0.1 * rough.area);
  CHECK(residual(smooth.work.friction, 0.0, rough.work.friction) <= tolerance::rounding);
  CHECK(rough.left < 1e-3 * rough.area);
  CHECK(std::abs(smooth.angle_gap) < 0.1 * rough.angle_gap);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
