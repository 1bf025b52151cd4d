#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "cdcr/types.hpp"

namespace cdcr::detail {

/// Solves matrix x = b by elimination with row pivots, in place and on fixed storage. A matrix that
/// is singular, or not finite, makes x not finite. Real-time safe.
class SmallLu {
 public:
  explicit SmallLu(Index size) : matrix(size, size), pivots_(static_cast<std::size_t>(size)) {}

  void factorise() noexcept {
    const Index n = matrix.rows();
    for (Index k = 0; k < n; ++k) {
      Index pivot = k;
      for (Index i = k + 1; i < n; ++i) {
        if (std::abs(matrix(i, k)) > std::abs(matrix(pivot, k))) pivot = i;
      }
      pivots_[static_cast<std::size_t>(k)] = pivot;
      if (pivot != k) matrix.row(k).swap(matrix.row(pivot));
      const Index rest = n - k - 1;
      auto factors = matrix.col(k).tail(rest);
      factors /= matrix(k, k);
      for (Index j = k + 1; j < n; ++j) matrix.col(j).tail(rest) -= matrix(k, j) * factors;
    }
  }

  /// Turns b into x.
  void solve(VectorRef b) const noexcept {
    const Index n = matrix.rows();
    for (Index k = 0; k < n; ++k) std::swap(b[k], b[pivots_[static_cast<std::size_t>(k)]]);
    for (Index k = 0; k < n; ++k) b.tail(n - k - 1) -= b[k] * matrix.col(k).tail(n - k - 1);
    for (Index k = n - 1; k >= 0; --k) {
      b[k] /= matrix(k, k);
      b.head(k) -= b[k] * matrix.col(k).head(k);
    }
  }

  MatrixXd matrix;  ///< to set before factorise(), which overwrites it

 private:
  std::vector<Index> pivots_;
};

}  // namespace cdcr::detail
