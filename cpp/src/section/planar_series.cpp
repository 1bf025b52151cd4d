// The derivation in one place: from the elements of a section to the power series of a, b, G_A,
// G_S.
//
// An element at fraction x of the length has mass m, transverse inertia I_t, axial inertia I_a.
// With y = x theta, A(y) = (1 - cos y)/y^2, S(y) = sin y / y and the planar speed
// D(y) = |d r/d theta|^2 / (l^2 x^4) = (y^2 + 2 - 2 cos y - 2 y sin y)/y^4:
//   a = sum m l^2 x^4 A^2 + I_t x^2 S^2 + I_a x^2 y^2 A^2                    (9)
//   b = sum m l^2 x^6 (D - A^2)/y^2 + I_t x^4 (1 - S^2)/y^2 - I_a x^4 A^2    (10)
//   G_A = sum m x^2 A,  G_S = sum m x S                                      (13), (14)
// cos y and sin y are power series, so each bracket is one in y^2 = x^2 sigma, and the sum over
// elements touches only the moments sum m x^p.
#include "section/mass_moments.hpp"
#include "section/series.hpp"

namespace cdcr::detail {
namespace {

/// 1/n!, 4^k/(2k)! and the brackets of (9) and (10), each as the coefficient of (y^2)^j.
struct Brackets {
  Series A, S, A2, S2, spread, turn;
};

Brackets brackets() {
  Series inv(2 * num_terms + 8, 1.0L);  // 1/n!
  for (std::size_t n = 1; n < inv.size(); ++n) inv[n] = inv[n - 1] / static_cast<long double>(n);
  Brackets c;
  long double sign = 1.0L;
  long double four = 1.0L;  // 4^j
  for (int j = 0; j < num_terms; ++j, sign = -sign, four *= 4.0L) {
    c.A.push_back(sign * inv[2 * j + 2]);                                         // (1 - cos y)/y^2
    c.S.push_back(sign * inv[2 * j + 1]);                                         // sin y / y
    c.A2.push_back(sign * (8.0L * four - 2.0L) * inv[2 * j + 4]);                 // A^2
    c.S2.push_back(sign * 2.0L * four * inv[2 * j + 2]);                          // S^2
    c.spread.push_back(sign * (32.0L * four - 4.0L * (j + 3)) * inv[2 * j + 6]);  // (D - A^2)/y^2
    c.turn.push_back(sign * 8.0L * four * inv[2 * j + 4]);                        // (1 - S^2)/y^2
  }
  return c;
}

}  // namespace

SectionSeries exact_series(const Section& s, double payload) {
  const long double l2 = static_cast<long double>(s.length) * s.length;
  const Moments mass = Moments::of_mass(s, payload);
  const Moments transverse = Moments::of_inertia(s);
  const auto axial = [&transverse](int p) { return 2.0L * transverse(p); };  // thin disks

  const Brackets c = brackets();
  SectionSeries series;
  for (int j = 0; j < num_terms; ++j) {
    const long double spin = j == 0 ? 0.0L : axial(2 * j + 2) * c.A2[j - 1];
    series.a.push_back(l2 * mass(2 * j + 4) * c.A2[j] + transverse(2 * j + 2) * c.S2[j] + spin);
    series.b.push_back(l2 * mass(2 * j + 6) * c.spread[j] + transverse(2 * j + 4) * c.turn[j] -
                       axial(2 * j + 4) * c.A2[j]);
    series.G_A.push_back(mass(2 * j + 2) * c.A[j]);
    series.G_S.push_back(mass(2 * j + 1) * c.S[j]);
  }
  return series;
}

}  // namespace cdcr::detail
