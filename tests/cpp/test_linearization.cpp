// A and B of the linearisation against differences of forward_dynamics, and what they tell.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>

#include "cdcr/dynamics.hpp"
#include "cdcr/linearization.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

VectorXd acceleration(const Model& model, Data& data, const State& state) {
  VectorXd qdd(2);
  forward_dynamics(model, data, state.q, state.qd, state.tension, qdd);
  return qdd;
}

/// Central difference of sixth order in double precision.
VectorXd difference(const std::function<VectorXd(double)>& f, double h) {
  VectorXd sum = 45.0 * (f(h) - f(-h));
  sum -= 9.0 * (f(2.0 * h) - f(-2.0 * h));
  sum += f(3.0 * h) - f(-3.0 * h);
  return sum / (60.0 * h);
}

/// Linear acceleration against its differences; column k of A or B.
using Shift = std::function<void(State&, double)>;
void check_column(const Model& model, Data& data, const State& state, const VectorXd& column,
                  double step, double scale, const Shift& shift) {
  const auto shifted = [&](double by) {
    State moved = state;
    shift(moved, by);
    return acceleration(model, data, moved);
  };
  CHECK(residual(column.tail(2), difference(shifted, step), scale) <= tolerance::differences);
}

TEST_SUITE_BEGIN("linearization");

TEST_CASE("A and B are the derivatives of forward dynamics") {
  // Near 2 pi a payload alone has almost no inertia across the bend, so its derivatives explode.
  for_each_case(1.7 * pi, [](const Model& model, Data& data, const State& state) {
    const Index num_cables = model.num_cables();
    MatrixXd A(4, 4), B(4, num_cables);
    linearize(model, data, state.q, state.qd, state.tension, A, B);
    const MatrixXd accelerations = A.bottomRows(2);
    // A step of 0.01 rad; rounding enters as the largest acceleration over the step.
    const double scale = largest(accelerations) + largest(acceleration(model, data, state));
    for (Index k = 0; k < 2; ++k) {
      check_column(model, data, state, A.col(k), 0.01, scale,
                   [k](State& moved, double by) { moved.q[k] += by; });
      check_column(model, data, state, A.col(2 + k), 0.1, scale,
                   [k](State& moved, double by) { moved.qd[k] += by; });
    }
    for (Index j = 0; j < num_cables; ++j) {
      check_column(model, data, state, B.col(j), 1.0, scale + largest(B),
                   [j](State& moved, double by) { moved.tension[j] += by; });
    }
    CHECK(A.topLeftCorner(2, 2) == MatrixXd::Zero(2, 2));
    CHECK(A.topRightCorner(2, 2) == MatrixXd::Identity(2, 2));
    CHECK(B.topRows(2) == MatrixXd::Zero(2, num_cables));
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

TEST_CASE("closed form and dual numbers agree") {
  for_each_case(1.7 * pi, [](const Model& model, Data& data, const State& state) {
    MatrixXd A(4, 4), dual(4, 4), B(4, model.num_cables()), B_dual(4, model.num_cables());
    linearize(model, data, state.q, state.qd, state.tension, A, B);
    const Wrenches nothing(1);  // a wrench of no size takes the general way
    linearize(model, data, state.q, state.qd, state.tension, nothing, dual, B_dual);
    CHECK(residual(dual, A) <= tolerance::cancelled);
    CHECK(residual(B_dual, B) <= tolerance::cancelled);
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
