#include "derivatives/cable_curvature.hpp"

#include <algorithm>

namespace cdcr::detail {

void CableCurvature::add(const RodCable& cable, double pull, MatrixRef K) {
  const int num_points = cable.num_points_;
  if (points_ == nullptr || points_->num_points_ != num_points) {
    finish(K);
    points_ = &cable;
    cable.find_strains(rod_, q_, strains_);
    for (auto& row : sums_) {
      for (auto& of_pair : row) of_pair.fill(Pair(0.0));
    }
  }
  with_fma<double>([&] {
    for (int k = 0; k < num_points; k += L::count) {
      // With s = |s| t, d2|s| = (ds.ds - (t.ds)^2)/|s|, where ds is linear in the strains. All but
      // the twist change s_z alone.
      const int p = k / L::count;
      const Pair twist = strains_[twisting][p];
      const Pair d_x = L::load(&cable.x_[k]), d_y = L::load(&cable.y_[k]);
      const Pair s_x = L::load(&cable.slope_x_[k]) - d_y * twist,
                 s_y = L::load(&cable.slope_y_[k]) + d_x * twist,
                 s_z = strains_[stretching][p] - d_x * strains_[bending_x][p] -
                       d_y * strains_[bending_y][p];
      const Pair shorter = 1.0 / sqrt(s_x * s_x + s_y * s_y + s_z * s_z);
      const Pair t_x = shorter * s_x, t_y = shorter * s_y, t_z = shorter * s_z;
      const Pair round = d_x * t_y - d_y * t_x, share = pull * L::load(&cable.weight_[k]) * shorter;
      const Pair across = share * (t_x * t_x + t_y * t_y), mixed = -share * t_z * round;
      sums_[bending_x][bending_x][p] += across * d_x * d_x;
      sums_[bending_y][bending_x][p] += across * d_x * d_y;
      sums_[bending_y][bending_y][p] += across * d_y * d_y;
      sums_[twisting][bending_x][p] -= mixed * d_x;
      sums_[twisting][bending_y][p] -= mixed * d_y;
      sums_[twisting][twisting][p] += share * (d_x * d_x + d_y * d_y - round * round);
      sums_[stretching][bending_x][p] -= across * d_x;
      sums_[stretching][bending_y][p] -= across * d_y;
      sums_[stretching][twisting][p] += mixed;
      sums_[stretching][stretching][p] += across;
    }
  });
}

void CableCurvature::finish(MatrixRef K) {
  if (points_ == nullptr) return;
  const int num_packs = (points_->num_points_ + L::count - 1) / L::count;
  with_fma<double>([&] {
    for (int j = 0; j < rod_.size(); ++j) {
      const double* P_j = points_->legendre_[rod_.order_of[j]].data();
      for (int c = j; c < rod_.size(); ++c) {
        const double* P_c = points_->legendre_[rod_.order_of[c]].data();
        const StrainKind a = rod_.strain_of[c], b = rod_.strain_of[j];
        const auto& of_pair = sums_[std::max(a, b)][std::min(a, b)];
        Pair sum(0.0);
        for (int p = 0, k = 0; p < num_packs; ++p, k += L::count) {
          sum += L::load(P_c + k) * L::load(P_j + k) * of_pair[p];
        }
        K(c, j) += L::total(sum);
      }
    }
  });
}

}  // namespace cdcr::detail
