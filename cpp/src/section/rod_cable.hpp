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
  S length(const RodParameters& rod, const S* q, const S& pull, S* force) const;

 private:
  template <class S>
  friend class RodCables;
  friend class CableCurvature;
  using Values = std::array<double, max_rod_nodes>;

  template <class S, class Strains>
  void find_strains(const RodParameters& rod, const S* q, Strains& strains) const {
    using L = Lanes<S>;
    const Vector3d& locked = rod.locked_turning;
    const double at_first[num_strains] = {locked[1], -locked[0], locked[2], rod.length};
    for (int i = 0; i < num_strains; ++i) strains[i].fill(typename L::Pack(at_first[i]));
    for (int c = 0; c < rod.size(); ++c) {
      auto* const to = strains[rod.strain_of[c]].data();
      const double* const P = legendre_[rod.order_of[c]].data();
      for (int k = 0; k < num_points_; k += L::count) to[k / L::count] += L::weights(P + k) * q[c];
    }
  }

  int num_points_;
  // At the points; of weight zero beyond.
  Values weight_{};
  Values x_{}, y_{}, slope_x_{}, slope_y_{};  // of the hole in the disk's frame, over the fraction
  std::array<Values, max_legendre_order + 1> legendre_{};
};

/// Strains of a rod at the points of cables, or what pulls on them.
template <class S>
using PathStrains =
    std::array<std::array<typename Lanes<S>::Pack, max_rod_nodes / Lanes<S>::count>, num_strains>;

/// Cables in one rod, summed up together: strains are found once, and pulls go to the coordinates
/// once, as long as one cable after the other has as many points.
template <class S>
class RodCables {
 public:
  RodCables(const RodParameters& rod, const S* q, S* force) : rod_(rod), q_(q), force_(force) {}

  /// Length [m] of a cable, which pulls so strongly.
  S add(const RodCable& cable, const S& pull) {
    using std::sqrt;
    if (points_ == nullptr || points_->num_points_ != cable.num_points_) {
      finish();
      points_ = &cable;
      cable.find_strains(rod_, q_, strains_);
      for (auto& of_strain : pulls_) of_strain.fill(Pack(0.0));
    }
    Pack sum(0.0);
    for (int k = 0, p = 0; k < cable.num_points_; k += L::count, ++p) {
      // s = (0, 0, l + e) + u x d + d' of the path.
      const auto x = L::weights(&cable.x_[k]), y = L::weights(&cable.y_[k]),
                 weight = L::weights(&cable.weight_[k]);
      const Pack &twist = strains_[twisting][p], &bent_x = strains_[bending_x][p],
                 &bent_y = strains_[bending_y][p];
      const Pack s_x = L::weights(&cable.slope_x_[k]) - y * twist,
                 s_y = L::weights(&cable.slope_y_[k]) + x * twist,
                 s_z = strains_[stretching][p] - x * bent_x - y * bent_y;
      const Pack s = sqrt(Pack(s_x * s_x + s_y * s_y + s_z * s_z));
      sum += weight * s;
      const Pack share = weight * pull / s, on_bending = share * s_z;
      pulls_[bending_x][p] += x * on_bending;
      pulls_[bending_y][p] += y * on_bending;
      pulls_[twisting][p] += share * (y * s_x - x * s_y);
      pulls_[stretching][p] -= on_bending;
    }
    return L::total(sum);
  }

  /// After the last.
  void finish() {
    const int num_points = points_ == nullptr ? 0 : points_->num_points_;
    for (int c = 0; num_points > 0 && c < rod_.size(); ++c) {
      const double* const P = points_->legendre_[rod_.order_of[c]].data();
      const auto& pulls = pulls_[rod_.strain_of[c]];
      Pack all(0.0);
      for (int k = 0; k < num_points; k += L::count) all += L::weights(P + k) * pulls[k / L::count];
      force_[c] += L::total(all);
    }
  }

 private:
  using L = Lanes<S>;
  using Pack = typename L::Pack;

  const RodParameters& rod_;
  const S* q_;
  S* force_;
  const RodCable* points_ = nullptr;  // one that has them
  PathStrains<S> strains_, pulls_;
};

template <class S>
S RodCable::length(const RodParameters& rod, const S* q, const S& pull, S* force) const {
  S sum(0.0);
  with_fma<S>([&] {
    RodCables<S> alone(rod, q, force);
    sum = alone.add(*this, pull);
    alone.finish();
  });
  return sum;
}

}  // namespace cdcr::detail

// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)
