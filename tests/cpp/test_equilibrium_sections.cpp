// Equilibria of several sections: every load balanced, every draw of commands answered.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <string>

#include "cdcr/cables.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/statics.hpp"
#include "support/cases.hpp"
#include "support/chain_cases.hpp"
#include "support/residual.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

/// Unbalanced moment over the moments in balance: rounding, through searches that stall on it.
constexpr double balanced = 1e-12;
/// Stiffness against differences of sixth order in steps of 0.01 rad.
constexpr double by_differences = 1e-9;

constexpr int num_draws = 10000;

/// The two-section robot of Rao et al. (2021), doi 10.3389/frobt.2020.630245: without mass.
Robot rao2021() {
  Section section;
  section.length = 0.2;
  section.backbone_diameter = 0.0014;
  section.youngs_modulus = 54e9;
  section.num_disks = 10;
  section.cable_radius = 0.01;
  section.cable_angles = {0.0, 2.0 * pi / 3.0, 4.0 * pi / 3.0};
  Robot robot;
  robot.sections = {section, section};
  return robot;
}

/// The same with a backbone of Nitinol, disks of one gram and a payload of 20 g, standing.
Robot heavy_rao2021() {
  Robot robot = rao2021();
  for (Section& section : robot.sections) {
    section.backbone_mass = 6450.0 * pi / 4.0 * 0.0014 * 0.0014 * 0.2;
    section.disk_mass = 1e-3;
    section.disk_diameter = 0.02;
  }
  robot.payload = 0.02;
  robot.gravity = {0.0, 0.0, -9.81};
  return robot;
}

/// What holds the robot in q beside what pulls there, by the functions of dynamics.
VectorXd unbalanced(const Model& model, const VectorXd& q, const VectorXd& command,
                    const Wrenches& wrenches) {
  Data data(model);
  const Index m = model.num_coordinates();
  VectorXd gradient(m), force(m);
  const VectorXd rest = VectorXd::Zero(m);
  potential_gradient(model, data, q, gradient);
  cable_force(model, q, rest, command, force);
  add_wrench_force(model, q, wrenches, force);
  return gradient - force;
}

/// Size of the moments in balance.
double moments(const Model& model, const VectorXd& q, const VectorXd& command,
               const Wrenches& wrenches) {
  double size = model.stiffness().maxCoeff() * (1.0 + q.norm());
  for (Index j = 0; j < model.num_cables(); ++j) {
    const double pull = std::fmax(model.cables()[j].stiffness * model.straight_lengths()[j],
                                  model.cables()[j].length_driven() ? 0.0 : command[j]);
    size += model.actuation_matrix().col(j).norm() * pull;
  }
  double length = 0.0, mass = model.robot().payload;
  for (const Section& s : model.robot().sections) {
    length += s.length;
    mass += s.backbone_mass;
    for (const Disk& disk : s.disks()) mass += disk.mass;
  }
  for (const Wrench& w : wrenches) size += w.force.norm() * length + w.moment.norm();
  return size + mass * length * model.robot().gravity.norm();
}

/// What 10,000 draws came to.
struct Tally {
  int stable = 0;
  double largest_theta = 0.0;
  std::map<int, int> iterations;
};

/// Solves for commands drawn between two limits, about `centre`; every one must be answered.
Tally solve_draws(const std::string& name, const Robot& robot, double low, double high,
                  bool lengths) {
  const Model model(robot);
  const Index count = model.num_cables();
  std::mt19937_64 engine(2021);
  std::uniform_real_distribution<double> uniform(low, high);
  Tally tally;
  int failed = 0, unsound = 0;
  for (int draw = 0; draw < num_draws; ++draw) {
    VectorXd command = lengths ? VectorXd(model.straight_lengths()) : VectorXd::Zero(count);
    for (Index j = 0; j < count; ++j) command[j] += uniform(engine);
    const Equilibrium found = equilibrium(model, command);
    const double scale = moments(model, found.q, command, {});
    failed += found.status != Status::ok;
    unsound += !(residual(unbalanced(model, found.q, command, {}), VectorXd::Zero(2 * 2), scale) <=
                 balanced);
    tally.stable += found.stable;
    ++tally.iterations[found.iterations];
    for (Index k = 0; k < 2; ++k) {
      tally.largest_theta = std::fmax(tally.largest_theta, found.q.segment<2>(2 * k).norm());
    }
  }
  std::ostringstream text;
  for (const auto& [iterations, times] : tally.iterations)
    text << " " << iterations << ":" << times;
  MESSAGE(name << ": " << num_draws - failed << " of " << num_draws << " converge, " << tally.stable
               << " stable, theta up to " << tally.largest_theta << " rad; iterations:times"
               << text.str());
  CHECK(failed == 0);
  CHECK(unsound == 0);
  return tally;
}

TEST_SUITE_BEGIN("equilibrium_sections");

TEST_CASE("10,000 draws of tensions, 0 to 8 N: without weight the answer is linear at once") {
  const Tally tally = solve_draws("tensions, no weight", rao2021(), 0.0, 8.0, false);
  CHECK(tally.stable == num_draws);
  CHECK(tally.iterations.at(0) == num_draws);  // K^-1 B F is the answer
  CHECK(tally.largest_theta < max_bending);
  // Two cables of 8 N side by side are the most that a section can feel: 0.16 N m.
  CHECK(tally.largest_theta < 0.16 / Model(rao2021()).stiffness()[0]);
}

TEST_CASE("10,000 draws of tensions with weight and payload") {
  CHECK(solve_draws("tensions, standing", heavy_rao2021(), 0.0, 8.0, false).stable == num_draws);
  Robot hanging = heavy_rao2021();
  hanging.gravity *= -1.0;
  CHECK(solve_draws("tensions, hanging", hanging, 0.0, 8.0, false).stable == num_draws);
}

TEST_CASE("10,000 draws of lengths, 20 mm about straight") {
  Robot light = rao2021(), heavy = heavy_rao2021();
  for (Robot* robot : {&light, &heavy}) {
    for (Section& section : robot->sections) section.cable_stiffness = 1e4;
  }
  CHECK(solve_draws("lengths, no weight", light, -0.02, 0.02, true).stable == num_draws);
  // Slack all round, or held by one cable in its own plane, a robot that cannot stand is found
  // balanced but not stable.
  CHECK(solve_draws("lengths, standing", heavy, -0.02, 0.02, true).stable > num_draws * 9 / 10);
}

TEST_CASE("random robots under random loads: balanced, or a status that says not") {
  Random random;
  INFO(random);
  int answered = 0, asked = 0;
  for (const int n : {1, 2, 3, 5, 8}) {
    for (int round = 0; round < 3 * test_count(); ++round) {
      const Model model(random_chain(random, n));
      const Wrenches wrenches = random_wrenches(model, round % 3, random);
      VectorXd command = random.vector(model.num_cables(), 1.0).cwiseAbs();
      rest_command(model, command);
      for (Index j = 0; j < model.num_cables(); ++j) {
        if (!model.cables()[j].length_driven()) command[j] = random.uniform(0.0, 1.0);
      }
      const Equilibrium found = equilibrium(model, command, {}, wrenches);
      const double scale = moments(model, found.q, command, wrenches);
      CAPTURE(n);
      CAPTURE(static_cast<int>(found.status));
      CHECK(found.q.allFinite());
      CHECK(found.eigenvalues.allFinite());
      ++asked;
      answered += found.status == Status::ok;
      if (found.status == Status::ok) {
        const VectorXd left = unbalanced(model, found.q, command, wrenches);
        CHECK(residual(left, VectorXd::Zero(2 * n), scale) <= balanced);
      }
    }
  }
  // The others are weaker than their loads and wind up to the bending limit, or turn with a wrench.
  MESSAGE(answered << " of " << asked << " random robots under random loads come to rest");
  CHECK(answered > asked * 3 / 4);
}

TEST_CASE("the stiffness is the derivative of what is out of balance") {
  Random random;
  INFO(random);
  for (const int n : {1, 2, 4}) {
    Robot robot = random_chain(random, n);
    for (Section& section : robot.sections) section.cable_stiffness = 500.0;
    const Model model(robot);
    const Wrenches wrenches = random_wrenches(model, 3, random);
    const VectorXd q = random_bending(n, 2.0, random);
    VectorXd command(model.num_cables());
    rest_command(model, command);
    command *= 0.9;  // nothing slack nearby
    MatrixXd K(2 * n, 2 * n), expected(2 * n, 2 * n);
    static_stiffness(model, q, command, wrenches, K);
    const double h = 0.01;
    for (Index i = 0; i < 2 * n; ++i) {
      const auto at = [&](double by) {
        VectorXd moved = q;
        moved[i] += by;
        return unbalanced(model, moved, command, wrenches);
      };
      expected.col(i) = (45.0 * (at(h) - at(-h)) - 9.0 * (at(2.0 * h) - at(-2.0 * h)) +
                         at(3.0 * h) - at(-3.0 * h)) /
                        (60.0 * h);
    }
    CHECK(residual(K, expected, largest(K) + moments(model, q, command, wrenches)) <=
          by_differences);
  }
}

TEST_CASE("a slack cable does nothing, a taut one has the tension of its spring") {
  Robot robot = rao2021();
  for (Section& section : robot.sections) section.cable_stiffness = 2e3;
  const Model model(robot);
  VectorXd command = model.straight_lengths();
  command[0] -= 0.004;
  command[1] += 0.01;
  const Equilibrium found = equilibrium(model, command);
  REQUIRE(found.status == Status::ok);
  VectorXd lengths(6);
  cable_lengths(model, found.q, lengths);
  for (Index j = 0; j < 6; ++j) {
    const double pull = std::fmax(0.0, 2e3 * (lengths[j] - command[j]));
    CHECK(residual(found.tension[j], pull, 2e3 * lengths[j]) <= balanced);
  }
  CHECK(found.tension[0] > 0.0);
  CHECK(found.tension[1] == 0.0);
}

TEST_CASE("a follower force makes the stiffness unsymmetric and is balanced all the same") {
  const Model model(heavy_rao2021());
  const Wrench follower{1, 1.0, {0.1, 0.05, -0.3}, {0.0, 0.01, 0.0}, Wrench::Frame::local};
  const VectorXd none = VectorXd::Zero(6);
  const Equilibrium found = equilibrium(model, none, {}, {follower});
  REQUIRE(found.status == Status::ok);
  const double scale = moments(model, found.q, none, {follower});
  CHECK(residual(unbalanced(model, found.q, none, {follower}), VectorXd::Zero(4), scale) <=
        balanced);
  MatrixXd K(4, 4);
  static_stiffness(model, found.q, none, {follower}, K);
  CHECK(largest(K - K.transpose()) > 1e-3 * largest(K));
  const Eigen::VectorXcd values = Eigen::EigenSolver<MatrixXd>(K, false).eigenvalues();
  CHECK(residual(found.eigenvalues[0], values.real().minCoeff(), largest(K)) <= balanced);
}

TEST_CASE("where the direct way fails, a growing load leads there") {
  // Follower loads of a hundred times the stiffness wind the robot up.
  Random random;
  INFO(random);
  int gradually = 0, answered = 0;
  for (int round = 0; round < 40; ++round) {
    const Model model(heavy_rao2021());
    const Wrench strong{1, 1.0, random.vector(3, 4.0), Vector3d::Zero(), Wrench::Frame::local};
    const Equilibrium found = equilibrium(model, VectorXd::Zero(6), {}, {strong});
    CHECK(found.q.allFinite());
    CHECK(found.q.segment<2>(0).norm() <= max_bending);
    CHECK(found.q.segment<2>(2).norm() <= max_bending);
    answered += found.status == Status::ok;
    if (found.load_steps > 0) {
      CHECK(found.searches >= 2);
      gradually += found.status == Status::ok;
    }
  }
  MESSAGE(answered << " of 40 strong follower loads are answered, " << gradually
                   << " of them not directly");
  CHECK(gradually > 0);
}

TEST_CASE("a column under its own payload buckles, and is told to") {
  Robot robot = heavy_rao2021();
  robot.payload = 0.2;
  const Model model(robot);
  const VectorXd none = VectorXd::Zero(6);
  const Equilibrium straight = equilibrium(model, none);
  CHECK(straight.status == Status::ok);
  CHECK(straight.q == VectorXd::Zero(4));
  CHECK_FALSE(straight.stable);
  CHECK(straight.eigenvalues[0] < 0.0);
  const Equilibrium bent = equilibrium(model, none, Eigen::Vector4d(1e-3, 0.0, 1e-3, 0.0));
  CHECK(bent.status == Status::ok);
  CHECK(bent.q.norm() > 0.5);
  // Turning it about Z costs nothing: neutral, so not stable.
  CHECK(residual(bent.eigenvalues[0], 0.0, model.stiffness()[0]) <= balanced);
}

TEST_CASE("too much tension ends at the bending limit, in numbers") {
  const Model model(rao2021());
  VectorXd tension = VectorXd::Zero(6);
  tension[3] = 100.0;
  const Equilibrium found = equilibrium(model, tension);
  CHECK(found.status == Status::bending_limit);
  CHECK(found.q.allFinite());
  CHECK(found.q.segment<2>(0).norm() <= max_bending);
  CHECK(found.eigenvalues.allFinite());
}

TEST_CASE("wrenches that are wrong are refused") {
  const Model model(rao2021());
  Wrench beyond;
  beyond.section = 2;
  CHECK_THROWS_SENTENCE(equilibrium(model, VectorXd::Zero(6), {}, {beyond}),
                        "wrenches[0].section must be 0 to 1, got 2");
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
