#pragma once

#include <array>
#include <cmath>

#include "section/rod_parameters.hpp"
#include "section/width.hpp"

// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result): counts of rows and coordinates,
// all small

namespace cdcr::detail {

/// Gauss points that sum up the length of a cable: those of the rod, and more where it winds.
[[nodiscard]] int num_path_points(const RodParameters& rod, const CableRoute& route) noexcept;

/// A cable in one rod, its length summed up at Gauss points, cpp/rods.md eqs. (63), (64).
class RodCable {
 public:
  RodCable(const RodParameters& rod, const CableRoute& route);

  /// Length [m] at the rod's coordinates q; adds `pull` times -dl/dq to the generalised force, that
  /// of a cable under this tension. Real-time safe.
  template <class S>
  S length(const RodParameters& rod, const S* q, const S& pull, S* force) const {
    S sum(0.0);
    with_fma<S>([&] { sum = add(rod, q, pull, force); });
    return sum;
  }

  /// Adds `pull` times the second derivatives of the length to the lower half of K (m, m). Its body
  /// is in derivatives/cable_curvature.cpp. Real-time safe.
  void add_curvature(const RodParameters& rod, const double* q, double pull, MatrixRef K) const;

 private:
  using Values = std::array<double, max_rod_nodes>;

  template <class S>
  S add(const RodParameters& rod, const S* q, const S& pull, S* force) const {
    using std::sqrt;
    using L = Lanes<S>;
    using Pack = typename L::Pack;
    struct Pull {
      Pack x, y, twist, along;  // on the strains at a point
    };
    std::array<Pull, max_rod_nodes / L::count> pulls;
    Pack sum(0.0);
    for (int k = 0; k < num_points_; k += L::count) {
      // s = (0, 0, l + e) + u x d + d' of the path.
      const Vector3d& locked = rod.locked_turning;
      Pack q_x(locked[1]), q_y(-locked[0]), twist(locked[2]), along(rod.length);
      for (int i = 0; i < rod.num_bending; ++i) {
        const auto weight = L::weights(&legendre_[i][k]);
        q_x += weight * q[2 * i];
        q_y += weight * q[2 * i + 1];
      }
      for (int i = 0; i < rod.num_twist; ++i) {
        twist += L::weights(&legendre_[i][k]) * q[rod.first_twist + i];
      }
      for (int i = 0; i < rod.num_stretch; ++i) {
        along += L::weights(&legendre_[i][k]) * q[rod.first_stretch + i];
      }
      const auto x = L::weights(&x_[k]), y = L::weights(&y_[k]), weight = L::weights(&weight_[k]);
      const Pack s_x = L::weights(&slope_x_[k]) - y * twist,
                 s_y = L::weights(&slope_y_[k]) + x * twist, s_z = along - x * q_x - y * q_y;
      const Pack s = sqrt(Pack(s_x * s_x + s_y * s_y + s_z * s_z));
      sum += weight * s;
      const Pack share = weight * pull / s, on_bending = share * s_z;
      pulls[k / L::count] = {x * on_bending, y * on_bending, share * (y * s_x - x * s_y),
                             -on_bending};
    }
    const auto add_all = [&](S& to, int i, Pack Pull::* part) {
      Pack all(0.0);
      for (int k = 0; k < num_points_; k += L::count) {
        all += L::weights(&legendre_[i][k]) * pulls[k / L::count].*part;
      }
      to += L::total(all);
    };
    for (int i = 0; i < rod.num_bending; ++i) {
      add_all(force[2 * i], i, &Pull::x);
      add_all(force[2 * i + 1], i, &Pull::y);
    }
    for (int i = 0; i < rod.num_twist; ++i) add_all(force[rod.first_twist + i], i, &Pull::twist);
    for (int i = 0; i < rod.num_stretch; ++i) {
      add_all(force[rod.first_stretch + i], i, &Pull::along);
    }
    return L::total(sum);
  }

  int num_points_;
  // At the points; of weight zero beyond.
  Values weight_{};
  Values x_{}, y_{}, slope_x_{}, slope_y_{};  // of the hole in the disk's frame, over the fraction
  std::array<Values, max_legendre_order + 1> legendre_{};
};

}  // namespace cdcr::detail

// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)
