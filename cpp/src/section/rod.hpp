#pragma once

#include "section/rod_frames.hpp"

namespace cdcr::detail {

/// The kind of section (section_state.hpp) whose bending, twist and stretch vary along it: rigid
/// elements at nodes, cpp/rods.md eqs. (58) to (62). The number of coordinates is that of its
/// parameters.
template <class S>
struct Rod : RodFrames<S> {
  using Scalar = S;
  using RodFrames<S>::m, RodFrames<S>::max_m;
  using Matrix3m = typename RodFrames<S>::Matrix3m;
  using Matrixm = Eigen::Matrix<S, m, m, Eigen::ColMajor, max_m, max_m>;
  using Vectorm = Eigen::Matrix<S, m, 1, Eigen::ColMajor, max_m, 1>;

  using RodFrames<S>::base, RodFrames<S>::rod, RodFrames<S>::axes, RodFrames<S>::r,
      RodFrames<S>::J_omega, RodFrames<S>::J_v;

  Rod() {}  // NOLINT(modernize-use-equals-default): that would set all of it to zero

  Vector3<S> tip_angular_bias, tip_linear_bias, moment, force;
  Vectorm bias;
  Vectorm elastic;

  void update_position(const SectionParameters& section, const FrameState<S>& at, const S* q);

  /// Frame at the tip; how fast it turns is left out.
  [[nodiscard]] FrameState<S> end() const {
    return {axes.col(0), axes.col(1), axes.col(2), Vector3<S>::Zero()};
  }
  /// omega of the tip.
  [[nodiscard]] Vector3<S> turning_rate() const {
    return base.omega + omega_at.get(rod->num_frames());
  }

  template <bool turns>
  void update_velocity(const SectionParameters&, const Vector3<S>& omega, const S* qd);

  [[nodiscard]] Vector3<S> first_moment() const;
  [[nodiscard]] Matrix3<S> second_moment() const;
  [[nodiscard]] Matrix3m linear_coupling() const;
  [[nodiscard]] Matrix3m angular_coupling() const;
  [[nodiscard]] Matrixm own_mass() const;

  [[nodiscard]] static Vectorm elastic_force(const SectionParameters& section, const S* q);
  [[nodiscard]] static S elastic_energy(const SectionParameters& section, const S* q);

 private:
  using typename RodFrames<S>::L;
  using typename RodFrames<S>::Pack;
  using typename RodFrames<S>::RowPack;
  using RodFrames<S>::axes_at, RodFrames<S>::omega_at, RodFrames<S>::omega_dot_at,
      RodFrames<S>::places, RodFrames<S>::v_at, RodFrames<S>::v_dot_at, RodFrames<S>::rows,
      RodFrames<S>::node_rows, RodFrames<S>::turning_rows, RodFrames<S>::spin_row,
      RodFrames<S>::copy, RodFrames<S>::move;

  void add_material_damping(const S* qd);
  [[nodiscard]] auto mass(int k) const { return L::weights(&rod->rule.mass[k]); }
  [[nodiscard]] auto inertia(int k) const { return L::weights(&rod->rule.inertia[k]); }
  [[nodiscard]] static Vector3<S> total(const Vector3<Pack>& v) {
    return {L::total(v[0]), L::total(v[1]), L::total(v[2])};
  }

  /// Rows from `first` on of the lower half of rows^T weighed: as many at once as there are lanes.
  template <int first, class Width>
  void add_products(Width width, int num_rows, const S* weighed, Matrixm& M) const;

  template <bool turns, class Width>
  void add_inertia_forces(Width width);
};

}  // namespace cdcr::detail
