#pragma once

#include <cmath>
#include <vector>

#include "section/rod_parameters.hpp"

namespace cdcr::detail {

/// A cable in one rod, its length summed up at Gauss points, cpp/rods.md eqs. (63), (64).
class RodCable {
 public:
  RodCable(const RodParameters& rod, const CableRoute& route);

  /// Length [m] at the rod's coordinates q; adds `pull` times -dl/dq to the generalised force, that
  /// of a cable under this tension. Real-time safe.
  template <class S>
  S length(const RodParameters& rod, const S* q, const S& pull, S* force) const {
    using std::sqrt;
    S sum(0.0);
    for (const Point& point : points_) {
      // s = (0, 0, l + e) + u x d + d' of the path.
      S q_x(rod.locked_turning[1]), q_y(-rod.locked_turning[0]), twist(rod.locked_turning[2]);
      S along(rod.length);
      for (Index i = 0; i < rod.num_bending; ++i) {
        q_x += point.legendre[i] * q[2 * i];
        q_y += point.legendre[i] * q[2 * i + 1];
      }
      for (int i = 0; i < rod.num_twist; ++i) twist += point.legendre[i] * q[rod.first_twist + i];
      for (int i = 0; i < rod.num_stretch; ++i) {
        along += point.legendre[i] * q[rod.first_stretch + i];
      }
      const S s_x = point.slope_x - twist * point.y, s_y = point.slope_y + twist * point.x,
              s_z = along - q_x * point.x - q_y * point.y;
      const S s = sqrt(s_x * s_x + s_y * s_y + s_z * s_z);
      sum += point.weight * s;
      const S share = point.weight * pull / s;
      const S on_bending = share * s_z, on_twist = share * (s_x * point.y - s_y * point.x);
      for (Index i = 0; i < rod.num_bending; ++i) {
        const S part = point.legendre[i] * on_bending;
        force[2 * i] += point.x * part;
        force[2 * i + 1] += point.y * part;
      }
      for (int i = 0; i < rod.num_twist; ++i) {
        force[rod.first_twist + i] += point.legendre[i] * on_twist;
      }
      for (int i = 0; i < rod.num_stretch; ++i) {
        force[rod.first_stretch + i] -= point.legendre[i] * on_bending;
      }
    }
    return sum;
  }

 private:
  struct Point {
    double weight;
    double x, y, slope_x, slope_y;  // of the hole in the disk's frame, over the fraction
    LegendreValues legendre;
  };
  std::vector<Point> points_;
};

}  // namespace cdcr::detail
