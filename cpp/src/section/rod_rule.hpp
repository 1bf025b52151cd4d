#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "cdcr/robot.hpp"

// Nodes along a rod: where its frames are computed and its mass is summed up
// (cpp/rods.md eqs. (53), (54), (57)).

namespace cdcr::detail {

/// What a rod weighs, and where: a backbone uniform in volume, and disks.
struct RodMass {
  double backbone_mass;                // [kg]
  double base_diameter, tip_diameter;  // linear in between [m]
  double inner_diameter;               // of a tube, otherwise 0 [m]
  std::vector<Disk> disks;
};

inline constexpr int max_rod_nodes = max_nodes;
/// Nodes whose values and slopes an integral from one node to the next is made of.
inline constexpr int num_neighbours = 6;
inline constexpr int max_legendre_order = max_order;

/// P_j(2x - 1), j = 0..max_legendre_order.
using LegendreValues = std::array<double, max_legendre_order + 1>;

/// A point of a rod; the first is the base, the last the tip.
struct RodNode {
  double x;        // fraction of the length
  double mass;     // weight in sums over the rod's mass [kg]
  double inertia;  // the same of I_t, about a diameter; 2 I_t about the axis [kg m^2]
  LegendreValues legendre, legendre_slope;  // at x
  // From the node before to this one: alpha_1, alpha_2, alpha_3 of the Magnus series (magnus.hpp)
  // are sums over j of these times the coefficients u_j.
  std::array<LegendreValues, 3> step;
  // The integral of f over the same is the sum of value f + slope df/dx over the nodes from this
  // on.
  struct Weight {
    double value, slope;
  };
  int first_neighbour;
  std::vector<Weight> integral;
};

/// Nodes at the base and at the Gauss-Radau rule of the rod's mass, whose last one is the tip: sums
/// over the mass are exact for polynomials up to degree 2 num_nodes - 2, those over the moments of
/// inertia up to degree num_nodes. The base is not counted.
[[nodiscard]] std::vector<RodNode> rod_nodes(const RodMass& rod, int num_nodes);

/// Gauss-Legendre on [0, 1]: exact up to degree 2 count - 1.
struct GaussPoint {
  long double x, weight;
};
[[nodiscard]] std::vector<GaussPoint> gauss_legendre(int count);
/// The same of 40 points, more than anything here needs.
[[nodiscard]] const std::vector<GaussPoint>& gauss_legendre();

/// P_j(2x - 1) of all orders, and their first and second derivatives with respect to x.
template <class Real>
[[nodiscard]] std::array<Real, max_legendre_order + 1> legendre(Real x) {
  const Real s = 2 * x - 1;
  std::array<Real, max_legendre_order + 1> P{1, s};
  for (int j = 1; j < max_legendre_order; ++j) {
    P[j + 1] = ((2 * j + 1) * s * P[j] - j * P[j - 1]) / (j + 1);
  }
  return P;
}
template <class Real>
[[nodiscard]] std::array<Real, max_legendre_order + 1> legendre_slope(Real x) {
  const auto P = legendre(x);
  std::array<Real, max_legendre_order + 1> slope{0, 2};
  for (int j = 1; j < max_legendre_order; ++j) {
    slope[j + 1] = slope[j - 1] + 2 * (2 * j + 1) * P[j];
  }
  return slope;
}

template <class Real>
[[nodiscard]] std::array<Real, max_legendre_order + 1> legendre_curve(Real x) {
  const auto slope = legendre_slope(x);
  std::array<Real, max_legendre_order + 1> curve{0, 0};
  for (int j = 1; j < max_legendre_order; ++j) {
    curve[j + 1] = curve[j - 1] + 2 * (2 * j + 1) * slope[j];
  }
  return curve;
}

/// Weights from one place to another that make alpha_1, alpha_2, alpha_3 of the Magnus series out
/// of the coefficients u_j, by three Gauss points in between.
template <class Real>
[[nodiscard]] std::array<LegendreValues, 3> step_of(Real from, Real to) {
  const Real h = to - from, centre = (from + to) / 2, root = std::sqrt(Real(15));
  const auto low = legendre(centre - h * root / 10), middle = legendre(centre),
             high = legendre(centre + h * root / 10);
  std::array<LegendreValues, 3> step{};
  for (std::size_t j = 0; j <= max_legendre_order; ++j) {
    step[0][j] = static_cast<double>(h * middle[j]);
    step[1][j] = static_cast<double>(h * root / 3 * (high[j] - low[j]));
    step[2][j] = static_cast<double>(h * 10 / 3 * (high[j] - 2 * middle[j] + low[j]));
  }
  return step;
}

}  // namespace cdcr::detail
