#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "cdcr/types.hpp"
#include "section/series.hpp"

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
  if (position < 1.0) {  // foreseen by the processor, which need not wait for the piece then
    t = 2.0 * position - 1.0;
    return 0;
  }
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
  static_assert(N % 2 == 0, "rows must begin where two doubles are loaded at once");

  /// From power series about sigma = 0. A pair (d, f) says that function d, whose series is empty,
  /// is the derivative of f; that of a derivative stands after it.
  PolynomialTable(const std::vector<Series>& functions,
                  std::initializer_list<std::pair<int, int>> derivatives)
      : pieces_(num_pieces) {
    std::vector<Series> c(N);
    for (int piece = 0; piece < num_pieces; ++piece) {
      for (std::size_t f = 0; f < N; ++f) {
        if (functions[f].empty()) continue;
        // Two more than the table keeps, for second derivatives.
        c[f] = taylor_shift(functions[f], piece_centre(piece), half_width, num_powers + 2);
      }
      for (const auto& [d, f] : derivatives) c[d] = derivative(c[f], half_width);
      double* to = pieces_[static_cast<std::size_t>(piece)].coefficients;
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
    if constexpr (N == 4) {
      read_four(c, t, values);
    } else if constexpr (N <= 8) {
      read_few(c, t, values);
    } else {
      read_many(c, t, values);
    }
  }

  /// Coefficients of a piece: of the function f, that of power k is at [k N + f].
  [[nodiscard]] const double* piece(int piece) const noexcept {
    return pieces_[static_cast<std::size_t>(piece)].coefficients;
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
    values = Row(c + last_row);
    slopes.setZero();
    for (std::ptrdiff_t row = last_row - N; row >= 0; row -= N) {
      slopes = slopes * t + values;
      values = values * t + Row(c + row);
    }
    slopes *= 2.0 / piece_width;
  }

 private:
  using Row = Eigen::Map<const Values, Eigen::Aligned16>;

  /// By halves of halves (Estrin's scheme), since whoever asks waits for the answer.
  static void read_four(const double* c, double t, Values& values) noexcept {
    const double u = t * t, v = u * u;
    const auto two = [&](int at) -> Values { return Row(c + at) + t * Row(c + at + 4); };
    const auto four = [&](int at) -> Values { return two(at) + u * two(at + 8); };
    const auto eight = [&](int at) -> Values { return four(at) + v * four(at + 16); };
    values = eight(0) + (v * v) * eight(32);
  }

  /// Even and odd powers apart: two short dependency chains in place of one long one.
  static void read_few(const double* c, double t, Values& values) noexcept {
    const double u = t * t;
    const double* row = c + last_row;
    Values odd = Row(row), even = Row(row - N);
    for (int k = 2; k < num_powers; k += 2) {
      row -= std::ptrdiff_t{2} * N;
      odd = odd * u + Row(row);
      even = even * u + Row(row - N);
    }
    values = even + t * odd;
  }

  /// Enough side by side to hide the latency of each, and still in registers.
  static void read_many(const double* c, double t, Values& values) noexcept {
    const double* row = c + last_row;
    Values sum = Row(row);
    for (int k = 1; k < num_powers; ++k) {
      row -= N;
      sum = sum * t + Row(row);
    }
    values = sum;
  }

  static constexpr std::ptrdiff_t last_row = std::ptrdiff_t{num_powers - 1} * N;  // highest power

  struct alignas(64) Piece {                           // no cache line more than it fills
    double coefficients[std::size_t{num_powers} * N];  // [power][function]
  };

  /// Coefficients of the piece that sigma lies in; t is its place there.
  const double* find(double sigma, double& t) const noexcept { return piece(find_piece(sigma, t)); }

  std::vector<Piece> pieces_;
};

/// The functions of a table at sigma: of other scalars, where these are.
template <int N>
void read(const PolynomialTable<N>& table, double sigma, Eigen::Array<double, N, 1>& f) {
  table(sigma, f);
}

}  // namespace cdcr::detail
