// Identities that hold for any robot in any state, whatever the numbers.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include "cdcr/dynamics.hpp"
#include "dynamics/parts.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

MatrixXd mass_matrix_at(const Model& model, Data& data, const VectorXd& q) {
  MatrixXd M(q.size(), q.size());
  mass_matrix(model, data, q, M);
  return M;
}

VectorXd bias_at(const Model& model, Data& data, const State& state) {
  VectorXd h(state.q.size());
  bias(model, data, state.q, state.qd, h);
  return h;
}

VectorXd inverse_at(const Model& model, Data& data, const State& state, const VectorXd& qdd) {
  VectorXd force(state.q.size());
  inverse_dynamics(model, data, state.q, state.qd, qdd, force);
  return force;
}

VectorXd forward_at(const Model& model, Data& data, const State& state, const VectorXd& force) {
  VectorXd qdd(state.q.size());
  forward_dynamics_force(model, data, state.q, state.qd, force, qdd);
  return qdd;
}

VectorXd eigenvalues(const MatrixXd& M) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues();
}

TEST_SUITE_BEGIN("laws");

TEST_CASE("the mass matrix is symmetric and positive definite") {
  for_each_case(2.0 * pi, [](const Model& model, Data& data, const State& state) {
    const MatrixXd M = mass_matrix_at(model, data, state.q);
    CHECK(M == M.transpose());
    CHECK(eigenvalues(M).minCoeff() > 0.0);
  });
}

TEST_CASE("forward dynamics undoes inverse dynamics") {
  Random random;
  for_each_case(2.0 * pi, [&](const Model& model, Data& data, const State& state) {
    const VectorXd qdd = random.vector(2, 100.0);
    const VectorXd force = inverse_at(model, data, state, qdd);
    const VectorXd eigen = eigenvalues(mass_matrix_at(model, data, state.q));
    // M^-1 magnifies what rounding does to M qdd + h.
    const double scale =
        (eigen.maxCoeff() * qdd.norm() + bias_at(model, data, state).norm()) / eigen.minCoeff();
    CHECK(residual(forward_at(model, data, state, force), qdd, scale) <= tolerance::rounding);
  });
}

TEST_CASE("inverse dynamics undoes forward dynamics") {
  for_each_case(2.0 * pi, [](const Model& model, Data& data, const State& state) {
    const VectorXd force = model.actuation_matrix() * state.tension;
    const VectorXd qdd = forward_at(model, data, state, force);
    const VectorXd eigen = eigenvalues(mass_matrix_at(model, data, state.q));
    const double condition = eigen.maxCoeff() / eigen.minCoeff();
    const double scale = condition * (force.norm() + bias_at(model, data, state).norm());
    CHECK(residual(inverse_at(model, data, state, qdd), force, scale) <= tolerance::rounding);
  });
}

TEST_CASE("forward dynamics under tensions is that under the force B F") {
  for_each_case(2.0 * pi, [](const Model& model, Data& data, const State& state) {
    VectorXd qdd(2);
    forward_dynamics(model, data, state.q, state.qd, state.tension, qdd);
    const VectorXd force = model.actuation_matrix() * state.tension;
    CHECK(residual(qdd, forward_at(model, data, state, force)) <= tolerance::cancelled);
  });
}

TEST_CASE("inverse dynamics is M qdd + h, column by column") {
  for_each_case(2.0 * pi, [](const Model& model, Data& data, const State& state) {
    const MatrixXd M = mass_matrix_at(model, data, state.q);
    const VectorXd h = bias_at(model, data, state);
    CHECK(inverse_at(model, data, state, VectorXd::Zero(2)) == h);
    const double scale = largest(M) + largest(h);
    for (Index k = 0; k < 2; ++k) {
      const VectorXd column = inverse_at(model, data, state, VectorXd::Unit(2, k)) - h;
      CHECK(residual(column, M.col(k), scale) <= tolerance::rounding);
    }
  });
}

TEST_CASE("kinetic energy is qd^T M qd / 2") {
  for_each_case(2.0 * pi, [](const Model& model, Data& data, const State& state) {
    const MatrixXd M = mass_matrix_at(model, data, state.q);
    const double expected = 0.5 * state.qd.dot(M * state.qd);
    const double scale = M.norm() * state.qd.squaredNorm();
    CHECK(residual(kinetic_energy(model, data, state.q, state.qd), expected, scale) <=
          tolerance::rounding);
  });
}

TEST_CASE("bias at rest is the gradient of the potential energy") {
  for_each_case(2.0 * pi, [](const Model& model, Data& data, State state) {
    state.qd.setZero();
    VectorXd gradient(2);
    potential_gradient(model, data, state.q, gradient);
    CHECK(residual(bias_at(model, data, state), gradient) <= tolerance::rounding);
  });
}

TEST_CASE("the inverse of a I + b q q^T is (I - b/(a + b sigma) q q^T)/a") {
  for_each_case(2.0 * pi, [](const Model& model, Data& data, State state) {
    const double sigma = state.q.squaredNorm();
    const auto v = detail::single_of(model).table(detail::ShapeTable::Group::inertia, sigma);
    const double a = v[0], b = v[1];
    MatrixXd expected = MatrixXd::Identity(2, 2);
    expected -= b / (a + b * sigma) * state.q * state.q.transpose();
    expected /= a;

    // At q, at rest and in balance, the acceleration is M^-1 times whatever is added.
    state.qd.setZero();
    const VectorXd balance = bias_at(model, data, state);
    MatrixXd inverse(2, 2);
    for (Index k = 0; k < 2; ++k) {
      inverse.col(k) = forward_at(model, data, state, balance + VectorXd::Unit(2, k));
    }
    const double scale = largest(expected) * (1.0 + largest(balance));
    CHECK(residual(inverse, expected, scale) <= tolerance::rounding);
  });
}

TEST_CASE("damping takes c |qd|^2 from the robot") {
  for_each_case(2.0 * pi, [](const Model& model, Data& data, const State& state) {
    Robot undamped = model.robot();
    undamped.sections[0].damping = 0.0;
    const VectorXd h = bias_at(model, data, state);
    const VectorXd drag = h - bias_at(Model(undamped), data, state);
    const double expected = model.damping()[0] * state.qd.squaredNorm();
    CHECK(residual(drag.dot(state.qd), expected, h.norm() * state.qd.norm()) <=
          tolerance::rounding);
  });
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
