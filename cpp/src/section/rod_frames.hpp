#pragma once

#include <array>

#include "section/rod_turns.hpp"
#include "section/width.hpp"

// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result,readability-identifier-naming):
// counts of rows and coordinates, all small

namespace cdcr::detail {

/// Frames and nodes along a rod in one state: functions of q that are differentiated as they stand,
/// so that a model made of them conserves its own energy (cpp/rods.md eqs. (52) to (57)).
///
/// Jacobians are rows of one number for each coordinate, `width` apart: three for J_v of each node,
/// then three for J_omega of each frame but the base, then one for t^T J_omega of each of these.
template <class S>
struct RodFrames {
  static constexpr int m = Eigen::Dynamic, max_m = max_rod_coordinates;
  using Matrix3m = Eigen::Matrix<S, 3, m, Eigen::ColMajor, 3, max_m>;

  FrameState<S> base;
  const RodParameters* rod = nullptr;
  Matrix3<S> axes;        // at the tip
  Vector3<S> r;           // from base to tip
  Matrix3m J_omega, J_v;  // of the tip: omega = J_omega qd, v = J_v qd on a base at rest

  /// Frames, places and Jacobians of all points.
  void update_position(const SectionParameters& section, const FrameState<S>& at, const S* q);

  /// Takes from H (m, m) the second derivatives of the work of weight: of the rod's own mass, and
  /// of a mass beyond its tip whose first moment about the tip is h, cpp/derivatives.md eq. (80).
  /// Its body is in derivatives/rod_curvature.cpp.
  void subtract_curvature(const Vector3<S>& g, double mass, const Vector3<S>& h, MatrixRef H) const;

 protected:
  using L = Lanes<S>;
  using Pack = typename L::Pack;
  using RowPack = typename Rows<S>::Pack;

  // Of all frames, the base first: axes; omega and its rate from velocities alone on a base at
  // rest.
  FrameAxes<S> axes_at{};
  Vectors<S> omega_at{}, omega_dot_at{};
  // Of all nodes, the same.
  Vectors<S> places{}, v_at{}, v_dot_at{};
  alignas(row_alignment) std::array<S, (3 * max_rod_nodes + 4 * max_rod_frames) * max_m> rows;

  template <class Width>
  [[nodiscard]] const S* node_rows(Width width, int node) const {
    return rows.data() + 3 * node * width;
  }
  template <class Width>
  [[nodiscard]] const S* turning_rows(Width width, int frame) const {
    return rows.data() + 3 * (rod->num_nodes() + frame - 1) * width;
  }
  template <class Width>
  [[nodiscard]] const S* spin_row(Width width, int frame) const {
    return turning_rows(width, rod->num_frames() + 1) + (frame - 1) * width;
  }

  /// To a matrix of three rows.
  template <class Width>
  void copy(Width width, const S* from, Matrix3m& to) const {
    to.resize(3, rod->size());
    for (int i = 0; i < to.cols(); ++i) {
      for (int c = 0; c < 3; ++c) to(c, i) = from[c * width + i];
    }
  }

  /// Velocities of all points, and accelerations from velocities alone, on a base at rest.
  void move(const S* qd);

 private:
  /// Strains at frames, or their rates.
  struct Strain {
    Pack q_x, q_y, stretch, stretch_slope;
  };
  RodTurns<S> turns;
  std::array<Strain, (max_rod_frames + 1) / L::count> strain;

  [[nodiscard]] Strain strain_of(int k, const S* q) const;

  /// The vectors of a pack, each with a zero after it, this far apart.
  static void put(const Vector3<Pack>& v, S* to, int apart);

  /// f(node, integrals up to it) of `length` numbers, whose values and slopes stand after one
  /// another for each frame.
  template <int length, class F>
  void integrate_rows(const S* from, const F& f) const;
  /// From the node before to one. Sums begin anew at each, so that none waits for another.
  template <int max_packs, class Count>
  void integrate_step(Count num_packs, int k, const S* rows_of_frames, const S* before,
                      S* to) const;

  /// J_omega of all frames, and its share along the tangents.
  template <class Width>
  void turn(Width width);

  /// Places of all nodes, and J_v.
  template <class Width>
  void integrate(Width width, const S* q);

  /// Of three rows.
  static int packs_in(int width) { return 3 * width; }
  template <int width>
  static constexpr auto packs_in(std::integral_constant<int, width>) {
    return std::integral_constant<int, 3 * width / Rows<S>::count>();
  }
};

}  // namespace cdcr::detail

// NOLINTEND(bugprone-implicit-widening-of-multiplication-result,readability-identifier-naming)
