#include "section/series.hpp"

#include <algorithm>
#include <cmath>

namespace cdcr::detail {
namespace {

// A term this small beside the first, at the far end of a piece, is none.
constexpr long double negligible = 1e-24L;

}  // namespace

Series even_function(int offset) {
  Series f;
  long double term = 1.0L;
  for (int k = 2; k <= offset; ++k) term /= k;
  for (int j = 0; j < num_terms; ++j) {
    f.push_back(term);
    const long double n = 2.0L * j + offset;
    term *= -1.0L / ((n + 1.0L) * (n + 2.0L));
  }
  return f;
}

Series operator*(const Series& f, const Series& g) {
  Series product(f.size(), 0.0L);
  for (std::size_t i = 0; i < f.size(); ++i) {
    for (std::size_t j = 0; i + j < f.size(); ++j) product[i + j] += f[i] * g[j];
  }
  return product;
}

Series operator+(Series f, const Series& g) {
  for (std::size_t j = 0; j < f.size(); ++j) f[j] += g[j];
  return f;
}

Series operator*(long double factor, Series f) {
  for (long double& c : f) c *= factor;
  return f;
}

Series operator-(const Series& f, const Series& g) {
  return f + (-1.0L) * g;
}

Series times_argument(Series f) {
  f.insert(f.begin(), 0.0L);
  f.pop_back();
  return f;
}

Series over_argument(Series f) {
  f.erase(f.begin());
  f.push_back(0.0L);
  return f;
}

Series constant(long double value) {
  Series f(num_terms, 0.0L);
  f[0] = value;
  return f;
}

/// By repeated synthetic division.
Series taylor_shift(Series f, long double centre, long double half_width, std::size_t kept) {
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

Series derivative(const Series& f, long double unit) {
  Series d(f.size(), 0.0L);
  for (std::size_t k = 1; k < f.size(); ++k) d[k - 1] = f[k] * static_cast<long double>(k) / unit;
  return d;
}

}  // namespace cdcr::detail
