#pragma once

#include "section/polynomial_table.hpp"

// What one section of a chain knows about its own shape: every coefficient of its inertia, and of
// the frames along an arc, as a function of sigma alone (cpp/several-sections.md eqs. (26) to
// (29)).

namespace cdcr::detail {

/// Places of a section's functions in its table; d stands for d/d sigma.
enum ShapeFunction : int {
  // clang-format off
  h0, h1, dh0, dh1, ddh0, ddh1,        // first moment h1 q + h0 z
  c0, c1, c2, c3, dc0, dc1, dc2, dc3,  // second moment
  k0, k1, k2, k3, dk0, dk1, dk2, dk3,  // angular momentum of bending
  in_a, in_b, d_a, d_b,                // a 1 + b q q^T
  spin_q, spin_z,                      // gyroscopic vector C1 q + C0 z
  num_shape_functions
  // clang-format on
};

/// A, S, G of y^2 and their derivatives: the same for every section.
enum ArcFunction : int {
  // clang-format off
  arc_a, arc_s, arc_g, arc_da, arc_ds, arc_dg, arc_dda, arc_dds,
  num_arc_functions
  // clang-format on
};

template <class S>
using ShapeValues = Eigen::Array<S, num_shape_functions, 1>;
template <class S>
using ArcValues = Eigen::Array<S, num_arc_functions, 1>;

using SectionTable = PolynomialTable<num_shape_functions>;
using ArcTable = PolynomialTable<num_arc_functions>;

/// The ShapeFunctions of a section that carries no payload.
[[nodiscard]] SectionTable section_table(const Section& section);

/// Made at the first call; constructors of Model make it, so that nothing is made in a loop.
[[nodiscard]] const ArcTable& arc_table();

}  // namespace cdcr::detail
