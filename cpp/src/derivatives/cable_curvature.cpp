#include "chain/cable_path.hpp"

namespace cdcr::detail {

void RodCable::add_curvature(const RodParameters& rod, const double* q, double pull,
                             MatrixRef K) const {
  // With s = |s| t, d2|s| = (ds.ds - (t.ds)^2)/|s|, where ds is linear in the strains: bending x
  // and y, twist and stretch. All but the twist change s_z alone.
  enum Strain { x, y, twist, stretch, num_strains };
  const int size = rod.size();
  std::array<Strain, max_rod_coordinates> strain_of{};
  std::array<int, max_rod_coordinates> order_of{};
  for (int c = 0; c < size; ++c) {
    if (c < rod.first_twist) {
      strain_of[c] = c % 2 == 0 ? x : y;
      order_of[c] = c / 2;
    } else {
      strain_of[c] = c < rod.first_stretch ? twist : stretch;
      order_of[c] = c - (c < rod.first_stretch ? rod.first_twist : rod.first_stretch);
    }
  }
  std::array<double, max_rod_coordinates> P{};
  std::array<std::array<double, max_rod_coordinates>, num_strains> with{};
  constexpr std::size_t most = max_rod_coordinates;
  std::array<double, most * most> sums;
  for (int i = 0; i < size * size; ++i) sums[i] = 0.0;
  for (int k = 0; k < num_points_; ++k) {
    const Vector3d& locked = rod.locked_turning;
    double strain[num_strains] = {locked[1], -locked[0], locked[2], rod.length};
    for (int c = 0; c < size; ++c) {
      P[c] = legendre_[order_of[c]][k];
      strain[strain_of[c]] += P[c] * q[c];
    }
    const double along[num_strains] = {-x_[k], -y_[k], 0.0, 1.0};
    const Vector3d s(slope_x_[k] - y_[k] * strain[twist], slope_y_[k] + x_[k] * strain[twist],
                     strain[stretch] + along[x] * strain[x] + along[y] * strain[y]);
    const double shorter = 1.0 / s.norm();
    const Vector3d t = s * shorter;
    const double round = x_[k] * t[1] - y_[k] * t[0], share = pull * weight_[k] * shorter;
    const double across = share * (t[0] * t[0] + t[1] * t[1]), mixed = -share * t[2] * round;
    for (int c = 0; c < size; ++c) {
      const double on_z = along[strain_of[c]] * P[c];
      if (strain_of[c] == twist) {
        for (const Strain a : {x, y, stretch}) with[a][c] = mixed * along[a] * P[c];
        with[twist][c] = share * (x_[k] * x_[k] + y_[k] * y_[k] - round * round) * P[c];
      } else {
        for (const Strain a : {x, y, stretch}) with[a][c] = across * along[a] * on_z;
        with[twist][c] = mixed * on_z;
      }
    }
    for (int j = 0; j < size; ++j) {
      const double* column = with[strain_of[j]].data();
      for (int c = j; c < size; ++c) sums[j * size + c] += P[j] * column[c];
    }
  }
  for (int j = 0; j < size; ++j) {
    for (int c = j; c < size; ++c) K(c, j) += sums[j * size + c];
  }
}

void CablePath::add_curvature(const Chain& chain, const double* q, double pull,
                              MatrixRef K) const noexcept {
  for (std::size_t i = 0; i < smooth_.size(); ++i) {
    const auto k = static_cast<std::size_t>(first_) + i;
    const RodParameters& rod = *chain.sections[k].rod;
    const Index at = chain.first[k];
    smooth_[i].add_curvature(rod, q + at, pull, K.block(at, at, rod.size(), rod.size()));
  }
}

}  // namespace cdcr::detail
