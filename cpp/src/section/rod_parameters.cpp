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

RodDescription described(const Section& s) {
  RodDescription rod;
  rod.length = s.length;
  rod.mass = {s.backbone_mass, s.backbone_diameter,
              s.backbone_tip_diameter.value_or(s.backbone_diameter), s.backbone_inner_diameter,
              s.disks()};
  rod.youngs_modulus = s.youngs_modulus;
  rod.shear_modulus = s.shear_modulus.value_or(0.0);
  rod.damping = s.damping;
  rod.twist_damping = s.twist_damping;
  rod.stretch_damping = s.stretch_damping;
  rod.bending_order = s.bending_order;
  rod.twist_order = s.twist_order;
  rod.stretch_order = s.stretch_order;
  rod.num_nodes = s.nodes.value_or(rod.num_nodes);
  rod.bending_stiffness = s.bending_stiffness;
  rod.twist_stiffness = s.twist_stiffness;
  rod.stretch_stiffness = s.stretch_stiffness;
  rod.material_damping = s.material_damping;
  rod.rest_bending = s.rest_bending;
  rod.rest_twist = s.rest_twist;
  return rod;
}

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

  for (int c = 0; c < size(); ++c) {
    const bool bends = c < first_twist, twists = !bends && c < first_stretch;
    strain_of[c] = bends ? (c % 2 == 0 ? bending_x : bending_y) : twists ? twisting : stretching;
    order_of[c] = bends ? c / 2 : c - (twists ? first_twist : first_stretch);
  }

  const long double inner = rod.mass.inner_diameter;
  const auto diameter = [&](long double x) {
    return rod.mass.base_diameter + x * (rod.mass.tip_diameter - rod.mass.base_diameter);
  };
  const auto second_moment = [&](long double x) {  // of area; the polar one is twice that
    const long double d = diameter(x);
    return pi / 64.0L * (d * d * d * d - inner * inner * inner * inner);
  };
  const auto bend = [&](long double x) {
    if (rod.bending_stiffness) return static_cast<long double>(*rod.bending_stiffness) / length;
    return rod.youngs_modulus / length * second_moment(x);
  };
  const auto turn = [&](long double x) {
    if (rod.twist_stiffness) return static_cast<long double>(*rod.twist_stiffness) / length;
    return 2.0L * rod.shear_modulus / length * second_moment(x);
  };
  const auto pull = [&](long double x) {
    if (rod.stretch_stiffness) return static_cast<long double>(*rod.stretch_stiffness) / length;
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
  material_damping = rod.material_damping;

  const auto [bent_x, bent_y] = rod.rest_bending;
  rest = VectorXd::Zero(size());
  locked_turning.setZero();
  if (num_bending > 0) {
    rest.head<2>() << bent_x, bent_y;
  } else {
    locked_turning << -bent_y, bent_x, 0.0;
  }
  (num_twist > 0 ? rest[first_twist] : locked_turning[2]) = rod.rest_twist;
}

}  // namespace cdcr::detail
