// Robots that follow commands slowly: each cable sticks or slides, and what comes of it has closed
// forms.
#include <doctest/doctest.h>

#include <cmath>

#include "cdcr/quasi_static.hpp"
#include "cdcr/simulator.hpp"
#include "cdcr/statics.hpp"
#include "support/cable_robots.hpp"
#include "support/controlled_robots.hpp"
#include "support/residual.hpp"
#include "support/rod_robots.hpp"
#include "support/throws.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

/// Two searches for one point of rest, which end at the rounding of what is in balance.
constexpr double two_rests = 1e-10;
/// A cable that sticks gives way by a three-thousandth of what the robot would.
constexpr double stuck = 2e-3;

/// Table 1 with one cable.
Robot one_cable() {
  Robot robot = amouri2020();
  robot.sections[0].cable_angles = {0.0};
  return robot;
}

RowMatrixXd there_and_back(double most, Index count) {
  RowMatrixXd commands(2 * count + 1, 1);
  for (Index i = 0; i <= 2 * count; ++i) {
    commands(i, 0) =
        most * static_cast<double>(i <= count ? i : 2 * count - i) / static_cast<double>(count);
  }
  return commands;
}

/// theta where K theta = r F (1 - e^-z)/z with z = mu theta, mu < 0 where paid out.
double pulled_angle(double stiffness, double radius, double F, double mu) {
  double theta = radius * F / stiffness;
  for (int i = 0; i < 200; ++i) {
    const double z = mu * theta;
    theta = radius * F / stiffness * (z == 0.0 ? 1.0 : -std::expm1(-z) / z);
  }
  return theta;
}

TEST_SUITE_BEGIN("quasi_static");

TEST_CASE("without friction it goes from one equilibrium to the next") {
  Random random;
  INFO(random);
  for (int n = 1; n <= 4; ++n) {
    Robot robot = parts_with_cables(n, n % 2 == 0 ? 2e3 : 0.0, 0.0);
    robot.gravity = {0.0, 0.0, 9.81};
    const Model model(robot);
    RowMatrixXd commands(8, model.num_cables());
    const VectorXd straight = rest_command_of(model);
    for (Index i = 0; i < commands.rows(); ++i) {
      const VectorXd pull = random.vector(model.num_cables(), 1.0).cwiseAbs();
      commands.row(i) = (n % 2 == 0 ? VectorXd(straight - 4e-3 * pull) : VectorXd(3.0 * pull));
    }
    const QuasiStatic run = quasi_static(model, commands);
    REQUIRE(run.status == Status::ok);
    VectorXd q;
    for (Index i = 0; i < commands.rows(); ++i) {
      q = equilibrium(model, commands.row(i).transpose(), q).q;
      CHECK(residual(run.q.row(i).transpose(), q, 1.0) <= two_rests);
      CHECK(run.friction.row(i).isZero(0.0));
    }
  }
}

TEST_CASE("pulled and let go, one section turns as the capstan has it, and sticks in between") {
  const double mu = 0.4, most = 20.0;
  Robot robot = one_cable();
  robot.sections[0].cable_friction = mu;
  robot.presliding_stiffness = 1e6;
  const Model model(robot);
  const RowMatrixXd commands = there_and_back(most, 40);
  const QuasiStatic run = quasi_static(model, commands);
  REQUIRE(run.status == Status::ok);
  const double K = model.stiffness()[0], r = model.actuation_matrix()(0, 0);
  int sticking = 0;
  for (Index i = 1; i < commands.rows() - 1; ++i) {
    const double F = commands(i, 0), theta = run.q(i, 0);
    const auto sliding = static_cast<int>(run.sliding[static_cast<std::size_t>(i)]);
    if (sliding == 0) {
      ++sticking;
      CHECK(residual(theta, run.q(i - 1, 0), run.q(i - 1, 0)) <= stuck);
      continue;
    }
    CHECK(sliding == (i <= 40 ? 1 : -1));
    CHECK(residual(theta, pulled_angle(K, r, F, sliding * mu), 1.0) <= two_rests);
    CHECK(residual(run.end_tension(i, 0), F * std::exp(-sliding * mu * theta), most) <= two_rests);
  }
  // It slides back where F e^(z/2) sinh(z/2)/(z/2) falls below what it was: e^-z of it.
  const double z = mu * run.q(40, 0);
  CHECK(sticking == static_cast<int>(40.0 * (1.0 - std::exp(-z))));
  // The second time round is the first.
  RowMatrixXd twice(2 * commands.rows() - 1, 1);
  twice << commands, commands.bottomRows(commands.rows() - 1);
  const QuasiStatic again = quasi_static(model, twice);
  CHECK(residual(again.q(120, 0), run.q(40, 0)) <= two_rests);
}

TEST_CASE("friction at the entry takes its share before the cable bends the robot") {
  Robot robot = one_cable();
  Cable cable;
  cable.radius = robot.sections[0].cable_radius;
  cable.entry_friction = 1.5;
  cable.sheath_friction = 0.2;
  robot.sections[0].cable_angles.clear();
  robot.cables = {cable};
  const Model model(robot);
  const RowMatrixXd commands = there_and_back(20.0, 10);
  const QuasiStatic run = quasi_static(model, commands);
  REQUIRE(run.status == Status::ok);
  const double K = model.stiffness()[0], r = model.actuation_matrix()(0, 0);
  CHECK(residual(run.q(10, 0), r * (20.0 - 1.5) * std::exp(-0.2) / K) <= two_rests);
  CHECK(residual(run.q(18, 0), r * (4.0 + 1.5) * std::exp(0.2) / K) <= two_rests);
  // Let go, it stays bent: the entry holds the cable.
  CHECK(residual(run.q(20, 0), r * 1.5 * std::exp(0.2) / K) <= two_rests);
}

TEST_CASE("around a loop the cables do the work that friction turns into heat") {
  Robot robot = parts_with_cables(3, 0.0, 0.0);
  robot.gravity = {0.0, 0.0, 9.81};
  for (Section& section : robot.sections) section.cable_friction = 0.3;
  const Model model(robot);
  RowMatrixXd commands(801, model.num_cables());
  for (Index i = 0; i < commands.rows(); ++i) {
    for (Index j = 0; j < model.num_cables(); ++j) {
      commands(i, j) =
          2.0 + 1.5 * std::sin(2.0 * pi * static_cast<double>(i) / 400.0 + static_cast<double>(j));
    }
  }
  const QuasiStatic run = quasi_static(model, commands);
  REQUIRE(run.status == Status::ok);
  const auto work = [&](Index from, Index to) {
    double sum = 0.0;
    for (Index i = from + 1; i <= to; ++i) {
      const VectorXd mean = 0.5 * (run.tension.row(i) + run.tension.row(i - 1)).transpose();
      sum += mean.dot(model.actuation_matrix().transpose() *
                      (run.q.row(i) - run.q.row(i - 1)).transpose());
    }
    return sum;
  };
  // From the second round on every round is alike.
  CHECK(residual(run.q.row(800).transpose(), run.q.row(400).transpose()) <= 1e-6);
  CHECK(work(400, 800) > 1e-4);
}

TEST_CASE("a drive with play follows behind it") {
  Robot robot = one_cable();
  robot.sections[0].cable_stiffness = 1e4;
  robot.sections[0].cable_pretension = 2.0;
  Robot with_play = robot;
  with_play.sections[0].cable_backlash = 1e-3;
  const Model exact(robot), loose(with_play);
  const double straight = exact.straight_lengths()[0];
  RowMatrixXd commands(4, 1);
  commands << straight, straight - 4e-3, straight - 3.2e-3, straight - 2e-3;
  RowMatrixXd felt(4, 1);
  felt << straight, straight - 3.5e-3, straight - 3.5e-3, straight - 2.5e-3;
  const QuasiStatic run = quasi_static(loose, commands);
  const QuasiStatic same = quasi_static(exact, felt);
  REQUIRE(run.status == Status::ok);
  CHECK(residual(run.felt, felt) <= tolerance::rounding);
  CHECK(residual(run.q, same.q) <= two_rests);
  CHECK(residual(same.tension(0, 0), 2.0 + 1e4 * (lengths_of(exact, same.q.row(0).transpose())[0] -
                                                  straight)) <= two_rests);
  CHECK(same.tension(0, 0) > 0.1);
}

TEST_CASE("slow motion with memory is where it says") {
  Robot robot = one_cable();
  robot.sections[0].cable_friction = 0.4;
  robot.sections[0].damping = 5e-2;
  robot.presliding_stiffness = 2e5;
  const Model model(robot);
  Simulator simulator(model, 1e-3);
  simulator.reset(VectorXd::Zero(2), VectorXd::Zero(2));
  const RowMatrixXd commands = there_and_back(10.0, 8);
  const QuasiStatic run = quasi_static(model, commands);
  for (Index i = 1; i < commands.rows(); ++i) {
    for (int k = 1; k <= 10000; ++k) {
      const double share = k / 10000.0;
      const VectorXd F = (1.0 - share) * commands.row(i - 1) + share * commands.row(i);
      REQUIRE(simulator.step(F) == Status::ok);
    }
    // Behind by what damping takes, and by the bristles' way into sliding.
    CHECK(residual(simulator.q()[0], run.q(i, 0), run.q(8, 0)) <= 3e-2);
  }
}

TEST_CASE("at rest under its weight alone, tilted or bent by itself") {
  std::vector<Robot> robots;
  robots.push_back(upright(3));
  robots.back().gravity = {9.81, 0.0, 0.0};
  robots.push_back(upright(3));
  robots.back().gravity = {3.0, -4.0, -8.0};
  robots.push_back(rod_robot());
  robots.back().gravity = {6.0, 2.0, -7.0};
  robots.push_back(rod_robot());
  robots.back().sections[0].rest_bending = {0.4, -0.3};
  for (const Robot& robot : robots) {
    const Model model(robot);
    VectorXd none(model.num_cables());
    rest_command(model, none);
    const RowMatrixXd commands = none.transpose().replicate(4, 1);
    const QuasiStatic run = quasi_static(model, commands);
    REQUIRE(run.status == Status::ok);
    const Equilibrium rest = equilibrium(model, none);
    REQUIRE(rest.status == Status::ok);
    for (Index i = 0; i < 4; ++i) {
      CHECK(residual(VectorXd(run.q.row(i).transpose()), rest.q, 1.0) <= two_rests);
    }
  }
}

TEST_CASE("what cannot be followed is said") {
  const Model model(one_cable());
  const VectorXd none;
  CHECK_THROWS_WITH(static_cast<void>(quasi_static(model, RowMatrixXd(2, 2))),
                    doctest::Contains("commands must have one column for each of the 1 cables"));
  CHECK_THROWS_WITH(static_cast<void>(quasi_static(model, RowMatrixXd(0, 1))),
                    doctest::Contains("commands must have at least one row, got none"));
  RowMatrixXd commands(3, 1);
  commands << 1.0, 2.0, 5e3;
  const QuasiStatic run = quasi_static(model, commands);
  CHECK(run.status == Status::not_converged);
  CHECK(run.q.rows() == 2);
  CHECK(run.message.find("Stopped before sample 3 of 3 (not_converged)") == 0);
}

TEST_CASE("a pose takes few steps of Newton's method, whatever sticks and slides") {
  // Some five. They would be twice as many without what friction does with the turns.
  for (const double stiffness : {0.0, 5e3}) {
    CAPTURE(stiffness);
    Robot robot = parts_with_cables(3, stiffness, 0.0);
    robot.gravity = {0.0, 0.0, 9.81};
    for (Section& section : robot.sections) section.cable_friction = 0.2;
    const Model model(robot);
    const VectorXd straight = rest_command_of(model);
    RowMatrixXd commands(500, model.num_cables());
    for (Index i = 0; i < commands.rows(); ++i) {
      for (Index j = 0; j < model.num_cables(); ++j) {
        const double wave = 1.0 + std::sin(0.0251 * static_cast<double>((1 + j % 3) * i + 50 * j));
        commands(i, j) = straight[j] + (stiffness > 0.0 ? -1e-3 : 2.0) * wave;
      }
    }
    const QuasiStatic run = quasi_static(model, commands);
    REQUIRE(run.status == Status::ok);
    MESSAGE(run.iterations, " steps for ", commands.rows(), " poses");
    CHECK(run.iterations <= 7 * commands.rows());
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
