#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// Largest number of sections of a robot.
inline constexpr Index max_sections = 32;
/// Largest order of a strain of a section.
inline constexpr int max_order = 4;
/// Of all sections together: bending (x, y), twist and stretch of all orders.
inline constexpr Index max_coordinates = max_sections * 4 * (max_order + 1);
/// Places along a section where its mass may be summed up.
inline constexpr int min_nodes = 3, max_nodes = 32;
/// Order of a strain that is locked.
inline constexpr int locked = -1;

/// A thin rigid disk, centred on the backbone and square to it.
struct Disk {
  double position = 0.0;  ///< fraction of the section's length, 0 to 1
  double mass = 0.0;      ///< [kg]
  double diameter = 0.0;  ///< [m]
};

/// One section: a backbone, its disks, and the cables that end at its end.
///
/// By default it bends with constant curvature and neither twists nor stretches. The order of a
/// strain is that of its Legendre polynomials along the section (cpp/rods.md eq. (51)); `locked`
/// leaves it as it is at rest.
///
/// Without disk_positions, disk k of num_disks sits at fraction k/num_disks of the length. The
/// cables at cable_angles all have the section's cable_radius, cable_stiffness and cable_damping,
/// and run through all sections before; Robot::cables takes what does not fit that.
struct Section {
  double length = 0.0;                 ///< arc length of the backbone [m], > 0
  double backbone_mass = 0.0;          ///< spread evenly along the length [kg], >= 0
  double backbone_diameter = 0.0;      ///< at the base [m], > 0
  double youngs_modulus = 0.0;         ///< [Pa], > 0
  double disk_mass = 0.0;              ///< of each disk [kg], >= 0
  double disk_diameter = 0.0;          ///< [m], >= 0
  int num_disks = 0;                   ///< 0 to 64
  double cable_radius = 0.0;           ///< from backbone to cable [m], > 0 where there are cables
  std::vector<double> cable_angles;    ///< gamma_j about Z from X [rad], 0 to 16 of them
  double damping = 0.0;                ///< viscous, of each bending component [N m s/rad], >= 0
  std::vector<double> disk_positions;  ///< fractions of the length; empty: equally spaced disks
  std::vector<double> disk_masses;     ///< one for each disk [kg]; empty: disk_mass for all
  std::vector<double> disk_diameters;  ///< one for each disk [m]; empty: disk_diameter for all
  double cable_stiffness = 0.0;        ///< see Cable::stiffness [N/m], >= 0
  double cable_damping = 0.0;          ///< see Cable::damping [N s/m], >= 0
  double cable_friction = 0.0;  ///< Coulomb's coefficient mu in this section's cable holes, >= 0
  double cable_entry_friction = 0.0;   ///< see Cable::entry_friction [N], >= 0
  double cable_sheath_friction = 0.0;  ///< see Cable::sheath_friction, >= 0
  double cable_viscosity = 0.0;        ///< see Cable::viscosity [N s/m], >= 0
  double cable_pretension = 0.0;       ///< see Cable::pretension [N], >= 0
  double cable_backlash = 0.0;         ///< see Cable::backlash [m], >= 0

  int bending_order = 0;                        ///< 0 to max_order, or locked
  int twist_order = locked;                     ///< likewise
  int stretch_order = locked;                   ///< likewise
  std::optional<double> backbone_tip_diameter;  ///< of a linear taper [m], > 0; else the base's
  double backbone_inner_diameter = 0.0;         ///< of a tube [m], >= 0
  std::optional<double> shear_modulus;          ///< [Pa], > 0; wanted where it twists
  std::optional<double> bending_stiffness;      ///< E I [N m^2], in place of the material's
  std::optional<double> twist_stiffness;        ///< G J [N m^2]
  std::optional<double> stretch_stiffness;      ///< E A [N]
  double twist_damping = 0.0;                   ///< viscous [N m s/rad], >= 0
  double stretch_damping = 0.0;                 ///< viscous [N s/m], >= 0
  double material_damping = 0.0;  ///< Kelvin-Voigt's time: this times the stiffness is damping [s]
  std::array<double, 2> rest_bending{0.0, 0.0};  ///< bending vector of the unloaded backbone [rad]
  double rest_twist = 0.0;                       ///< twist of the unloaded backbone [rad]
  std::optional<int> nodes;  ///< where its mass is summed up, 3 to 32; else enough for about 1e-8

  /// Bending stiffness K = E I / length [N m/rad], paper eq. (23), the mean of a taper.
  [[nodiscard]] double stiffness() const noexcept;
  /// Whether it is more than an arc: its strains or its diameter vary, it twists, stretches, is
  /// bent at rest or rigid, or its nodes are given (cpp/rods.md).
  [[nodiscard]] bool is_rod() const noexcept;
  /// The disks, base to tip in the order given.
  [[nodiscard]] std::vector<Disk> disks() const;
};

/// How a cable runs through a section: radius and angle change evenly from its base to its tip.
struct CableRoute {
  double base_radius, tip_radius;  ///< [m]
  double base_angle, tip_angle;    ///< about Z from X [rad]
};

/// One cable, from the base of its first section through the holes of all sections up to the end
/// of the one it ends on.
///
/// It runs straight at `radius` and `angle`. With `radii` and `angles` it converges or winds: in
/// each section passed both change evenly with the length from the base's to the tip's.
/// A cable with a stiffness is driven by length: a spring of that stiffness, in parallel with the
/// damping, between the cable and its drive, which pulls and never pushes. One without is driven by
/// tension.
struct Cable {
  double radius = 0.0;             ///< from the backbone [m], > 0
  double angle = 0.0;              ///< gamma about Z from X [rad]
  int end_section = 0;             ///< index of the section whose end disk holds it
  double stiffness = 0.0;          ///< of the cable and its drive [N/m]; 0: driven by tension
  double damping = 0.0;            ///< along with the stiffness [N s/m], >= 0
  std::optional<double> friction;  ///< mu in all its holes, in place of Section::cable_friction
  int start_section = 0;           ///< index of the section at whose base it begins
  /// (base, tip) in each section passed, in place of `radius` [m] and `angle` [rad]; or empty.
  // NOLINTNEXTLINE(readability-redundant-member-init): cables may be listed without them
  std::vector<std::array<double, 2>> radii{}, angles{};
  double entry_friction = 0.0;   ///< Coulomb's, at the entry into the robot [N], >= 0
  double sheath_friction = 0.0;  ///< mu of a sheath before the entry times its turning, >= 0
  double viscosity = 0.0;        ///< viscous friction at the entry [N s/m], >= 0
  double pretension = 0.0;       ///< pull at the length commanded, where driven by length [N], >= 0
  double backlash = 0.0;         ///< play of the drive, where driven by length [m], >= 0

  /// How it runs through a section that it passes.
  [[nodiscard]] CableRoute route(int section) const noexcept;
  /// Whether radius and angle are the same all along.
  [[nodiscard]] bool straight() const noexcept;
  [[nodiscard]] bool length_driven() const noexcept { return stiffness > 0.0; }
};

/// A place on the backbone.
struct Place {
  Index section = 0;
  double fraction = 0.0;  ///< of the section's length, 0 to 1
};

/// Sections from base to tip, and what acts on all of them.
///
/// The base frame is fixed. The first section begins at its origin and the straight robot points
/// along its Z, or at base_position along the third column of base_orientation.
struct Robot {
  std::vector<Section> sections;        ///< 1 to 32
  Vector3d gravity = Vector3d::Zero();  ///< in the base frame [m/s^2]
  double payload = 0.0;                 ///< mass carried by the tip [kg], >= 0
  std::vector<Cable> cables;            ///< beside those of the sections, after them in order
  Matrix3d base_orientation =
      Matrix3d::Identity();                   ///< of the first section, in the base frame, to 1e-5
  Vector3d base_position = Vector3d::Zero();  ///< where it begins, in the base frame [m]
  Vector3d payload_position = Vector3d::Zero();  ///< its centre of mass, in the tip frame [m]
  Matrix3d payload_inertia = Matrix3d::Zero();   ///< about that, in the tip frame [kg m^2]
  double sliding_speed = 1e-3;  ///< cable speed that friction takes for sliding [m/s], > 0
  /// A frame without mass that the tip carries, in the frame at the end of the last section.
  Transform tool = Transform::Identity();
  /// Of a cable that sticks, against where it sticks [N/m], >= 0: friction then remembers, and
  /// sticks at rest. 0: the law of the sliding speed, without memory.
  double presliding_stiffness = 0.0;

  /// Every cable: section by section those at cable_angles, then `cables`.
  [[nodiscard]] std::vector<Cable> all_cables() const;
  /// Whether it is more than arcs with straight cables: a section is a rod, or a cable winds or
  /// converges.
  [[nodiscard]] bool has_rods() const noexcept;
  /// The place at an arc length from the base [m]; at a border the end of the section before it.
  /// Throws std::invalid_argument where it is not 0 to the length of the robot.
  [[nodiscard]] Place locate(double arc_length) const;
};

/// One sentence for each field that is out of its range, empty when all is sound. A robot's
/// sentences name the section: "sections[0].length must be > 0 m and finite, got -1".
[[nodiscard]] std::vector<std::string> violations(const Section& section);
[[nodiscard]] std::vector<std::string> violations(const Robot& robot);

/// Throws std::invalid_argument with all sentences of violations(), one a line.
void validate(const Robot& robot);

/// Table 1 of Amouri, Mahfoudi, Zaatri (2020): one section, ten disks, three cables, no gravity.
[[nodiscard]] Robot amouri2020();

}  // namespace CDCR_EXPORT cdcr
