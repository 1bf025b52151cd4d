#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "cdcr/types.hpp"
#include "derivatives/quad.hpp"

namespace cdcr::detail {

/// A symmetric positive definite matrix M = L L^T, and solutions of M X = B. NaN where it is not
/// positive.
class Cholesky {
 public:
  explicit Cholesky(Index size) : matrix(size, size), inverse_(static_cast<std::size_t>(size)) {}

  MatrixXd matrix;  ///< M, both halves; after factorize() L below and L^T above the diagonal

  void factorize() noexcept {
    const Index d = matrix.rows();
    for (Index k = 0; k < d; ++k) {
      double* column = matrix.data() + k * d;
      const double inverse = 1.0 / std::sqrt(column[k]);
      inverse_[static_cast<std::size_t>(k)] = inverse;
      for (Index i = k + 1; i < d; ++i) column[i] *= inverse;
      for (Index j = k + 1; j < d; ++j) {
        const double share = column[j];
        double* to = matrix.data() + j * d;
        for (Index i = j; i < d; ++i) to[i] -= share * column[i];
        matrix(k, j) = share;
      }
    }
  }

  /// One right-hand side, in place.
  void solve(double* x) const noexcept {
    const Index d = matrix.rows();
    for (Index i = 0; i < d; ++i) {
      const double* row = matrix.data() + i * d;  // of L, as the column above the diagonal
      double sum = x[i];
      for (Index k = 0; k < i; ++k) sum -= row[k] * x[k];
      x[i] = sum * inverse_[static_cast<std::size_t>(i)];
    }
    for (Index i = d - 1; i >= 0; --i) {
      const double* column = matrix.data() + i * d;
      double sum = x[i];
      for (Index k = i + 1; k < d; ++k) sum -= column[k] * x[k];
      x[i] = sum * inverse_[static_cast<std::size_t>(i)];
    }
  }

  /// Many at once, in place: the first `width` quads of rows that stand `apart`.
  void solve(Quad* rows, Index apart, Index width) const noexcept {
    Index first = 0;
    for (; first + 8 <= width; first += 8) solve_some<8>(rows + first, apart);
    if (first + 4 <= width) {
      solve_some<4>(rows + first, apart);
      first += 4;
    }
    for (; first < width; ++first) solve_some<1>(rows + first, apart);
  }

 private:
  template <int count>
  void solve_some(Quad* rows, Index apart) const noexcept {
    const Index d = matrix.rows();
    // Row i less its factors times the rows from first to last, over the diagonal.
    const auto eliminate = [&](Index i, Index first, Index last) {
      const double* factors = matrix.data() + i * d;
      std::array<Quad, count> sum;
      for (int c = 0; c < count; ++c) sum[c] = rows[i * apart + c];
      for (Index k = first; k < last; ++k) {
        const Quad factor(factors[k]);
        const Quad* row = rows + k * apart;
        for (int c = 0; c < count; ++c) sum[c] -= factor * row[c];
      }
      const Quad inverse(inverse_[static_cast<std::size_t>(i)]);
      for (int c = 0; c < count; ++c) rows[i * apart + c] = inverse * sum[c];
    };
    for (Index i = 0; i < d; ++i) eliminate(i, 0, i);
    for (Index i = d - 1; i >= 0; --i) eliminate(i, i + 1, d);
  }

  std::vector<double> inverse_;  // of the diagonal of L
};

}  // namespace cdcr::detail
