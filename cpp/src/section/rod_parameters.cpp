#include "section/rod_parameters.hpp"

#include <algorithm>

#include "base/constants.hpp"

namespace cdcr::detail {
namespace {

/// Adds (1/l) int k(x) P_i P_j dx to the stiffness, the coefficients `stride` coordinates apart.
template <class Rigidity>
void add_stiffness(MatrixXd& stiffness, int first, int stride, int count, const Rigidity& k) {
  for (const auto& [x, weight] : gauss_legendre()) {
    const auto P = legendre(x);
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) {
        stiffness(first + stride * i, first + stride * j) +=
            static_cast<double>(weight * P[i] * P[j] * k(x));
      }
    }
  }
}

/// For accelerations to about 1e-8.
int nodes_needed(const RodDescription& rod) {
  return 6 + std::max({1, rod.bending_order, rod.twist_order, rod.stretch_order});
}

}  // namespace

RodParameters::RodParameters(const RodDescription& rod)
    : num_bending(rod.bending_order + 1),
      num_twist(rod.twist_order + 1),
      num_stretch(rod.stretch_order + 1),
      first_twist(2 * num_bending),
      first_stretch(first_twist + num_twist),
      length(rod.length),
      mass(rod.mass.backbone_mass),
      rule(rod.mass, rod.num_nodes > 0 ? rod.num_nodes : nodes_needed(rod)) {
  for (const Disk& disk : rod.mass.disks) mass += disk.mass;

  const long double inner = rod.mass.inner_diameter;
  const auto diameter = [&](long double x) {
    return rod.mass.base_diameter + x * (rod.mass.tip_diameter - rod.mass.base_diameter);
  };
  const auto second_moment = [&](long double x) {  // of area; the polar one is twice that
    const long double d = diameter(x);
    return pi / 64.0L * (d * d * d * d - inner * inner * inner * inner);
  };
  const auto bend = [&](long double x) { return rod.youngs_modulus / length * second_moment(x); };
  const auto turn = [&](long double x) {
    return 2.0L * rod.shear_modulus / length * second_moment(x);
  };
  const auto pull = [&](long double x) {
    const long double d = diameter(x);
    return rod.youngs_modulus / length * pi / 4.0L * (d * d - inner * inner);
  };
  stiffness = MatrixXd::Zero(size(), size());
  for (const int first : {0, 1}) add_stiffness(stiffness, first, 2, num_bending, bend);
  add_stiffness(stiffness, first_twist, 1, num_twist, turn);
  add_stiffness(stiffness, first_stretch, 1, num_stretch, pull);

  damping.resize(size());
  for (Index i = 0; i < num_bending; ++i) {
    damping.segment(2 * i, 2).setConstant(rod.damping / static_cast<double>(2 * i + 1));
  }
  for (int i = 0; i < num_twist; ++i) damping[first_twist + i] = rod.twist_damping / (2 * i + 1);
  for (int i = 0; i < num_stretch; ++i) {
    damping[first_stretch + i] = rod.stretch_damping / (2 * i + 1);
  }
}

}  // namespace cdcr::detail
