#pragma once

#include "integration/small_lu.hpp"
#include "integration/sundials_handles.hpp"

namespace cdcr::detail {

/// Solves CVODE's Newton matrix 1 - g J of y = (q, qd), whose upper half says q' = qd, by a matrix
/// of half its size: W = A_22 + g A_21, x_q = b_q + g x_qd, W x_qd = b_qd - A_21 b_q.
class HalfNewton {
 public:
  explicit HalfNewton(Index num_states)
      : lu_(num_states / 2), coupling_(num_states / 2, num_states / 2) {}

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
    const Index m = coupling_.rows();
    const Eigen::Map<const MatrixXd> A(SM_DATA_D(matrix), 2 * m, 2 * m);
    step_ = -A(0, m);
    coupling_ = A.bottomLeftCorner(m, m);
    lu_.matrix = A.bottomRightCorner(m, m) + step_ * coupling_;
    lu_.factorise();
    return 0;
  }

  int solve(const double* b, double* x) const noexcept {
    const Index m = coupling_.rows();
    const Eigen::Map<const VectorXd> upper(b, m), lower(b + m, m);
    Eigen::Map<VectorXd> rates(x + m, m);
    rates = lower;
    for (Index j = 0; j < m; ++j) rates -= b[j] * coupling_.col(j);
    lu_.solve(rates);
    for (Index i = 0; i < m; ++i) x[i] = b[i] + step_ * rates[i];
    return 0;
  }

  SmallLu lu_;
  MatrixXd coupling_;  // A_21
  double step_ = 0.0;  // g
};

}  // namespace cdcr::detail
