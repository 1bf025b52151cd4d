#pragma once

#include "cdcr/types.hpp"

// Eigenvalue problems of matrices of any size, compiled once: each takes the compiler seconds.

namespace cdcr::detail {

struct SymmetricEigen {
  VectorXd values;   // ascending
  MatrixXd vectors;  // columns
};

/// Of a symmetric matrix, of which the lower half is read.
[[nodiscard]] VectorXd symmetric_eigenvalues(const MatrixXd& A);
[[nodiscard]] SymmetricEigen symmetric_eigen(const MatrixXd& A);
/// A v = value M v, v^T M v = 1, with M positive definite.
[[nodiscard]] SymmetricEigen symmetric_eigen(const MatrixXd& A, const MatrixXd& M);

/// Of any square matrix, in no order.
[[nodiscard]] Eigen::VectorXcd eigenvalues(const MatrixXd& A);

}  // namespace cdcr::detail
