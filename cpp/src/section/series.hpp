#pragma once

#include <cstddef>
#include <vector>

namespace cdcr::detail {

/// A power series, coefficients of s^0, s^1, ...; extended precision because re-centring cancels
/// digits.
using Series = std::vector<long double>;

/// Terms kept of each power series: (2 y)^(2k)/(2k)! at y = 3 pi falls below 1e-21 at k = 45.
inline constexpr int num_terms = 46;

/// sum over j of (-s)^j / (2j + offset)!: cos y, S, A, G of y^2 = s for offsets 0 to 3.
[[nodiscard]] Series even_function(int offset);
[[nodiscard]] Series constant(long double value);

/// As many terms as f has.
[[nodiscard]] Series operator*(const Series& f, const Series& g);
[[nodiscard]] Series operator*(long double factor, Series f);
[[nodiscard]] Series operator+(Series f, const Series& g);
[[nodiscard]] Series operator-(const Series& f, const Series& g);
/// s f, and f/s for an f without constant term.
[[nodiscard]] Series times_argument(Series f);
[[nodiscard]] Series over_argument(Series f);
/// df/dx of a series in s = x/unit, the last coefficient zero.
[[nodiscard]] Series derivative(const Series& f, long double unit = 1.0L);

/// Coefficients in t of f(centre + half_width t): as many as are kept.
[[nodiscard]] Series taylor_shift(Series f, long double centre, long double half_width,
                                  std::size_t kept);

}  // namespace cdcr::detail
