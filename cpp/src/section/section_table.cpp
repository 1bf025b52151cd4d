// From the elements of a section to the power series of everything it adds to a chain.
//
// An element at fraction x has mass m, transverse inertia I and axial inertia 2 I. With
// y = x theta its place is r = l x^2 A q + l x S z, its tangent t = x S q + cos(y) z, and it turns
// at  omega = x z x qd + x^2 A c z + x^3 G c q,  c = (q x qd).z,  beside the section's base. Then
// (cpp/several-sections.md eqs. (26) to (28)), with ' = d/d(y^2):
//   h0 = sum m l x S                       h1 = sum m l x^2 A
//   c0 = sum 2 m l^2 x^2 A + I             c1 = sum -m l^2 x^4 A^2 + I x^2 S^2
//   c2 = sum -m l^2 x^3 A S + I x S cos y  c3 = sum -m l^2 x^2 S^2 + I cos^2 y
//   k0 = sum m l^2 x^3 A S + I x           k1 = sum I x^3 (G - A S)
//   k2 = sum m l^2 x^4 A^2 + I x^2 y^2 A^2 k3 = sum 2 m l^2 x^5 (A S' - S A')
//   C1 = -2 k0' + 3 k1 + 2 sigma k1' - k3  C0 = 2 k2 + 2 sigma k2'
#include "section/section_table.hpp"

#include <cstddef>

#include "section/mass_moments.hpp"
#include "section/taylor_shift.hpp"

namespace cdcr::detail {
namespace {

/// sum over j of (-s)^j / (2j + offset)!: cos y, S, A, G of y^2 = s for offsets 0 to 3.
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

/// What one element contributes, as series in y^2: the same for every section.
struct ElementSeries {
  Series cosine = even_function(0), S = even_function(1), A = even_function(2),
         G = even_function(3);
  Series A2 = A * A, S2 = S * S, AS = A * S, S_cosine = S * cosine, cosine2 = cosine * cosine;
  Series k1 = G - AS, k2 = times_argument(A2), k3 = A * derivative(S) - S * derivative(A);
};

Series constant(long double value) {
  Series f(num_terms, 0.0L);
  f[0] = value;
  return f;
}

/// sum over elements of weight x^p f(x^2 sigma), as a series in sigma.
Series sum(const Moments& weight, int p, Series f) {
  for (std::size_t j = 0; j < f.size(); ++j) f[j] *= weight(p + 2 * static_cast<int>(j));
  return f;
}

}  // namespace

SectionTable section_table(const Section& section) {
  static const ElementSeries element;
  const Moments mass = Moments::of_mass(section, 0.0L);
  const Moments inertia = Moments::of_inertia(section);
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
  f[k2] = l2 * sum(mass, 4, element.A2) + sum(inertia, 2, element.k2);
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
