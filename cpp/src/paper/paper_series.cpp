// The inertia of the origin paper, Amouri, Mahfoudi, Zaatri (2020): the only file that knows it.
//
// The factors H1 to H8 enter M11 = a + b sigma and M22 = a sigma (paper eq. (21)). Kept as printed:
// H5, H6 (27), (28) and with them the disks' translation at half its value; H3, H7 (25), (29)
// varying with theta; l I_b with a second moment of area in place of a rotary inertia; no spin
// about the tangent. Mended, because no consistent model exists without: 1/3 and 1/4 before H1 and
// H2 in (21), the missing cosine in (28), the order of the velocities in (20). A payload, which the
// paper does not have, is added exactly.
#include <cmath>

#include "cdcr/formulation.hpp"
#include "section/inertia_series.hpp"

namespace cdcr {

const char* name(Formulation formulation) noexcept {
  switch (formulation) {
    case Formulation::exact:
      return "exact";
    case Formulation::taylor:
      return "taylor";
    case Formulation::printed:
      return "printed";
    case Formulation::printed_taylor:
      return "printed-taylor";
  }
  return "unknown";
}

namespace detail {
namespace {

constexpr long double pi = 3.14159265358979323846264338327950288L;

/// sin^2(y)/theta^2 for one element, the summand of H4 and H8 over theta^2, added to a series.
void add_turning(Series& sum, long double x, long double weight) {
  long double term = weight * x * x;  // sin^2 y = sum (-1)^j 2^(2j+1) y^(2j+2)/(2j+2)!
  for (std::size_t j = 0; j < sum.size(); ++j) {
    sum[j] += term;
    const auto n = static_cast<long double>(2 * j + 3);
    term *= -4.0L * x * x / (n * (n + 1.0L));
  }
}

/// (x cos^2 y + sin^2 y)^2 for one element, the summand of H3 and H7 as printed: with
/// cos^2 y = (1 + cos 2y)/2 it is (x+1)^2/4 + (x-1)^2/8 + (x^2-1)/2 cos 2y + (x-1)^2/8 cos 4y.
void add_dropped_chain_rule(Series& sum, long double x, long double weight) {
  const long double second = (x * x - 1.0L) / 2.0L, fourth = (x - 1.0L) * (x - 1.0L) / 8.0L;
  sum[0] += weight * ((x + 1.0L) * (x + 1.0L) / 4.0L + fourth);
  long double term2 = weight * second, term4 = weight * fourth;
  for (std::size_t j = 0; j < sum.size(); ++j) {
    sum[j] += term2 + term4;
    const auto n = static_cast<long double>(2 * j + 1);
    term2 *= -4.0L * x * x / (n * (n + 1.0L));
    term4 *= -16.0L * x * x / (n * (n + 1.0L));
  }
}

/// The rod's integral over x of an element's series, by Gauss-Legendre quadrature: the series'
/// coefficients are polynomials in x, of a degree that these points integrate to rounding.
template <class Add>
void integrate(Series& sum, long double weight, Add&& add_element) {
  constexpr int num_points = 64;
  for (int i = 0; i < num_points; ++i) {
    // Newton's iteration for the i-th root of the Legendre polynomial.
    long double z = std::cos(pi * (i + 0.75L) / (num_points + 0.5L)), slope = 0.0L;
    for (int iteration = 0; iteration < 8; ++iteration) {
      long double p = 1.0L, before = 0.0L;
      for (int k = 1; k <= num_points; ++k) {
        const long double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = num_points * (z * p - before) / (z * z - 1.0L);
      z -= p / slope;
    }
    const long double share = 1.0L / ((1.0L - z * z) * slope * slope);  // on [0, 1]
    add_element(sum, (1.0L + z) / 2.0L, weight * share);
  }
}

}  // namespace

SectionSeries printed_series(const Section& s, double payload) {
  // Translation: as derived, but the disks at half weight (H5, H6).
  Section rod = s;
  rod.num_disks = 0;
  rod.backbone_diameter = 0.0;  // no rotary inertia
  Section disks = s;
  disks.backbone_mass = 0.0;
  disks.disk_diameter = 0.0;
  SectionSeries series = exact_series(rod, payload);
  const SectionSeries translation = exact_series(disks, 0.0);
  series.a = series.a + 0.5L * translation.a;
  series.b = series.b + 0.5L * translation.b;

  // Rotation: M22/sigma gets H4/theta^2 and H8/theta^2, M11 gets H3 and H7.
  const long double d = s.backbone_diameter;
  const long double rod_inertia = s.length * (pi / 64.0L) * d * d * d * d;  // l I_b [m^5]
  const long double disk_inertia =
      static_cast<long double>(s.disk_mass) * s.disk_diameter * s.disk_diameter / 16.0L;
  Series turning(series.a.size(), 0.0L), dropped(series.a.size(), 0.0L);
  integrate(turning, rod_inertia, add_turning);
  integrate(dropped, rod_inertia, add_dropped_chain_rule);
  for (int k = 1; k <= s.num_disks; ++k) {
    const long double x = static_cast<long double>(k) / s.num_disks;
    add_turning(turning, x, disk_inertia);
    add_dropped_chain_rule(dropped, x, disk_inertia);
  }
  series.a = series.a + turning;
  // b = (M11 - a)/sigma; the constants cancel, both being sum of I x^2.
  for (std::size_t j = 0; j + 1 < dropped.size(); ++j) {
    series.b[j] += dropped[j + 1] - turning[j + 1];
  }

  const SectionSeries weight = exact_series(s, payload);
  series.G_A = weight.G_A;
  series.G_S = weight.G_S;
  return series;
}

SectionSeries cut_after_fourth_power(SectionSeries series) {
  // M22 = a sigma and M11 = a + b sigma, both up to sigma^2.
  series.b = {series.b[0], series.b[1] + series.a[2]};
  series.a.resize(2);
  return series;
}

}  // namespace detail
}  // namespace cdcr
