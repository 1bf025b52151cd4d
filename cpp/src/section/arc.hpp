#pragma once

#include <memory>

#include "section/section_state.hpp"
#include "section/section_table.hpp"

namespace cdcr::detail {

/// The table on any scalar that has such a function.
template <class S>
void read_arcs(const ArcTable& arcs, const S& sigma, ArcValues<S>& f) {
  read(arcs, sigma, f);
}

struct RodParameters;

/// What is fixed about a section, a constant-curvature one if it is no rod.
struct SectionParameters {
  std::shared_ptr<const SectionTable> table;  // shared by sections that are equal
  const ArcTable* arcs;
  double length, mass, stiffness, damping;
  std::shared_ptr<const RodParameters> rod =
      nullptr;  // of a rod, which needs nothing else but mass
};

/// A circular arc from a section's base to a fraction of its length, cpp/several-sections.md
/// eqs. (23) to (25): where it ends, and how the end moves with q.
template <class S>
struct Arc {
  static constexpr int max_m = 2;
  using Matrix3m = Eigen::Matrix<S, 3, max_m>;

  FrameState<S> base;
  S q_x, q_y;
  ArcValues<S> arc;
  Vector3<S> q;           // the bending vector in space
  Vector3<S> r;           // from the base to the end
  Matrix3m J_omega, J_v;  // omega_end = omega + J_omega qd, v_end = v + omega x r + J_v qd

  void update_position(const SectionParameters& section, const FrameState<S>& at, const S* bending,
                       double fraction = 1.0) {
    base = at;
    q_x = fraction * bending[0];
    q_y = fraction * bending[1];
    read(*section.arcs, S(q_x * q_x + q_y * q_y), arc);
    const double l = fraction * section.length;
    q = base.x * q_x + base.y * q_y;
    r = l * (arc[arc_a] * q + arc[arc_s] * base.z);
    const Vector3<S> g = arc[arc_a] * base.z + arc[arc_g] * q;
    const Vector3<S> dr = (2.0 * l) * (arc[arc_da] * q + arc[arc_ds] * base.z);
    J_omega.col(0) = base.y - g * q_y;
    J_omega.col(1) = g * q_x - base.x;
    const S alpha = l * arc[arc_a];
    J_v.col(0) = alpha * base.x + dr * q_x;
    J_v.col(1) = alpha * base.y + dr * q_y;
    if (fraction != 1.0) {
      J_omega *= S(fraction);
      J_v *= S(fraction);
    }
  }

  /// Frame at the end, eq. (24); how fast it turns is left out.
  [[nodiscard]] FrameState<S> end() const {
    const S along = 1.0 - (q_x * q_x + q_y * q_y) * arc[arc_a];
    const Vector3<S> pull = arc[arc_s] * base.z + arc[arc_a] * q;
    return {base.x - pull * q_x, base.y - pull * q_y, along * base.z + arc[arc_s] * q,
            Vector3<S>::Zero()};
  }
};

}  // namespace cdcr::detail
