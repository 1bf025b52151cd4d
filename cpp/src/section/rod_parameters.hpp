#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "section/rod_rule.hpp"

namespace cdcr::detail {

/// Largest number of coordinates of a rod: orders 4 of bending, twist and stretch.
inline constexpr int max_rod_coordinates = 4 * (max_legendre_order + 1);

/// What a coordinate changes.
enum StrainKind { bending_x, bending_y, twisting, stretching, num_strains };

/// A section whose bending, twist and stretch vary along it, cpp/rods.md eq. (51).
struct RodDescription {
  double length = 0.0;  // [m]
  RodMass mass;
  double youngs_modulus = 0.0, shear_modulus = 0.0;                  // [Pa]
  double damping = 0.0, twist_damping = 0.0, stretch_damping = 0.0;  // of strain rates
  int bending_order = 0, twist_order = -1, stretch_order = -1;       // -1: locked
  int num_nodes = 0;                                                 // 0: what its orders need
  // E I, G J [N m^2] and E A [N], in place of what material and shape give.
  std::optional<double> bending_stiffness, twist_stiffness, stretch_stiffness;
  double material_damping = 0.0;                 // Kelvin-Voigt's time [s]
  std::array<double, 2> rest_bending{0.0, 0.0};  // of the unloaded backbone [rad]
  double rest_twist = 0.0;
};

/// The same of a robot's section.
[[nodiscard]] RodDescription described(const Section& section);

/// What is fixed about a rod. Its coordinates are the Legendre coefficients of the bending vector
/// (x, y of each order), then of the twist, then of the stretch.
struct RodParameters {
  explicit RodParameters(const RodDescription& rod);

  [[nodiscard]] int size() const noexcept { return first_stretch + num_stretch; }
  [[nodiscard]] int num_nodes() const noexcept { return static_cast<int>(rule.nodes.size()); }
  /// But the base.
  [[nodiscard]] int num_frames() const noexcept { return static_cast<int>(rule.frames.size()) - 1; }

  int num_bending, num_twist, num_stretch;  // coefficients of each, two coordinates for one bending
  int first_twist, first_stretch;           // coordinates
  double length, mass;
  RodRule rule;
  MatrixXd stiffness;  // elastic energy (q - rest)^T stiffness (q - rest)/2
  VectorXd rest;
  VectorXd damping;
  double material_damping;  // this times the stiffness is damping too [s]
  Vector3d locked_turning;  // what a locked bending or twist adds to u
  std::array<StrainKind, max_rod_coordinates> strain_of{};  // of each coordinate
  std::array<int, max_rod_coordinates> order_of{};
};

}  // namespace cdcr::detail
