#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "section/series.hpp"

namespace cdcr::detail {

/// A term this small beside the first, at the far end of a piece, is none.
inline constexpr long double negligible = 1e-24L;

/// Coefficients in t of f(centre + half_width t), by repeated synthetic division: as many as are
/// kept.
inline Series recentred(Series f, long double centre, long double half_width, std::size_t kept) {
  if (f.size() < kept) f.resize(kept, 0.0L);  // a cut series is short
  // Near the straight robot a few terms are all there is.
  std::size_t terms = kept;
  long double power = 1.0L;
  for (std::size_t k = 0; k < f.size(); ++k, power *= centre + half_width) {
    if (std::abs(f[k]) * power > negligible * std::abs(f[0])) terms = std::max(terms, k + 1);
  }
  for (std::size_t i = 0; i < kept; ++i) {
    for (std::size_t k = terms - 1; k-- > i;) f[k] += centre * f[k + 1];
  }
  f.resize(kept);
  long double scale = 1.0L;
  for (long double& c : f) {
    c *= scale;
    scale *= half_width;
  }
  return f;
}

/// Coefficients of df/dx of a series in x/unit; as many as f has, the last of them zero.
inline Series derivative(const Series& f, long double unit = 1.0L) {
  Series d(f.size(), 0.0L);
  for (std::size_t k = 1; k < f.size(); ++k) d[k - 1] = f[k] * static_cast<long double>(k) / unit;
  return d;
}

}  // namespace cdcr::detail
