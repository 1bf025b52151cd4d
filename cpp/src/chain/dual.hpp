#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <unsupported/Eigen/AutoDiff>

#include "cdcr/robot.hpp"
#include "section/polynomial_table.hpp"

// Derivatives to rounding, without formulas: the recursions run on dual numbers.

namespace cdcr::detail {

/// A number and its derivatives in this many directions at once.
inline constexpr int dual_width = 4;
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, dual_width, 1>>;

template <int N>
void read(const PolynomialTable<N>& table, const Dual& sigma, Eigen::Array<Dual, N, 1>& f) {
  Eigen::Array<double, N, 1> values, slopes;
  table(sigma.value(), values, slopes);
  for (int k = 0; k < N; ++k) f[k] = Dual(values[k], slopes[k] * sigma.derivatives());
}

/// J = dy/dx (num_outputs, num_inputs) of f(const Dual* x, Dual* y); at most max_coordinates each.
template <class F>
void differentiate(int num_inputs, int num_outputs, const double* x, MatrixRef J, F&& f) {
  Dual in[max_coordinates], out[max_coordinates];
  for (int i = 0; i < num_inputs; ++i) in[i] = Dual(x[i]);
  for (int first = 0; first < num_inputs; first += dual_width) {
    const int count = std::min(dual_width, num_inputs - first);
    for (int k = 0; k < count; ++k) in[first + k].derivatives()[k] = 1.0;
    f(static_cast<const Dual*>(in), static_cast<Dual*>(out));
    for (int i = 0; i < num_outputs; ++i) {
      J.row(i).segment(first, count) = out[i].derivatives().head(count).transpose();
    }
    for (int k = 0; k < count; ++k) in[first + k].derivatives().setZero();
  }
}

}  // namespace cdcr::detail
