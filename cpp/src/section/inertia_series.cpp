// The derivation in one place: from the elements of a section to the power series of everything it
// adds to a robot.
//
// An element at fraction x of the length has mass m, transverse inertia I and axial inertia 2 I (a
// thin disk). With y = x theta its place is r = l x^2 A q + l x S z, its tangent
// t = x S q + cos(y) z, and it turns at  omega = x z x qd + x^2 A c z + x^3 G c q,
// c = (q x qd).z,  beside the section's base. cos y, S, A, G are power series in y^2 = x^2 sigma,
// so every sum over elements touches only the moments sum m x^p.
//
// Alone on a fixed base, with the planar speed D = |d r/d theta|^2/(l^2 x^4) (cpp/README.md):
//   a = sum m l^2 x^4 A^2 + I x^2 S^2 + 2 I x^2 y^2 A^2                         (9)
//   b = sum m l^2 x^6 (D - A^2)/y^2 + I x^4 (1 - S^2)/y^2 - 2 I x^4 A^2         (10)
//   G_A = sum m x^2 A,  G_S = sum m x S                                        (13), (14)
// In a chain, with ' = d/d(y^2) (cpp/several-sections.md eqs. (26) to (28)):
//   h0 = sum m l x S                       h1 = sum m l x^2 A
//   c0 = sum 2 m l^2 x^2 A + I             c1 = sum -m l^2 x^4 A^2 + I x^2 S^2
//   c2 = sum -m l^2 x^3 A S + I x S cos y  c3 = sum -m l^2 x^2 S^2 + I cos^2 y
//   k0 = sum m l^2 x^3 A S + I x           k1 = sum I x^3 (G - A S)
//   k2 = sum m l^2 x^4 A^2 + I x^2 y^2 A^2 k3 = sum 2 m l^2 x^5 (A S' - S A')
//   C1 = -2 k0' + 3 k1 + 2 sigma k1' - k3  C0 = 2 k2 + 2 sigma k2'
#include "section/inertia_series.hpp"

#include "section/mass_moments.hpp"
#include "section/section_table.hpp"

namespace cdcr::detail {
namespace {

/// What one element contributes, as series in y^2: the same for every section.
struct ElementSeries {
  Series one = constant(1.0L), cosine = even_function(0), S = even_function(1),
         A = even_function(2), G = even_function(3);
  Series A2 = A * A, S2 = S * S, AS = A * S, S_cosine = S * cosine, cosine2 = cosine * cosine;
  Series D = over_argument(one + 2.0L * (A - S));
  Series spread = over_argument(D - A2), turn = over_argument(one - S2), spin = times_argument(A2);
  Series k1 = G - AS, k3 = A * derivative(S) - S * derivative(A);
};

const ElementSeries& element_series() {
  static const ElementSeries series;
  return series;
}

/// sum over elements of weight x^p f(x^2 sigma), as a series in sigma.
Series sum(const MassMoments& weight, int p, Series f) {
  for (std::size_t j = 0; j < f.size(); ++j) f[j] *= weight(p + 2 * static_cast<int>(j));
  return f;
}

}  // namespace

SectionSeries exact_series(const Section& section, double payload) {
  const ElementSeries& element = element_series();
  const MassMoments mass = MassMoments::of_mass(section, payload);
  const MassMoments inertia = MassMoments::of_inertia(section);
  const long double l2 = static_cast<long double>(section.length) * section.length;
  return {l2 * sum(mass, 4, element.A2) + sum(inertia, 2, element.S2) +
              2.0L * sum(inertia, 2, element.spin),
          l2 * sum(mass, 6, element.spread) + sum(inertia, 4, element.turn) -
              2.0L * sum(inertia, 4, element.A2),
          sum(mass, 2, element.A), sum(mass, 1, element.S)};
}

SectionTable section_table(const Section& section) {
  const ElementSeries& element = element_series();
  const MassMoments mass = MassMoments::of_mass(section, 0.0L);
  const MassMoments inertia = MassMoments::of_inertia(section);
  const long double l = section.length, l2 = l * l;
  std::vector<Series> f(num_shape_functions);
  f[h0] = l * sum(mass, 1, element.S);
  f[h1] = l * sum(mass, 2, element.A);
  f[c0] = 2.0L * l2 * sum(mass, 2, element.A) + constant(inertia(0));
  f[c1] = sum(inertia, 2, element.S2) - l2 * sum(mass, 4, element.A2);
  f[c2] = sum(inertia, 1, element.S_cosine) - l2 * sum(mass, 3, element.AS);
  f[c3] = sum(inertia, 0, element.cosine2) - l2 * sum(mass, 2, element.S2);
  f[k0] = l2 * sum(mass, 3, element.AS) + constant(inertia(1));
  f[k1] = sum(inertia, 3, element.k1);
  f[k2] = l2 * sum(mass, 4, element.A2) + sum(inertia, 2, element.spin);
  f[k3] = 2.0L * l2 * sum(mass, 5, element.k3);
  const SectionSeries alone = exact_series(section, 0.0);
  f[in_a] = alone.a;
  f[in_b] = alone.b;
  f[spin_q] =
      3.0L * f[k1] - 2.0L * derivative(f[k0]) + 2.0L * times_argument(derivative(f[k1])) - f[k3];
  f[spin_z] = 2.0L * f[k2] + 2.0L * times_argument(derivative(f[k2]));
  return SectionTable(f, {{dh0, h0},
                          {dh1, h1},
                          {ddh0, dh0},
                          {ddh1, dh1},
                          {dc0, c0},
                          {dc1, c1},
                          {dc2, c2},
                          {dc3, c3},
                          {dk0, k0},
                          {dk1, k1},
                          {dk2, k2},
                          {dk3, k3},
                          {d_a, in_a},
                          {d_b, in_b}});
}

const ArcTable& arc_table() {
  static const ArcTable table = [] {
    std::vector<Series> f(num_arc_functions);
    f[arc_s] = even_function(1);
    f[arc_a] = even_function(2);
    f[arc_g] = even_function(3);
    return ArcTable(
        f,
        {{arc_da, arc_a}, {arc_ds, arc_s}, {arc_dg, arc_g}, {arc_dda, arc_da}, {arc_dds, arc_ds}});
  }();
  return table;
}

}  // namespace cdcr::detail
