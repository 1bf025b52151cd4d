// Laws of motion that hold for any robot in any state, for every kind of section: by the public
// functions, and by the recursions over arcs and over rods.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "support/differences.hpp"
#include "support/residual.hpp"
#include "support/subjects.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

const std::vector<int> all_numbers = {1, 2, 3, 8, 20, 32};
const std::vector<int> few_numbers = {1, 2, 3, 8};

VectorXd moved(const VectorXd& q, Index k, double step) {
  VectorXd at = q;
  at[k] += step;
  return at;
}

/// Size of what inertia can do to each coordinate: sqrt(M_kk) times the root of twice the energy
/// times the turning rate.
VectorXd inertial_scale(const MatrixXd& M, const VectorXd& qd) {
  return std::sqrt(qd.dot(M * qd)) * qd.cwiseAbs().sum() * M.diagonal().cwiseSqrt();
}

TEST_SUITE_BEGIN("laws");

TEST_CASE("the mass matrix is symmetric, positive definite, and half the energy's Hessian") {
  for_each_subject(all_numbers, [](Subject& robot, const Model&, const LawState& s) {
    const MatrixXd M = robot.mass_matrix(s.q);
    CHECK(M == M.transpose());
    const VectorXd root = M.diagonal().cwiseSqrt();
    const MatrixXd scaled = root.cwiseInverse().asDiagonal() * M * root.cwiseInverse().asDiagonal();
    CHECK(Eigen::SelfAdjointEigenSolver<MatrixXd>(scaled).eigenvalues().minCoeff() > 0.0);
    const double scale = root.dot(s.qd.cwiseAbs());
    CHECK(residual(robot.kinetic(s.q, s.qd), 0.5 * s.qd.dot(M * s.qd), scale * scale) <=
          tolerance::recursion);
  });
}

TEST_CASE("inverse dynamics is M qdd + h, column by column") {
  for_each_subject(all_numbers, [](Subject& robot, const Model&, const LawState& s) {
    const MatrixXd M = robot.mass_matrix(s.q);
    const VectorXd h = robot.bias(s.q, s.qd);
    CHECK(residual(robot.inverse(s.q, s.qd, VectorXd::Zero(s.q.size())), h) <=
          tolerance::recursion);
    for (Index k = 0; k < s.q.size(); ++k) {
      // So large that h is beside it.
      const double qdd = 1e3 * (1.0 + h.norm() / M.col(k).norm());
      const VectorXd force = robot.inverse(s.q, s.qd, qdd * VectorXd::Unit(s.q.size(), k));
      CHECK(residual((force - h) / qdd, M.col(k), largest(M)) <= tolerance::recursion);
    }
  });
}

TEST_CASE("forward dynamics undoes inverse dynamics, and the other way round") {
  Random random;
  for_each_subject(all_numbers, [&](Subject& robot, const Model& model, const LawState& s) {
    const MatrixXd M = robot.mass_matrix(s.q);
    const VectorXd h = robot.bias(s.q, s.qd);
    const MatrixXd inverse = M.inverse();
    const VectorXd qdd = random.vector(s.q.size(), 100.0);
    const VectorXd felt = M.cwiseAbs() * qdd.cwiseAbs() + h.cwiseAbs();
    const VectorXd found = robot.forward(s.q, s.qd, robot.inverse(s.q, s.qd, qdd));
    CHECK(residual(found, qdd, largest(inverse.cwiseAbs() * felt)) <= tolerance::recursion);

    const VectorXd force = robot.select(model.actuation_matrix() * s.whole.tension);
    const VectorXd qdd_of_force = robot.forward(s.q, s.qd, force);
    const VectorXd moving = M.cwiseAbs() * inverse.cwiseAbs() * (force.cwiseAbs() + h.cwiseAbs());
    CHECK(residual(robot.inverse(s.q, s.qd, qdd_of_force), force, largest(moving)) <=
          tolerance::recursion);
  });
}

TEST_CASE("bias at rest is the gradient of the potential energy") {
  for_each_subject(all_numbers, [](Subject& robot, const Model& model, const LawState& s) {
    const VectorXd rest = VectorXd::Zero(s.q.size());
    CHECK(residual(robot.bias(s.q, rest), robot.gradient(s.q)) <= tolerance::recursion);
    const double stiffest = model.stiffness().maxCoeff();
    for (Index k = 0; k < s.q.size(); ++k) {
      const double slope =
          difference([&](double step) { return robot.potential(moved(s.q, k, step)); }, 0.02);
      const double energy = std::abs(robot.potential(s.q)) + s.weight + stiffest;
      CHECK(residual(slope, robot.gradient(s.q)[k], energy) <= tolerance::recursion_differences);
    }
  });
}

TEST_CASE("bias is Lagrange's") {
  for_each_subject(few_numbers, [](Subject& robot, const Model& model, const LawState& s) {
    const MatrixXd M = robot.mass_matrix(s.q);
    // d/dt (M qd) at qdd = 0, - dT/dq + dU/dq + c qd
    const double step = 0.02 / largest(s.qd);
    VectorXd h = difference(
        [&](double t) { return VectorXd(robot.mass_matrix(s.q + t * s.qd) * s.qd); }, step);
    for (Index k = 0; k < s.q.size(); ++k) {
      h[k] -= difference([&](double by) { return robot.kinetic(moved(s.q, k, by), s.qd); }, 0.02);
    }
    h += robot.gradient(s.q);
    h += robot.damped(model, s.whole.qd);
    const VectorXd found = robot.bias(s.q, s.qd);
    const double scale = largest(inertial_scale(M, s.qd)) + largest(found) + s.weight;
    CHECK(residual(found, h, scale) <= tolerance::lagrange);
  });
}

TEST_CASE("every kind moves as the robot of arcs that it stands for") {
  for_each_subject(all_numbers, [](Subject& robot, const Model& model, const LawState& s) {
    if (!robot.moves_as_arcs()) return;
    Library arcs(model);
    const MatrixXd M = robot.mass_matrix(s.q);
    CHECK(residual(M, arcs.mass_matrix(s.q)) <= tolerance::recursion);
    const VectorXd h = arcs.bias(s.q, s.qd);
    const double scale = largest(inertial_scale(M, s.qd)) + largest(h) + s.weight;
    CHECK(residual(robot.bias(s.q, s.qd), h, scale) <= tolerance::recursion);
    const double U = arcs.potential(s.q);
    CHECK(residual(robot.potential(s.q), U, std::abs(U) + s.weight) <= tolerance::recursion);
    const double T = arcs.kinetic(s.q, s.qd);
    const double size = M.diagonal().cwiseSqrt().dot(s.qd.cwiseAbs());
    CHECK(residual(robot.kinetic(s.q, s.qd), T, size * size) <= tolerance::recursion);
    const VectorXd gradient = arcs.gradient(s.q);
    CHECK(residual(robot.gradient(s.q), gradient, largest(gradient) + s.weight) <=
          tolerance::recursion);
  });
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
