#pragma once

#include <cmath>
#include <vector>

#include "section/rod_parameters.hpp"

// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result): counts of rows and coordinates,
// all small

namespace cdcr::detail {

/// A cable that rubs along its path through one rod: at Gauss points, as RodCable sums up its
/// length, cpp/rods.md eqs. (65) to (67).
class RubbingPath {
 public:
  RubbingPath(const RodParameters& rod, const CableRoute& route);

  /// Adds the generalised force of a cable with this tension where it enters the rod, and gives
  /// the tension where it leaves. `rate` is that of the cable's length from the rod's base to its
  /// own end [m/s], and becomes that from the rod's tip; where the cable `ends` there, it slides in
  /// the last stretch as before it. Real-time safe.
  template <class S>
  S pull(const RodParameters& rod, const S* q, const S* qd, double mu, double sliding_speed,
         const S& tension_at_base, S& rate, bool ends, S* force) const {
    using std::exp;
    using std::sqrt;
    using std::tanh;
    S tension = tension_at_base;
    const auto num_points = static_cast<int>(points_.size());
    S turning[max_nodes];
    for (int i = 0; i < num_points; ++i) turning[i] = turning_at(rod, points_[i], q);
    S turned(0.0);
    // On the way to where the path has turned so far.
    const auto rub = [&](const S& until, const S& speed) {
      const S share = until - turned;
      if (share > 0.0) tension *= exp(S(mu * share * tanh(S(speed / sliding_speed))));
      turned = until;
    };
    S before = rate;
    for (int i = 0; i < num_points; ++i) {
      const Point& point = points_[i];
      rub(sum_of(point.before, turning), rate);
      before = rate;
      const Slope<S> s(rod, point, q, rod.length, rod.locked_turning);
      const S length = sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
      const Slope<S> changes(rod, point, qd, 0.0, Vector3d::Zero(), 0.0);
      rate -= point.weight * (s.x * changes.x + s.y * changes.y + s.z * changes.z) / length;
      const S share = point.weight * tension / length;
      const S on_bending = share * s.z, on_twist = share * (s.x * point.y - s.y * point.x);
      const S on[num_strains] = {point.x * on_bending, point.y * on_bending, on_twist, -on_bending};
      for (int c = 0; c < rod.size(); ++c) {
        force[c] += point.legendre[rod.order_of[c]] * on[rod.strain_of[c]];
      }
    }
    rub(sum_of(weights_, turning), ends ? before : rate);
    return tension;
  }

  /// By how much the path turns through the rod [rad].
  template <class S>
  S turn(const RodParameters& rod, const S* q) const {
    S turning[max_nodes];
    for (std::size_t i = 0; i < points_.size(); ++i) turning[i] = turning_at(rod, points_[i], q);
    return sum_of(weights_, turning);
  }

 private:
  struct Point {
    double weight;
    double x, y, slope_x, slope_y, curve_x, curve_y;  // of the hole in the disk's frame
    LegendreValues legendre, legendre_slope;
    std::vector<double> before;  // weights of the integral from the rod's base to here
  };

  /// Bending, twist and stretch at a point of this order of derivative.
  template <class S>
  struct Strains {
    S q_x, q_y, twist, stretch{0.0};
    Strains(const RodParameters& rod, const LegendreValues& P, const S* q, const Vector3d& locked)
        : q_x(locked[1]), q_y(-locked[0]), twist(locked[2]) {
      S* const of[num_strains] = {&q_x, &q_y, &twist, &stretch};
      for (int c = 0; c < rod.size(); ++c) *of[rod.strain_of[c]] += P[rod.order_of[c]] * q[c];
    }
  };

  /// s of the path, eq. (63), or with rates its rate, where the hole's own slope is left out.
  template <class S>
  struct Slope {
    S x, y, z;
    Slope(const RodParameters& rod, const Point& p, const S* q, double length,
          const Vector3d& locked, double own = 1.0) {
      const Strains<S> e(rod, p.legendre, q, locked);
      x = own * p.slope_x - e.twist * p.y;
      y = own * p.slope_y + e.twist * p.x;
      z = length + e.stretch - e.q_x * p.x - e.q_y * p.y;
    }
  };

  /// How fast the path turns with the fraction of the rod, |s x (s' + u x s)|/|s|^2.
  template <class S>
  static S turning_at(const RodParameters& rod, const Point& p, const S* q) {
    using std::sqrt;
    const Slope<S> s(rod, p, q, rod.length, rod.locked_turning);
    const Strains<S> e(rod, p.legendre, q, rod.locked_turning);
    const Strains<S> d(rod, p.legendre_slope, q, Vector3d::Zero());
    const S a_x = p.curve_x - d.twist * p.y - e.twist * p.slope_y + e.q_x * s.z - e.twist * s.y;
    const S a_y = p.curve_y + d.twist * p.x + e.twist * p.slope_x + e.twist * s.x + e.q_y * s.z;
    const S a_z = d.stretch - d.q_x * p.x - d.q_y * p.y - e.q_x * p.slope_x - e.q_y * p.slope_y -
                  e.q_y * s.y - e.q_x * s.x;
    const S c_x = s.y * a_z - s.z * a_y, c_y = s.z * a_x - s.x * a_z, c_z = s.x * a_y - s.y * a_x;
    const S squared = c_x * c_x + c_y * c_y + c_z * c_z;
    if (!(squared > 0.0)) return S(0.0);
    return sqrt(squared) / (s.x * s.x + s.y * s.y + s.z * s.z);
  }

  template <class S>
  static S sum_of(const std::vector<double>& weights, const S* values) {
    S sum(0.0);
    for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * values[i];
    return sum;
  }

  std::vector<Point> points_;
  std::vector<double> weights_;
};

}  // namespace cdcr::detail

// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)
