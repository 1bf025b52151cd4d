// Friction that remembers, in motion: it sticks, it takes energy and never gives any, and meets
// closed forms.
#include <doctest/doctest.h>

#include <cmath>

#include "cdcr/cable_friction.hpp"
#include "cdcr/simulate.hpp"
#include "cdcr/simulator.hpp"
#include "loads/friction_memory.hpp"
#include "support/allocations.hpp"
#include "support/cable_robots.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

/// Heat is a difference of powers; this share of their size may be rounding.
constexpr double power_rounding = 1e-14;
/// Runs of Runge-Kutta past the kinks of friction.
constexpr double past_kinks = 5e-5;

Robot one_cable(double stiffness) {
  Robot robot = amouri2020();
  Cable cable;
  cable.radius = robot.sections[0].cable_radius;
  robot.sections[0].cable_angles.clear();
  robot.cables = {cable};
  robot.presliding_stiffness = stiffness;
  return robot;
}

/// A cable that rubs at its entry alone.
detail::FrictionProfile<double> at_entry(double friction) {
  static const auto free = detail::CapstanFactors<double>::free();
  return {10.0 + friction, friction, 1.0, free};
}

TEST_SUITE_BEGIN("cable_memory");

TEST_CASE("friction that remembers never gives work") {
  Random random;
  INFO(random);
  double worst = 0.0;
  int states = 0, taking = 0, beyond = 0;
  for (int robots = 0; robots < 100; ++robots) {
    Robot robot = rubbing_chain(random, 1 + robots % 5);
    robot.presliding_stiffness = random.logarithmic(1e2, 1e6);
    for (Cable& cable : robot.cables) {
      cable.entry_friction = random.integer(0, 1) * random.uniform(0.0, 3.0);
      cable.sheath_friction = random.integer(0, 1) * random.uniform(0.0, 0.5);
      cable.viscosity = random.integer(0, 1) * random.uniform(0.0, 5.0);
    }
    const Model model(robot);
    for (int i = 0; i < 60; ++i, ++states) {
      const VectorXd q = random_shape(model, random);
      const VectorXd qd = random.vector(model.num_coordinates(), random.logarithmic(1e-6, 10.0));
      const VectorXd command = random_command(model, q, 50.0, random);
      const VectorXd tension = tensions_of(model, q, qd, command);
      VectorXd w = random.vector(model.num_cables(), random.logarithmic(1e-8, 1e-2));
      const double spring = robot.presliding_stiffness * w.lpNorm<Eigen::Infinity>();
      beyond += spring > tension.maxCoeff() ? 1 : 0;
      const double scale = (tension.sum() + spring) *
                           (model.actuation_matrix().cwiseAbs().transpose() * qd.cwiseAbs()).sum();
      const double heat = friction_power(model, q, qd, command, w);
      if (!(heat >= worst * scale)) worst = heat / scale;
      taking += heat > power_rounding * scale ? 1 : 0;
    }
  }
  MESSAGE(states << " states, in " << taking << " it takes power, in " << beyond
                 << " the deflection is beyond all friction; least heat over its scale " << worst);
  CHECK(worst >= -power_rounding * tolerance_scale());
  CHECK(taking > states / 4);
  CHECK(beyond > states / 20);
}

TEST_CASE("the work of friction is its heat and what deflections store") {
  Random random;
  INFO(random);
  Robot robot = rubbing_chain(random, 3);
  robot.presliding_stiffness = 1e4;
  const Model model(robot);
  for (int i = 0; i < 50; ++i) {
    const VectorXd q = random_shape(model, random), qd = random.vector(6, 1.0);
    const VectorXd command = random_command(model, q, 20.0, random);
    const VectorXd w = random.vector(model.num_cables(), 1e-3);
    VectorXd force(6), rate(model.num_cables());
    cable_force(model, q, qd, command, w, force, rate);
    const VectorXd tension = tensions_of(model, q, qd, command);
    const double pulls = tension.dot(model.actuation_matrix().transpose() * qd);
    const double stored = robot.presliding_stiffness * w.dot(rate);
    const double heat = friction_power(model, q, qd, command, w);
    const double scale =
        tension.dot(model.actuation_matrix().cwiseAbs().transpose() * qd.cwiseAbs()) +
        std::abs(stored);
    CHECK(residual(pulls - force.dot(qd), heat + stored, scale) <= tolerance::cancelled);
  }
}

TEST_CASE("without friction the cables pull as if there were none") {
  Random random;
  INFO(random);
  Robot robot = rubbing_chain(random, 3);
  for (Section& section : robot.sections) section.cable_friction = 0.0;
  for (Cable& cable : robot.cables) cable.friction = 0.0;
  const Model smooth(robot);
  robot.cables.back().entry_friction = 1e-300;
  robot.presliding_stiffness = 1e4;
  const Model remembering(robot);
  CHECK(smooth.num_deflections() == 0);
  CHECK(remembering.num_deflections() == remembering.num_cables());
  const VectorXd q = random_shape(smooth, random), qd = random.vector(6, 3.0);
  const VectorXd command = random_command(smooth, q, 20.0, random);
  VectorXd force(6), rate(command.size());
  cable_force(remembering, q, qd, command, VectorXd::Constant(command.size(), 1e-3), force, rate);
  const VectorXd tension = tensions_of(smooth, q, qd, command);
  CHECK(residual(force, cable_force_of(smooth, q, qd, command),
                 largest(smooth.actuation_matrix().cwiseAbs() * tension)) <= tolerance::cancelled);
}

TEST_CASE("cables side by side pull as one after the other") {
  Random random;
  INFO(random);
  for (int robots = 0; robots < 60; ++robots) {
    Robot robot = rubbing_chain(random, 1 + robots % 5);
    robot.presliding_stiffness = random.logarithmic(1e2, 1e6);
    const bool alike = robots % 3 == 0;
    for (Cable& cable : robot.cables) {
      if (alike) cable.friction = 0.2;
      if (random.integer(0, 2) == 0) cable.start_section = random.integer(0, cable.end_section);
      cable.entry_friction = random.integer(0, 1) * random.uniform(0.0, 3.0);
      cable.sheath_friction = random.integer(0, 1) * random.uniform(0.0, 0.5);
      cable.viscosity = random.integer(0, 1) * random.uniform(0.0, 5.0);
    }
    const Model model(robot);
    const Index d = model.num_coordinates(), m = model.num_cables();
    const VectorXd q = random_shape(model, random), qd = random.vector(d, 3.0);
    const VectorXd command = random_command(model, q, 50.0, random);
    const VectorXd w = random.vector(m, random.logarithmic(1e-8, 1e-2));
    VectorXd force = VectorXd::Zero(d), rate(m);
    detail::CableGeometry<double> geometry(model, q.data());
    for (Index j = 0; j < m; ++j) {
      geometry.set_cable(j);
      detail::add_memory_force(model, geometry, j, qd.data(), double{command[j]}, double{w[j]},
                               force.data(), rate[j]);
    }
    double pull = tensions_of(model, q, qd, command).sum();
    for (Index j = 0; j < m; ++j) {  // differences of lengths
      pull += model.cables()[static_cast<std::size_t>(j)].stiffness * model.straight_lengths()[j];
    }
    pull *= model.actuation_matrix().cwiseAbs().maxCoeff();
    for (int lanes = 2; lanes <= detail::num_lanes; lanes += 2) {
      VectorXd forces(d), rates(m);
      detail::memory_force_of_arcs(model, q.data(), qd.data(), command.data(), w.data(),
                                   forces.data(), rates.data(), lanes);
      CHECK(residual(forces, force, pull) <= tolerance::cancelled);
      CHECK(residual(rates, rate, qd.lpNorm<1>() * model.actuation_matrix().cwiseAbs().sum()) <=
            tolerance::cancelled);
    }
  }
}

TEST_CASE("a cable that begins to slide follows the closed form to full friction") {
  // dw/dx = 1 - g(h), h = k w/f: straight up to h0, then h = h0 + (1 - h0) tanh.
  const double f = 2.0, k = 1e4, h0 = detail::elastic_share;
  const double step = 1e-8;
  double w = 0.0;
  for (int i = 1; i <= 80000; ++i) {
    const auto rate = [&](double at) { return detail::deflection_rate(k * at, 1.0, at_entry(f)); };
    const double k1 = rate(w), k2 = rate(w + 0.5 * step * k1), k3 = rate(w + 0.5 * step * k2),
                 k4 = rate(w + step * k3);
    w += step / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
    if (i % 4000 != 0) continue;
    const double x = k * step * i / f;
    const double h = x < h0 ? x : h0 + (1.0 - h0) * std::tanh((x - h0) / (1.0 - h0));
    CHECK(residual(k * w / f, h, 1.0) <= 1e-9);
  }
  CHECK(k * w / f > 0.999);
}

TEST_CASE("back and forth below half of the friction nothing drifts") {
  const double f = 2.0, k = 1e4;
  double w = 0.25 * f / k;
  const double before = w;
  for (int i = 0; i < 100000; ++i) {
    const double u = i % 2 == 0 ? 1.0 : -1.0;
    w += 1e-6 * detail::deflection_rate(k * w, u, at_entry(f));
  }
  CHECK(residual(w, before) <= 1e-9);
}

TEST_CASE("a swing loses twice the friction over the stiffness each half turn, then sticks") {
  // A constant friction f at the entry under a constant pull: each half swing ends 2 r f/K nearer
  // to the rest, whatever the inertia, and the first that is within r f/K of it stays.
  Robot robot = one_cable(1e7);
  robot.cables[0].entry_friction = 0.5;
  const Model model(robot);
  const double K = model.stiffness()[0], r = model.actuation_matrix()(0, 0), F = 6.0;
  const double rest = r * F / K, loss = r * 0.5 / K;
  VectorXd q0(2);
  q0 << rest + 7.4 * loss, 0.0;
  Events turns(1);
  turns[0].function = [](double, const ConstVectorRef&, const ConstVectorRef& qd) { return qd[0]; };
  const Trajectory run = simulate(model, q0, VectorXd::Zero(2), even_times(0.0, 6.0, 601),
                                  CommandInput::constant(VectorXd::Constant(1, F)), Method::dopri5,
                                  tolerances(1e-9, 1e-11), make_integrator, {}, {}, turns);
  REQUIRE(run.status == Status::ok);
  double expected = 7.4;
  Index seen = 0;
  for (const EventRecord& turn : run.events) {
    if (turn.time < 1e-3) continue;
    if (expected <= 1.0) break;
    expected -= 2.0;
    const double sign = seen++ % 2 == 0 ? -1.0 : 1.0;
    CHECK(residual(turn.q[0], rest + sign * expected * loss, loss) <= 2e-2);
    expected = std::abs(expected);
  }
  CHECK(seen >= 3);
  const Index last = run.t.size() - 1;
  CHECK(std::abs(run.q(last, 0) - rest) <= 1.01 * loss);
}

TEST_CASE("held by friction it does not creep, where the law of the sliding speed does") {
  Robot robot = one_cable(1e5);
  robot.cables[0].entry_friction = 1.0;
  robot.sections[0].damping = 0.05;
  const auto drift = [](const Robot& of) {
    const Model model(of);
    MatrixXd tension(4, 1);
    tension << 0.0, 10.0, 9.5, 9.5;  // 0.5 N is half of what friction holds
    const auto input = CommandInput::table(Eigen::Vector4d(0.0, 2.0, 3.0, 30.0), tension,
                                           CommandInput::Interpolation::linear);
    const Trajectory run =
        simulate(model, VectorXd::Zero(2), VectorXd::Zero(2), Eigen::Vector3d(0.0, 5.0, 30.0),
                 input, Method::dopri5, tolerances(1e-8, 1e-10));
    REQUIRE(run.status == Status::ok);
    return std::abs(run.q(2, 0) - run.q(1, 0));
  };
  const double remembering = drift(robot);
  robot.presliding_stiffness = 0.0;
  const double forgetting = drift(robot);
  MESSAGE("over 25 s it creeps by " << remembering << " rad with memory, without by "
                                    << forgetting);
  CHECK(remembering < 1e-8);
  CHECK(forgetting > 1e-3);
}

TEST_CASE("simulator and runs have one law, and the simulator allocates nothing") {
  Robot robot = parts_with_cables(3, 3e3, 2.0);
  for (Section& section : robot.sections) {
    section.cable_friction = 0.2;
    section.damping = 5e-3;
    section.cable_entry_friction = 0.1;
    section.cable_viscosity = 0.3;
    section.cable_pretension = 2.0;
    section.cable_backlash = 2e-4;
  }
  robot.presliding_stiffness = 2e3;
  const Model model(robot);
  const Index m = model.num_cables();
  MatrixXd lengths(2, m);
  const VectorXd straight = rest_command_of(model);
  for (Index j = 0; j < m; ++j) {
    lengths(0, j) = straight[j] - (j % 3 == 0 ? 6e-4 : 0.0);
    lengths(1, j) = straight[j] - (j % 3 == 1 ? 4e-4 : 0.0);
  }
  const auto input = CommandInput::table(Eigen::Vector2d(0.0, 0.1), lengths,
                                         CommandInput::Interpolation::previous);
  const VectorXd zero = VectorXd::Zero(6);
  const VectorXd times = even_times(0.0, 0.2, 3);
  const Trajectory fixed = simulate(model, zero, zero, times, input, Method::rk4, fixed_step(5e-4));
  const Trajectory adaptive =
      simulate(model, zero, zero, times, input, Method::dopri5, tolerances(1e-9, 1e-11));
  REQUIRE(fixed.status == Status::ok);
  REQUIRE(adaptive.status == Status::ok);
  Simulator simulator(model, 5e-4);
  simulator.reset(zero, zero);
  for (int i = 0; i < 400; ++i) {
    const VectorXd command = lengths.row(i < 200 ? 0 : 1).transpose();
    Status status = Status::ok;
    CHECK(allocations_of([&] { status = simulator.step(command); }) == 0);
    REQUIRE(status == Status::ok);
  }
  CHECK(residual(simulator.q(), fixed.q.row(2).transpose()) <= 1e-10);
  CHECK(residual(simulator.deflection(), fixed.deflection.row(2).transpose()) <= 1e-8);
  CHECK(residual(adaptive.q.row(2).transpose(), fixed.q.row(2).transpose()) <= past_kinks);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
