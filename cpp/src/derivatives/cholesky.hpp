#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "cdcr/types.hpp"
#include "derivatives/quad.hpp"

namespace cdcr::detail {

/// A symmetric positive definite matrix M = W W^T, W above the diagonal, and solutions of M X = B.
/// NaN where it is not positive. Zeros at the end of a column of B cost nothing.
class Cholesky {
 public:
  explicit Cholesky(Index size) : matrix(size, size), inverse_(static_cast<std::size_t>(size)) {}

  MatrixXd matrix;  ///< M on and above the diagonal; after factorize() W there, and W^T below it

  void factorize() noexcept {
    Index k = matrix.rows() - 1;
    for (; k > 0; k -= 2) factorize_two(k);
    if (k == 0) scale(0);
  }

  /// One right-hand side, in place.
  void solve(double* x) const noexcept {
    const Index d = matrix.rows();
    for (Index k = d - 1; k >= 0; --k) {
      x[k] *= inverse_[static_cast<std::size_t>(k)];
      const double* column = matrix.data() + k * d;
      for (Index i = 0; i < k; ++i) x[i] -= column[i] * x[k];
    }
    for (Index k = 0; k < d; ++k) {
      x[k] *= inverse_[static_cast<std::size_t>(k)];
      const double* row = matrix.data() + k * d;  // of W, as the column below the diagonal
      for (Index i = k + 1; i < d; ++i) x[i] -= row[i] * x[k];
    }
  }

  /// Many at once, in place: the first `width` quads of rows that stand `apart`.
  void solve(Quad* rows, Index apart, Index width) const noexcept {
    constexpr Index most = 6;  // at once, with two rows as many sums as there are registers
    while (width > 0) {
      const Index count = width >= 2 * most ? most : width > most ? (width + 1) / 2 : width;
      solve_some(rows, apart, count, std::make_integer_sequence<int, most>());
      rows += count;
      width -= count;
    }
  }

 private:
  /// Column k of W.
  void scale(Index k) noexcept {
    double* column = matrix.data() + k * matrix.rows();
    const double inverse = 1.0 / std::sqrt(column[k]);
    inverse_[static_cast<std::size_t>(k)] = inverse;
    for (Index i = 0; i < k; ++i) {
      column[i] *= inverse;
      matrix(k, i) = column[i];
    }
  }

  /// Columns k and k - 1 of W, and what they leave of M before them.
  void factorize_two(Index k) noexcept {
    const Index d = matrix.rows();
    double *column = matrix.data() + k * d, *next = column - d;
    scale(k);
    const double between = column[k - 1];
    for (Index i = 0; i < k; ++i) next[i] -= between * column[i];
    scale(k - 1);
    for (Index j = 0; j < k - 1; ++j) {
      const double share = column[j], share_of_next = next[j];
      double* to = matrix.data() + j * d;
      for (Index i = 0; i <= j; ++i) to[i] -= share * column[i] + share_of_next * next[i];
    }
  }

  template <int... counts>
  void solve_some(Quad* rows, Index apart, Index count,
                  std::integer_sequence<int, counts...> /*less one*/) const noexcept {
    ((count == counts + 1 ? solve_exactly<counts + 1>(rows, apart) : void()), ...);
  }

  /// Solves W Y = B from the last row up that is not zero, and W^T X = Y down.
  template <int count>
  void solve_exactly(Quad* rows, Index apart) const noexcept {
    const Index d = matrix.rows();
    Index end = d;
    while (end > 0 && is_zero<count>(rows + (end - 1) * apart)) --end;
    Index i = end - 1;
    for (; i > 0; i -= 2) eliminate<count, 2>(rows, apart, i, i - 1, i + 1, end);
    if (i == 0) eliminate<count, 1>(rows, apart, 0, 0, 1, end);
    for (i = 0; i + 1 < d; i += 2) eliminate<count, 2>(rows, apart, i, i + 1, 0, i);
    if (i < d) eliminate<count, 1>(rows, apart, i, i, 0, i);
  }

  /// Row i, and `next` after it, less their factors times the rows from first to last, over the
  /// diagonal.
  template <int count, int num_rows>
  void eliminate(Quad* rows, Index apart, Index i, Index next, Index first,
                 Index last) const noexcept {
    const Index d = matrix.rows();
    const double *factors = matrix.data() + i * d, *factors_of_next = matrix.data() + next * d;
    std::array<Quad, count> sum, sum_of_next;
    for (int c = 0; c < count; ++c) {
      sum[c] = rows[i * apart + c];
      if (num_rows == 2) sum_of_next[c] = rows[next * apart + c];
    }
    for (Index k = first; k < last; ++k) {
      const Quad factor(factors[k]), factor_of_next(factors_of_next[k]);
      const Quad* row = rows + k * apart;
      for (int c = 0; c < count; ++c) {
        sum[c] -= factor * row[c];
        if (num_rows == 2) sum_of_next[c] -= factor_of_next * row[c];
      }
    }
    const Quad inverse(inverse_[static_cast<std::size_t>(i)]);
    for (int c = 0; c < count; ++c) rows[i * apart + c] = sum[c] = inverse * sum[c];
    if (num_rows == 1) return;
    const Quad between(factors_of_next[i]);
    const Quad inverse_of_next(inverse_[static_cast<std::size_t>(next)]);
    for (int c = 0; c < count; ++c) {
      rows[next * apart + c] = inverse_of_next * (sum_of_next[c] - between * sum[c]);
    }
  }

  template <int count>
  static bool is_zero(const Quad* row) noexcept {
    auto differs = row[0].all != Quad::Native{};
    for (int c = 1; c < count; ++c) differs |= row[c].all != Quad::Native{};
    return differs[0] == 0 && differs[1] == 0 && differs[2] == 0 && differs[3] == 0;
  }

  std::vector<double> inverse_;  // of the diagonal of W
};

}  // namespace cdcr::detail
