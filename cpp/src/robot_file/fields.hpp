#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "cdcr/robot.hpp"

namespace cdcr::robot_file {

template <typename T>
using Member = std::variant<double T::*, int T::*, std::optional<double> T::*,
                            std::optional<int> T::*, std::vector<double> T::*,
                            std::array<double, 2> T::*, std::vector<std::array<double, 2>> T::*,
                            Vector3d T::*, Matrix3d T::*, Transform T::*>;

/// One field of a description, as files call it.
template <typename T>
struct Field {
  const char* name;
  Member<T> member;
  /// What a robot file must give, with its unit: "[rad]" makes it an angle, which may be in degrees
  /// under NAME_deg. Null where robot files write it otherwise: as one of the pair of a taper, as
  /// the pairs of a cable that winds.
  const char* requirement = nullptr;
  bool required = false;
};

inline const std::vector<Field<Section>>& section_fields() {
  static constexpr const char* order = "a whole number 0 to 4, or \"locked\"";
  static const std::vector<Field<Section>> fields = {
      {"length", &Section::length, "a number > 0 m and finite", true},
      {"backbone_mass", &Section::backbone_mass, "a number >= 0 kg and finite", true},
      {"backbone_diameter", &Section::backbone_diameter,
       "a number > 0 m and finite, or one [base, tip] pair", true},
      {"youngs_modulus", &Section::youngs_modulus, "a number > 0 Pa and finite", true},
      {"disk_mass", &Section::disk_mass, "a number >= 0 kg and finite"},
      {"disk_diameter", &Section::disk_diameter, "a number >= 0 m and finite"},
      {"num_disks", &Section::num_disks, "a whole number 0 to 64"},
      {"disk_positions", &Section::disk_positions, "an array of 0 to 64 numbers 0 to 1"},
      {"disk_masses", &Section::disk_masses, "an array of 0 to 64 numbers [kg]"},
      {"disk_diameters", &Section::disk_diameters, "an array of 0 to 64 numbers [m]"},
      {"cable_radius", &Section::cable_radius, "a number > 0 m and finite"},
      {"cable_angles", &Section::cable_angles, "an array of 0 to 16 numbers [rad]"},
      {"cable_stiffness", &Section::cable_stiffness, "a number >= 0 N/m and finite"},
      {"cable_damping", &Section::cable_damping, "a number >= 0 N s/m and finite"},
      {"cable_friction", &Section::cable_friction, "a number >= 0 and finite"},
      {"damping", &Section::damping, "a number >= 0 N m s/rad and finite"},
      {"bending_order", &Section::bending_order, order},
      {"twist_order", &Section::twist_order, order},
      {"stretch_order", &Section::stretch_order, order},
      {"backbone_tip_diameter", &Section::backbone_tip_diameter},
      {"backbone_inner_diameter", &Section::backbone_inner_diameter, "a number >= 0 m and finite"},
      {"shear_modulus", &Section::shear_modulus, "a number > 0 Pa and finite"},
      {"bending_stiffness", &Section::bending_stiffness, "a number > 0 N m^2 and finite"},
      {"twist_stiffness", &Section::twist_stiffness, "a number > 0 N m^2 and finite"},
      {"stretch_stiffness", &Section::stretch_stiffness, "a number > 0 N and finite"},
      {"twist_damping", &Section::twist_damping, "a number >= 0 N m s/rad and finite"},
      {"stretch_damping", &Section::stretch_damping, "a number >= 0 N s/m and finite"},
      {"material_damping", &Section::material_damping, "a number >= 0 s and finite"},
      {"rest_bending", &Section::rest_bending, "an array of 2 numbers [rad]"},
      {"rest_twist", &Section::rest_twist, "a finite number [rad]"},
      {"nodes", &Section::nodes, "a whole number 3 to 32"},
      {"cable_entry_friction", &Section::cable_entry_friction, "a number >= 0 N and finite"},
      {"cable_sheath_friction", &Section::cable_sheath_friction, "a number >= 0 and finite"},
      {"cable_viscosity", &Section::cable_viscosity, "a number >= 0 N s/m and finite"},
      {"cable_pretension", &Section::cable_pretension, "a number >= 0 N and finite"},
      {"cable_backlash", &Section::cable_backlash, "a number >= 0 m and finite"},
  };
  return fields;
}

inline const std::vector<Field<Cable>>& cable_fields() {
  static constexpr const char* number = "the number of a section, from 1";
  static const std::vector<Field<Cable>> fields = {
      {"radius", &Cable::radius, "a number [m], or one [base, tip] pair for each section passed",
       true},
      {"angle", &Cable::angle, "a number [rad], or one [base, tip] pair for each section passed",
       true},
      {"end_section", &Cable::end_section, number, true},
      {"stiffness", &Cable::stiffness, "a number >= 0 N/m and finite"},
      {"damping", &Cable::damping, "a number >= 0 N s/m and finite"},
      {"friction", &Cable::friction, "a number >= 0 and finite"},
      {"start_section", &Cable::start_section, number},
      {"entry_friction", &Cable::entry_friction, "a number >= 0 N and finite"},
      {"sheath_friction", &Cable::sheath_friction, "a number >= 0 and finite"},
      {"viscosity", &Cable::viscosity, "a number >= 0 N s/m and finite"},
      {"pretension", &Cable::pretension, "a number >= 0 N and finite"},
      {"backlash", &Cable::backlash, "a number >= 0 m and finite"},
      {"radii", &Cable::radii},
      {"angles", &Cable::angles},
  };
  return fields;
}

inline const std::vector<Field<Robot>>& robot_fields() {
  static const std::vector<Field<Robot>> fields = {
      {"gravity", &Robot::gravity, "an array of 3 numbers [m/s^2]"},
      {"payload", &Robot::payload, "a number >= 0 kg and finite"},
      {"base_orientation", &Robot::base_orientation, "an array of 3 rows of 3 numbers"},
      {"base_position", &Robot::base_position, "an array of 3 numbers [m]"},
      {"payload_position", &Robot::payload_position, "an array of 3 numbers [m]"},
      {"payload_inertia", &Robot::payload_inertia, "an array of 3 rows of 3 numbers [kg m^2]"},
      {"sliding_speed", &Robot::sliding_speed, "a number > 0 m/s and finite"},
      {"tool", &Robot::tool, "an array of 4 rows of 4 numbers"},
      {"presliding_stiffness", &Robot::presliding_stiffness, "a number >= 0 N/m and finite"},
  };
  return fields;
}

}  // namespace cdcr::robot_file
