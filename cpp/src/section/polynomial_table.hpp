#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "cdcr/types.hpp"
#include "section/taylor_shift.hpp"

namespace cdcr::detail {

// How every table is cut: sigma up to (3 pi)^2 = max_bending^2, a piece for each pi^2.
inline constexpr int num_pieces = 9;
inline constexpr int num_powers = 16;  // the next is below 1e-17 of the value in every piece
inline constexpr double sigma_limit = max_bending * max_bending;
inline constexpr double piece_width = sigma_limit / num_pieces;
inline constexpr long double half_width = piece_width / 2.0L;

/// Middle of a piece.
constexpr long double piece_centre(int piece) {
  return (2 * piece + 1) * half_width;
}

/// The piece that a sigma within the limit lies in; t is its place in [-1, 1] there.
inline int find_piece(double sigma, double& t) noexcept {
  const double position = sigma * (1.0 / piece_width);
  int piece = static_cast<int>(position);
  if (piece == num_pieces) piece = num_pieces - 1;
  t = 2.0 * (position - piece) - 1.0;
  return piece;
}

/// N functions of sigma = theta^2 as piecewise polynomials, one piece for each pi^2, fixed at
/// construction: reading them costs 15 N multiply-adds and no trigonometric function.
template <int N>
class PolynomialTable {
 public:
  using Values = Eigen::Array<double, N, 1>;

  /// From power series about sigma = 0. A pair (d, f) says that function d, whose series is empty,
  /// is the derivative of f; that of a derivative stands after it.
  PolynomialTable(const std::vector<Series>& functions,
                  std::initializer_list<std::pair<int, int>> derivatives)
      : coefficients_(static_cast<std::size_t>(num_pieces * block)) {
    std::vector<Series> c(N);
    for (int piece = 0; piece < num_pieces; ++piece) {
      for (std::size_t f = 0; f < N; ++f) {
        if (functions[f].empty()) continue;
        // Two more than the table keeps, for second derivatives.
        c[f] = recentred(functions[f], piece_centre(piece), half_width, num_powers + 2);
      }
      for (const auto& [d, f] : derivatives) c[d] = derivative(c[f], half_width);
      double* to = coefficients_.data() + piece * block;
      for (std::size_t k = 0; k < num_powers; ++k) {
        for (std::size_t f = 0; f < N; ++f) *to++ = static_cast<double>(c[f][k]);
      }
    }
  }

  /// NaN beyond the largest bending angle and for NaN. Real-time safe.
  void operator()(double sigma, Values& values) const noexcept {
    if (!(sigma <= sigma_limit)) {
      values.setConstant(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    double t = 0.0;
    const double* c = find(sigma, t);
    // So few at a time that their sums stay in registers through all powers.
    constexpr int width = N % 14 == 0 ? 14 : N % 8 == 0 ? 8 : N;
    using Few = Eigen::Array<double, width, 1>;
    for (int first = 0; first < N; first += width) {
      const double* row = c + last_row + first;
      Few sum = Eigen::Map<const Few>(row);
      for (int k = 1; k < num_powers; ++k) {
        row -= N;
        sum = sum * t + Eigen::Map<const Few>(row);
      }
      values.template segment<width>(first) = sum;
    }
  }

  /// Values and their derivatives with respect to sigma.
  void operator()(double sigma, Values& values, Values& slopes) const noexcept {
    if (!(sigma <= sigma_limit)) {
      values.setConstant(std::numeric_limits<double>::quiet_NaN());
      slopes = values;
      return;
    }
    double t = 0.0;
    const double* c = find(sigma, t);
    using Row = Eigen::Map<const Values>;
    values = Row(c + last_row);
    slopes.setZero();
    for (std::ptrdiff_t row = last_row - N; row >= 0; row -= N) {
      slopes = slopes * t + values;
      values = values * t + Row(c + row);
    }
    slopes *= 2.0 / piece_width;
  }

 private:
  static constexpr std::ptrdiff_t block = std::ptrdiff_t{num_powers} * N;
  static constexpr std::ptrdiff_t last_row = block - N;  // of the highest power

  /// Coefficients of the piece that sigma lies in; t is its place there.
  const double* find(double sigma, double& t) const noexcept {
    return coefficients_.data() + find_piece(sigma, t) * block;
  }

  std::vector<double> coefficients_;  // [piece][power][function]
};

}  // namespace cdcr::detail
