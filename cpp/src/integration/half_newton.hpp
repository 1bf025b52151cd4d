#pragma once

#include <Eigen/LU>

#include "integration/small_lu.hpp"
#include "integration/sundials_handles.hpp"

namespace cdcr::detail {

/// Solves CVODE's Newton matrix 1 - g J of y = (q, qd) or (q, qd, w), whose first rows say q' = qd,
/// by a matrix of what is left: W = A_22, and g A_21 added to its columns of qd,
/// x_q = b_q + g x_qd, W (x_qd, x_w) = (b_qd, b_w) - A_21 b_q.
class HalfNewton {
 public:
  HalfNewton(Index num_states, Index num_coordinates)
      : lu_(num_states - num_coordinates),
        coupling_(num_states - num_coordinates, num_coordinates) {}

  /// As CVODE takes it, with this object as its content; that must outlive it.
  [[nodiscard]] SUNLinearSolver make(SUNContext context) {
    SUNLinearSolver solver = SUNLinSolNewEmpty(context);
    if (solver == nullptr) return nullptr;
    solver->content = this;
    solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
    solver->ops->setup = [](SUNLinearSolver self, SUNMatrix matrix) {
      return of(self).set_up(matrix);
    };
    solver->ops->solve = [](SUNLinearSolver self, SUNMatrix, N_Vector x, N_Vector b, double) {
      return of(self).solve(NV_DATA_S(b), NV_DATA_S(x));
    };
    solver->ops->free = [](SUNLinearSolver self) {
      SUNLinSolFreeEmpty(self);
      return 0;
    };
    return solver;
  }

 private:
  static HalfNewton& of(SUNLinearSolver solver) {
    return *static_cast<HalfNewton*>(solver->content);
  }

  int set_up(SUNMatrix matrix) noexcept {
    const Index m = coupling_.cols(), rest = coupling_.rows();
    const Eigen::Map<const MatrixXd> A(SM_DATA_D(matrix), m + rest, m + rest);
    step_ = -A(0, m);
    coupling_ = A.bottomLeftCorner(rest, m);
    if (rest == 2) {
      pair_inverse_ = (A.bottomRightCorner<2, 2>() + step_ * coupling_).inverse();
      return 0;
    }
    lu_.matrix = A.bottomRightCorner(rest, rest);
    lu_.matrix.leftCols(m) += step_ * coupling_;
    lu_.factorise();
    return 0;
  }

  int solve(const double* b, double* x) const noexcept {
    const Index m = coupling_.cols(), rest = coupling_.rows();
    if (rest == 2) return solve_pair(b, x);
    const Eigen::Map<const VectorXd> lower(b + m, rest);
    Eigen::Map<VectorXd> rates(x + m, rest);
    rates = lower;
    for (Index j = 0; j < m; ++j) rates -= b[j] * coupling_.col(j);
    lu_.solve(rates);
    for (Index i = 0; i < m; ++i) x[i] = b[i] + step_ * rates[i];
    return 0;
  }

  /// Of one section, whose two coordinates no deflections follow.
  int solve_pair(const double* b, double* x) const noexcept {
    const Eigen::Map<const Eigen::Matrix2d> coupling(coupling_.data());
    const Eigen::Vector2d above(b), below(b + 2);
    const Eigen::Vector2d rates = pair_inverse_ * (below - coupling * above);
    for (Index i = 0; i < 2; ++i) {
      x[i] = above[i] + step_ * rates[i];
      x[2 + i] = rates[i];
    }
    return 0;
  }

  SmallLu lu_;
  Eigen::Matrix2d pair_inverse_;
  MatrixXd coupling_;  // A_21
  double step_ = 0.0;  // g
};

}  // namespace cdcr::detail
