#pragma once

#include <limits>

#include "base/pack.hpp"
#include "section/polynomial_table.hpp"

// What tables of polynomials give for packs of sigma.

namespace cdcr::detail {

/// Where sigma lies in a piece of the tables, that of its first lane: -1 to 1 within it.
template <int W>
[[gnu::always_inline]] inline Pack<W> place_in(int piece, const Pack<W>& sigma) {
  return 2.0 * (sigma * Pack<W>(1.0 / piece_width) - Pack<W>(piece)) - Pack<W>(1.0);
}
template <int W>
[[gnu::always_inline]] inline int piece_of_first(const Pack<W>& sigma) {
  double place = 0.0;
  const double first = sigma.lanes[0];
  return first <= sigma_limit ? find_piece(first, place) : 0;
}
/// Whether all lanes of both lie within their piece, but for its end.
template <int W>
[[gnu::always_inline]] inline bool all_inside(const Pack<W>& t, const Pack<W>& u) {
  // NOLINTNEXTLINE(bugprone-signed-bitwise): masks of lanes
  const auto inside = (t.lanes >= -1.0) & (t.lanes < 1.0) & (u.lanes >= -1.0) & (u.lanes < 1.0);
  auto all = inside[0];
  for (int i = 1; i < W; ++i) all &= inside[i];  // NOLINT(bugprone-signed-bitwise)
  return all != 0;
}

/// values[f] = sum_k c(k, f) t^k of `count` functions, whose sums stay in registers; even and odd
/// powers apart, for short chains of dependency.
template <int count, int W, class Coefficient>
[[gnu::always_inline]] inline void sum_some(const Pack<W>& t, const Pack<W>& u,
                                            const Coefficient& c, int first, Pack<W>* values) {
  Pack<W> odd[count], even[count];
  for (int f = 0; f < count; ++f) {
    odd[f] = c(num_powers - 1, first + f);
    even[f] = c(num_powers - 2, first + f);
  }
  for (int k = num_powers - 3; k > 0; k -= 2) {
    for (int f = 0; f < count; ++f) {
      odd[f] = odd[f] * u + c(k, first + f);
      even[f] = even[f] * u + c(k - 1, first + f);
    }
  }
  for (int f = 0; f < count; ++f) values[first + f] = even[f] + t * odd[f];
}
template <int N, int W, class Coefficient>
[[gnu::always_inline]] inline void sum_powers(const Pack<W>& t, const Coefficient& c,
                                              Pack<W>* values) {
  constexpr int together = 4;
  const Pack<W> u = t * t;
  int first = 0;
  for (; first + together <= N; first += together) sum_some<together>(t, u, c, first, values);
  if constexpr (N % together > 0) sum_some<N % together>(t, u, c, first, values);
}

/// The piece of each lane by itself; NaN beyond the largest bending angle.
template <int N, int W>
struct LanePieces {
  LanePieces(const PolynomialTable<N>& table, const Pack<W>& sigma) {
    for (int i = 0; i < W; ++i) {
      double there = std::numeric_limits<double>::quiet_NaN();
      rows[i] = table.piece(sigma.lanes[i] <= sigma_limit ? find_piece(sigma.lanes[i], there) : 0);
      place.lanes[i] = there;
    }
  }
  /// The coefficients of power k of function j.
  Pack<W> operator()(int k, int j) const {
    Pack<W> c;
    for (int i = 0; i < W; ++i) c.lanes[i] = rows[i][k * N + j];
    return c;
  }

  const double* rows[W];
  Pack<W> place;
};

/// The functions of a table in all lanes; NaN in those beyond the largest bending angle.
template <int N, int W>
[[gnu::always_inline]] inline void read(const PolynomialTable<N>& table, const Pack<W>& sigma,
                                        Eigen::Array<Pack<W>, N, 1>& f) {
  // Mostly all lanes lie in the piece of the first.
  const int piece = piece_of_first(sigma);
  const Pack<W> t = place_in(piece, sigma);
  if (all_inside(t, t)) {
    const double* row = table.piece(piece);
    sum_powers<N>(t, [row](int k, int j) { return Pack<W>(row[k * N + j]); }, f.data());
    return;
  }
  const LanePieces<N, W> each(table, sigma);
  sum_powers<N>(each.place, each, f.data());
}

/// sum_powers of two packs: all sums side by side, each in one chain.
template <int N, int W, class First, class Second>
[[gnu::always_inline]] inline void sum_powers(const Pack<W>& t, const Pack<W>& u, const First& c,
                                              const Second& d, Twin<W>* values) {
  Pack<W> a[N], b[N];
  for (int j = 0; j < N; ++j) {
    a[j] = c(num_powers - 1, j);
    b[j] = d(num_powers - 1, j);
  }
  for (int k = num_powers - 2; k >= 0; --k) {
    for (int j = 0; j < N; ++j) {
      a[j] = a[j] * t + c(k, j);
      b[j] = b[j] * u + d(k, j);
    }
  }
  for (int j = 0; j < N; ++j) values[j] = Twin<W>(a[j], b[j]);
}

template <int N, int W>
[[gnu::always_inline]] inline void read(const PolynomialTable<N>& table, const Twin<W>& sigma,
                                        Eigen::Array<Twin<W>, N, 1>& f) {
  const int piece = piece_of_first(sigma.a);
  const Pack<W> t = place_in(piece, sigma.a), u = place_in(piece, sigma.b);
  if (all_inside(t, u)) {
    const double* row = table.piece(piece);
    const auto alike = [row](int k, int j) { return Pack<W>(row[k * N + j]); };
    sum_powers<N>(t, u, alike, alike, f.data());
    return;
  }
  const LanePieces<N, W> first(table, sigma.a), second(table, sigma.b);
  sum_powers<N>(first.place, second.place, first, second, f.data());
}

}  // namespace cdcr::detail
