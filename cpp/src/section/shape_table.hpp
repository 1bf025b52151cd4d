#pragma once

#include <array>

#include "section/inertia_series.hpp"
#include "section/polynomial_table.hpp"

namespace cdcr::detail {

/// The functions a, b, G_A, G_S of sigma = theta^2 and their derivatives, four that are read
/// together in each table: eq. (21).
struct ShapeTable {
  template <class S>
  using ValuesOf = std::array<S, 4>;
  using Values = ValuesOf<double>;

  explicit ShapeTable(const SectionSeries& s)
      : inertia({s.a, s.b, {}, {}}, {{2, 0}, {3, 1}}),
        gravity({s.G_A, s.G_S, {}, {}}, {{2, 0}, {3, 1}}),
        second({twice(s.a), twice(s.b), twice(s.G_A), twice(s.G_S)}, {}) {}

  /// NaN beyond the largest bending angle and for NaN. Real-time safe.
  template <class S>
  [[nodiscard, gnu::always_inline]] static ValuesOf<S> read(const PolynomialTable<4>& table,
                                                            const S& sigma) noexcept {
    using detail::read;
    Eigen::Array<S, 4, 1> f;
    read(table, sigma, f);
    return {f[0], f[1], f[2], f[3]};
  }

  PolynomialTable<4> inertia;  ///< a, b, a', b'; ' is d/d sigma
  PolynomialTable<4> gravity;  ///< G_A, G_S, G_A', G_S'
  PolynomialTable<4> second;   ///< a'', b'', G_A'', G_S''

 private:
  static Series twice(const Series& f) { return derivative(derivative(f)); }
};

}  // namespace cdcr::detail
