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
inline constexpr int max_rod_frames = max_rod_nodes - 1;  // with the base
inline constexpr int max_rod_steps = 64;
/// Frames whose values and slopes an integral from one node to the next is made of.
inline constexpr int num_neighbours = 7;
inline constexpr int max_legendre_order = max_order;

/// P_j(2x - 1), j = 0..max_legendre_order.
using LegendreValues = std::array<double, max_legendre_order + 1>;

/// Where mass is summed up. The last is the tip.
struct RodNode {
  double x;  // fraction of the length
  // The integral of f from the node before (the base) to this one is the sum of value f +
  // slope df/dx over the frames from this on.
  struct Weight {
    double value, slope;
  };
  int first_neighbour;
  std::array<Weight, num_neighbours> integral;
};

/// Where frames are known and rotary inertia is summed up. The first is the base, the last the tip.
struct RodFrame {
  double x;
  int steps_before;  // from the base
};

/// Steps from frame to frame, one or more each; a last one of length zero may make them even.
struct RodSteps {
  int count = 0;
  // alpha_1, alpha_2, alpha_3 of the Magnus series (magnus.hpp) are sums over j of weights[i][j]
  // of the step times the coefficients u_j; those of j < i are zero.
  std::array<std::array<std::array<double, max_rod_steps>, max_legendre_order + 1>, 3> weights{};
};

struct RodRule {
  /// The nodes are those of the Gauss-Lobatto rule of the rod's mass, exact for polynomials up to
  /// degree 2 num_nodes - 1, but for its base, which does not move. The frames are those of the
  /// same rule of the moments of inertia, two fewer.
  RodRule(const RodMass& rod, int num_nodes);

  std::vector<RodNode> nodes;
  std::vector<RodFrame> frames;
  RodSteps steps;
  // A function that vanishes at the base, over the mass, is the sum of these times its values at
  // the nodes; one over I_t, about a diameter, at the frames. Zero beyond their number.
  std::array<double, max_rod_nodes> mass{};          // [kg]
  std::array<double, max_rod_frames + 1> inertia{};  // [kg m^2]; 2 I_t about the axis
  // At the frames.
  std::array<std::array<double, max_rod_frames + 1>, max_legendre_order + 1> legendre{},
      legendre_slope{};
};

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
/// of the coefficients u_j, by three Gauss points in between; those of j < i are zero.
template <class Real>
[[nodiscard]] std::array<LegendreValues, 3> step_of(Real from, Real to) {
  const Real h = to - from, centre = (from + to) / 2, root = std::sqrt(Real(15));
  const auto low = legendre(centre - h * root / 10), middle = legendre(centre),
             high = legendre(centre + h * root / 10);
  std::array<LegendreValues, 3> step{};
  for (std::size_t j = 0; j <= max_legendre_order; ++j) {
    step[0][j] = static_cast<double>(h * middle[j]);
    if (j > 0) step[1][j] = static_cast<double>(h * root / 3 * (high[j] - low[j]));
    if (j > 1) {
      step[2][j] = static_cast<double>(h * 10 / 3 * (high[j] - 2 * middle[j] + low[j]));
    }
  }
  return step;
}

}  // namespace cdcr::detail
