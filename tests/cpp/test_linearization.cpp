// A and B of the linearisation against differences of forward_dynamics, and what they tell.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "cdcr/dynamics.hpp"
#include "cdcr/linearization.hpp"
#include "support/chain_cases.hpp"
#include "support/differences.hpp"
#include "support/residual.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

VectorXd gradient_at(const Model& model, Data& data, const VectorXd& q) {
  VectorXd gradient(q.size());
  potential_gradient(model, data, q, gradient);
  return gradient;
}

TEST_SUITE_BEGIN("linearization");

TEST_CASE("the Hessian of the potential energy is the derivative of its gradient") {
  for_each_chain({1, 2, 3, 8, 20}, [](const Model& model, Data& data, const ChainState& state) {
    const Index size = model.num_coordinates();
    MatrixXd H(size, size);
    potential_hessian(model, data, state.q, H);
    CHECK(residual(H, H.transpose()) <= tolerance::recursion);
    const ChainSum sum(model.robot());
    const double weight = static_cast<double>(sum.weight_scale()[0]);
    for (Index k = 0; k < size; ++k) {
      const auto moved = [&](double step) {
        return VectorXd(state.q + step * VectorXd::Unit(size, k));
      };
      const VectorXd column =
          difference([&](double step) { return gradient_at(model, data, moved(step)); }, 0.02);
      CHECK(residual(column, H.col(k), largest(H) + weight) <= tolerance::recursion_differences);
    }
  });
}

TEST_CASE("A and B of the linearisation are the derivatives of forward dynamics") {
  Random random;
  for_each_chain({1, 2, 3, 5}, [&](const Model& model, Data& data, const ChainState& state) {
    if (state.name == "bent up to a full turn") return;  // nearly singular: derivatives explode
    const Index size = model.num_coordinates(), num_cables = model.num_cables();
    MatrixXd A(2 * size, 2 * size), B(2 * size, num_cables);
    const Wrenches wrenches = random_wrenches(model, 2, random);
    linearize(model, data, state.q, state.qd, state.tension, wrenches, A, B);
    CHECK(A.topLeftCorner(size, size) == MatrixXd::Zero(size, size));
    CHECK(A.topRightCorner(size, size) == MatrixXd::Identity(size, size));
    CHECK(B.topRows(size) == MatrixXd::Zero(size, num_cables));

    const auto acceleration = [&](const ChainState& at) {
      VectorXd qdd(size);
      forward_dynamics(model, data, at.q, at.qd, at.tension, wrenches, qdd);
      return qdd;
    };
    const double scale = largest(A.bottomRows(size)) + largest(acceleration(state));
    const auto check = [&](const VectorXd& column, double width, auto part, Index k) {
      const auto shifted = [&](double step) {
        ChainState moved = state;
        (moved.*part)[k] += step;
        return acceleration(moved);
      };
      CHECK(residual(column.tail(size), difference(shifted, width), scale) <=
            tolerance::linearized);
    };
    for (Index k = 0; k < size; ++k) {
      check(A.col(k), 0.003, &ChainState::q, k);
      check(A.col(size + k), 0.1, &ChainState::qd, k);
    }
    for (Index j = 0; j < num_cables; ++j) check(B.col(j), 1.0, &ChainState::tension, j);
  });
}

TEST_CASE("the Jacobian of the motion is the A of the linearisation") {
  for_each_case(1.7 * pi, [](const Model& model, Data& data, const State& state) {
    MatrixXd A(4, 4), alone(4, 4), B(4, model.num_cables());
    linearize(model, data, state.q, state.qd, state.tension, A, B);
    state_jacobian(model, data, state.q, state.qd, state.tension, no_wrenches(), alone);
    CHECK(residual(alone, A) <= tolerance::cancelled);
  });
}

TEST_CASE("the natural frequency of the robot of Table 1 is 9.096 rad/s") {
  const Model model(amouri2020());
  Data data(model);
  MatrixXd A(4, 4), B(4, 3);
  linearize(model, data, VectorXd::Zero(2), VectorXd::Zero(2), VectorXd::Zero(3), A, B);
  const Eigen::VectorXcd eigen = A.eigenvalues();
  MatrixXd M(2, 2);
  mass_matrix(model, data, VectorXd::Zero(2), M);
  const double expected = std::sqrt(model.stiffness()[0] / M(0, 0));
  for (Index k = 0; k < 4; ++k) {
    CHECK(residual(eigen[k].real(), 0.0, expected) <= tolerance::rounding);
    CHECK(residual(std::abs(eigen[k].imag()), expected) <= tolerance::rounding);
  }
  CHECK(std::abs(expected - 9.096) <= 0.0005);
}

TEST_CASE("damping makes the straight robot decay at c / (2 a)") {
  Robot robot = amouri2020();
  robot.sections[0].damping = 9.12e-4;
  const Model model(robot);
  Data data(model);
  MatrixXd A(4, 4), B(4, 3), M(2, 2);
  linearize(model, data, VectorXd::Zero(2), VectorXd::Zero(2), VectorXd::Zero(3), A, B);
  mass_matrix(model, data, VectorXd::Zero(2), M);
  const Eigen::VectorXcd eigen = A.eigenvalues();
  for (Index k = 0; k < 4; ++k) {
    CHECK(residual(eigen[k].real(), -0.5 * 9.12e-4 / M(0, 0), 9.096) <= tolerance::rounding);
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
