#include "integration/rosenbrock.hpp"

namespace cdcr::detail {
namespace {

constexpr double gamma = 0.29289321881345254;  // 1 - 1/sqrt(2)

}  // namespace

RosenbrockStages::RosenbrockStages(Index num_states, Index num_coordinates)
    : jacobian(MatrixXd::Zero(num_states, num_states)),
      k1(VectorXd::Zero(num_states)),
      k2(k1),
      trial(k1),
      lu_(num_states - num_coordinates),
      num_coordinates_(num_coordinates) {}

/// W: the matrix of what is left once the rates of the coordinates are eliminated.
void RosenbrockStages::factorise(double h) noexcept {
  const Index m = num_coordinates_, rest = jacobian.rows() - m;
  shift_ = gamma * h;
  lu_.matrix = -shift_ * jacobian.bottomRightCorner(rest, rest);
  lu_.matrix.leftCols(m) -= shift_ * shift_ * jacobian.bottomLeftCorner(rest, m);
  lu_.matrix.diagonal().array() += 1.0;
  lu_.factorise();
}

/// Turns the right-hand side of a stage into its slope (kq, kv, ...).
void RosenbrockStages::solve(VectorXd& k) noexcept {
  const Index m = num_coordinates_, rest = jacobian.rows() - m;
  auto upper = k.head(m), lower = k.tail(rest);
  for (Index j = 0; j < m; ++j) lower += shift_ * upper[j] * jacobian.col(j).tail(rest);
  lu_.solve(lower);
  upper += shift_ * lower.head(m);
}

Status Rosenbrock::make_step(double t, double h, const VectorXd& y, const VectorXd& slope,
                             VectorXd& next) {
  ode_.jacobian(t, y.data(), stages_.jacobian.data());
  ++stats_.jacobians;
  const auto f = [this](double at, const double* stage, double* dydt) {
    derivative(at, stage, dydt);
  };
  stages_.step(f, t, h, y, slope, next);
  return stages_.status_after([this](const double* state) { return ode_.check(state); }, next);
}

}  // namespace cdcr::detail
