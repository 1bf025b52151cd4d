#pragma once

#include "section/magnus.hpp"
#include "section/rod_parameters.hpp"

// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result): counts of rows and coordinates,
// all small

namespace cdcr::detail {

/// A rod from its base to a fraction of its length: where that is, and how it moves with q. The tip
/// is that of the rod's own nodes; other places are reached in equal steps, cpp/rods.md eqs. (68),
/// (69).
template <class S>
struct RodPart {
  static constexpr int max_m = max_rod_coordinates;
  using Matrix3m = Eigen::Matrix<S, 3, Eigen::Dynamic, Eigen::ColMajor, 3, max_m>;

  Vector3<S> r;           // from the base to the end
  Matrix3m J_omega, J_v;  // omega_end = omega + J_omega qd, v_end = v + omega x r + J_v qd

  void update_position(const SectionParameters& section, const FrameState<S>& at, const S* q,
                       double fraction = 1.0);

  /// Frame at the end; how fast it turns is left out.
  [[nodiscard]] FrameState<S> end() const {
    return {axes_.col(0), axes_.col(1), axes_.col(2), Vector3<S>::Zero()};
  }

 private:
  static constexpr int num_steps = 12;
  using Step = std::array<LegendreValues, 3>;

  /// dr/dx, d2r/dx2 and d3r/dx3 at a place, and how they change with q.
  struct Derivatives {
    std::array<Vector3<S>, 3> d;
    std::array<Matrix3m, 3> J;

    Derivatives() = default;
    Derivatives(const RodPart& part, const RodParameters& rod, double x, const S* q);
  };

  /// Turns `axes_` and J_omega by one step, eqs. (54), (55).
  void turn(const ArcTable& arcs, const RodParameters& rod, const Step& step, const S* q);

  Matrix3<S> axes_;  // at the end
};

}  // namespace cdcr::detail

// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)
