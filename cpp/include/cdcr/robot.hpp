#pragma once

#include <string>
#include <vector>

#include "cdcr/types.hpp"

namespace cdcr {

/// One constant-curvature section: a backbone, equally spaced disks, and the cables that end
/// at its last disk. Disk k of N sits at fraction k/N of the length.
struct Section {
  double length = 0.0;               ///< arc length of the backbone [m], > 0
  double backbone_mass = 0.0;        ///< spread evenly along the length [kg], >= 0
  double backbone_diameter = 0.0;    ///< [m], > 0
  double youngs_modulus = 0.0;       ///< [Pa], > 0
  double disk_mass = 0.0;            ///< of each disk [kg], >= 0
  double disk_diameter = 0.0;        ///< [m], >= 0
  int num_disks = 0;                 ///< 0 to 64
  double cable_radius = 0.0;         ///< from backbone to cable [m], > 0 where there are cables
  std::vector<double> cable_angles;  ///< gamma_j about Z from X [rad], 0 to 16 of them
  double damping = 0.0;              ///< viscous, per bending component [N m s/rad], >= 0

  /// Bending stiffness K = E I / length [N m/rad], paper eq. (23).
  [[nodiscard]] double stiffness() const noexcept;
};

/// Sections from base to tip, and what acts on all of them.
struct Robot {
  std::vector<Section> sections;        ///< 1 to 32
  Vector3d gravity = Vector3d::Zero();  ///< in the base frame [m/s^2]
  double payload = 0.0;                 ///< point mass at the tip [kg], >= 0
};

/// One sentence for each field that is out of its range, empty when all is sound. A robot's
/// sentences name the section: "sections[0].length must be > 0 m and finite, got -1".
[[nodiscard]] std::vector<std::string> violations(const Section& section);
[[nodiscard]] std::vector<std::string> violations(const Robot& robot);

/// Throws std::invalid_argument with all sentences of violations(), one a line.
void validate(const Robot& robot);

/// Table 1 of Amouri, Mahfoudi, Zaatri (2020): one section, ten disks, three cables, no gravity.
[[nodiscard]] Robot amouri2020();

}  // namespace cdcr
