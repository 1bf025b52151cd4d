// Equilibria: the closed form without gravity, stability with it, and searches that must fail.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "cdcr/coordinates.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/statics.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/throws.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

Robot with_gravity(double g_z, double payload = 0.0) {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, g_z};
  robot.payload = payload;
  return robot;
}

VectorXd pull_first(double tension) {
  return Eigen::Vector3d(tension, 0.0, 0.0);
}

double degrees(const VectorXd& q) {
  return q.norm() * 180.0 / pi;
}

/// Residual and eigenvalues are what they claim to be.
void check_truthful(const Model& model, const VectorXd& tension, const Equilibrium& found) {
  Data data(model);
  VectorXd gradient(2);
  MatrixXd hessian(2, 2);
  potential_gradient(model, data, found.q, gradient);
  potential_hessian(model, data, found.q, hessian);
  const VectorXd force = model.actuation_matrix() * tension;
  CHECK(residual(found.residual, largest(gradient - force), largest(gradient) + largest(force)) <=
        tolerance::rounding);
  const VectorXd eigen = Eigen::SelfAdjointEigenSolver<MatrixXd>(hessian).eigenvalues();
  CHECK(residual(found.eigenvalues, eigen) <= tolerance::rounding);
  CHECK(found.stable == (eigen.minCoeff() > 1e-12 * eigen.maxCoeff()));
}

TEST_SUITE_BEGIN("statics");

TEST_CASE("5 N on cable 1 bend the robot of Table 1 by F r l / (E I) = 14.9778 degrees") {
  const Model model(amouri2020());
  const Equilibrium found = equilibrium(model, pull_first(5.0));
  REQUIRE(found.status == Status::ok);
  const double EI = 9.5e9 * pi * std::pow(0.005, 4) / 64.0;
  CHECK(residual(found.q, Eigen::Vector2d(5.0 * 0.019 * 0.802 / EI, 0.0)) <= tolerance::rounding);
  CHECK(std::abs(degrees(found.q) - 14.9778) < 0.00005);
  CHECK(found.stable);
  CHECK(residual(found.eigenvalues, Eigen::Vector2d::Constant(model.stiffness()[0])) <=
        tolerance::rounding);
  check_truthful(model, pull_first(5.0), found);
}

TEST_CASE("with gravity 5 N bend it more when it stands and less when it hangs") {
  // Linearised about straight: 19.7 and 12.1 degrees; the true angles differ in the second digit.
  const Model upright(with_gravity(-9.81)), hanging(with_gravity(9.81));
  for (const Model* model : {&upright, &hanging}) {
    const Equilibrium found = equilibrium(*model, pull_first(5.0));
    REQUIRE(found.status == Status::ok);
    CHECK(found.stable);
    CHECK(residual(found.residual, 0.0, 5.0 * 0.019) <= tolerance::at_rest);
    CHECK(std::abs(found.q[1]) <= tolerance::at_rest);
    CHECK(std::abs(degrees(found.q) - (model == &upright ? 19.7 : 12.1)) < 0.3);
    check_truthful(*model, pull_first(5.0), found);
  }
}

TEST_CASE("sample robots come to rest in a stable place under any tensions") {
  for_each_case(2.0 * pi, [](const Model& model, Data&, const State& state) {
    if (model.num_cables() > 3) return;  // 16 strong cables ask for more than the bending limit
    const VectorXd tension = 0.3 * state.tension;
    const Equilibrium found = equilibrium(model, tension, state.q);
    check_truthful(model, tension, found);
    if (found.status != Status::ok) return;
    double mass = model.robot().payload;
    const Section& section = model.robot().sections[0];
    mass += section.backbone_mass + section.num_disks * section.disk_mass;
    const double scale = model.stiffness()[0] * (1.0 + found.q.norm()) +
                         mass * section.length * model.robot().gravity.norm();
    CHECK(residual(found.residual, 0.0, scale) <= tolerance::at_rest);
    CHECK(found.q.norm() <= max_bending);
  });
}

TEST_CASE("an upright robot with a heavy payload cannot stand straight") {
  const Model model(with_gravity(-9.81, 0.5));
  const VectorXd none = VectorXd::Zero(3);

  const Equilibrium straight = equilibrium(model, none);
  CHECK(straight.status == Status::ok);
  CHECK(straight.q == Eigen::Vector2d::Zero());
  CHECK_FALSE(straight.stable);
  CHECK(straight.eigenvalues[1] < 0.0);
  check_truthful(model, none, straight);

  const Eigen::Vector2d nudge(1e-3, 2e-3);
  const Equilibrium bent = equilibrium(model, none, nudge);
  CHECK(bent.status == Status::ok);
  CHECK(bent.q.norm() > 0.5);
  CHECK(bent.eigenvalues[1] > 0.0);
  check_truthful(model, none, bent);
  // It falls the way it was pushed; turning it about Z costs nothing, hence one eigenvalue of 0.
  CHECK(residual(bent.q[0] * nudge[1] - bent.q[1] * nudge[0], 0.0, nudge.norm()) <= 1e-9);
  CHECK(residual(bent.eigenvalues[0], 0.0, model.stiffness()[0]) <= tolerance::at_rest);
}

TEST_CASE("a bent equilibrium held in one plane is stable") {
  const Model model(with_gravity(-9.81, 0.5));
  const Equilibrium found = equilibrium(model, pull_first(1.0));
  CHECK(found.status == Status::ok);
  CHECK(found.stable);
  CHECK(found.q[0] > 0.5);
  CHECK(std::abs(found.q[1]) <= tolerance::at_rest);
  check_truthful(model, pull_first(1.0), found);
}

TEST_CASE("no equilibrium within the bending limit is a status, not an answer") {
  const Model model(amouri2020());
  const Equilibrium found = equilibrium(model, pull_first(1000.0));
  CHECK(found.status == Status::bending_limit);
  CHECK(found.q.allFinite());
  CHECK(found.q.norm() <= max_bending);
}

TEST_CASE("a start beyond the bending limit still finds the equilibrium there is") {
  const Model model(amouri2020());
  const Equilibrium found = equilibrium(model, pull_first(5.0), Eigen::Vector2d(20.0, 0.0));
  CHECK(found.status == Status::ok);
  CHECK(std::abs(degrees(found.q) - 14.9778) < 0.00005);
}

TEST_CASE("without cables the weight alone bends the robot") {
  Robot robot = with_gravity(0.0);
  robot.gravity = {-9.81, 0.0, 0.0};
  robot.sections[0].cable_angles.clear();
  const Model model(robot);
  const Equilibrium found = equilibrium(model, VectorXd(0));
  CHECK(found.status == Status::ok);
  CHECK(found.stable);
  CHECK(found.q[0] < -0.1);
  CHECK(found.q[1] == 0.0);
}

TEST_CASE("a robot without inertia has statics") {
  Robot robot = amouri2020();
  robot.sections[0].backbone_mass = robot.sections[0].disk_mass = 0.0;
  const Equilibrium found = equilibrium(Model(robot), pull_first(5.0));
  CHECK(found.status == Status::ok);
  CHECK(std::abs(degrees(found.q) - 14.9778) < 0.00005);
}

TEST_CASE("bad arguments are refused with a sentence") {
  const Model model(amouri2020());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_SENTENCE(equilibrium(model, Eigen::Vector2d(1.0, 2.0)),
                        "tension must be 3 finite values >= 0 N (a cable cannot push), got [1 2]");
  CHECK_THROWS_SENTENCE(equilibrium(model, Eigen::Vector3d(1.0, -2.0, 0.0)),
                        "tension must be 3 finite values >= 0 N (a cable cannot push), got "
                        "[ 1 -2  0]");
  CHECK_THROWS_SENTENCE(equilibrium(model, pull_first(nan)),
                        "tension must be 3 finite values >= 0 N (a cable cannot push), got "
                        "[nan   0   0]");
  CHECK_THROWS_SENTENCE(equilibrium(model, pull_first(1.0), Eigen::Vector3d(1.0, 2.0, 3.0)),
                        "q0 must be 2 finite values, got [1 2 3]");
  CHECK_THROWS_SENTENCE(equilibrium(model, pull_first(1.0), Eigen::Vector2d(nan, 0.0)),
                        "q0 must be 2 finite values, got [nan   0]");
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
