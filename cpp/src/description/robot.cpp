#include "cdcr/robot.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "base/arguments.hpp"
#include "base/constants.hpp"

namespace cdcr {
namespace {

using detail::pi;

}  // namespace

double Section::stiffness() const noexcept {
  if (bending_stiffness) return *bending_stiffness / length;
  const double inner = backbone_inner_diameter * backbone_inner_diameter;
  const double base = backbone_diameter, tip = backbone_tip_diameter.value_or(base);
  // Mean of d^4 over a taper; where there is none, d^2 squared as it stands.
  const double b2 = base * base, t2 = tip * tip;
  const double fourth =
      base == tip ? b2 * b2
                  : (b2 * b2 + b2 * base * tip + b2 * t2 + base * tip * t2 + t2 * t2) / 5.0;
  return youngs_modulus * (pi / 64.0) * (fourth - inner * inner) / length;
}

bool Section::is_rod() const noexcept {
  const bool tapers = backbone_tip_diameter.value_or(backbone_diameter) != backbone_diameter;
  const bool bent_at_rest = rest_bending[0] != 0.0 || rest_bending[1] != 0.0 || rest_twist != 0.0;
  return bending_order != 0 || twist_order != locked || stretch_order != locked || tapers ||
         bent_at_rest || nodes.has_value();
}

CableRoute Cable::route(int section) const noexcept {
  const auto k = static_cast<std::size_t>(section - start_section);
  CableRoute route{radius, radius, angle, angle};
  if (k < radii.size()) {
    route.base_radius = radii[k][0];
    route.tip_radius = radii[k][1];
  }
  if (k < angles.size()) {
    route.base_angle = angles[k][0];
    route.tip_angle = angles[k][1];
  }
  return route;
}

bool Cable::straight() const noexcept {
  const auto even = [](const std::vector<std::array<double, 2>>& pairs) {
    for (const auto& pair : pairs) {
      if (pair[0] != pairs[0][0] || pair[1] != pairs[0][0]) return false;
    }
    return true;
  };
  return even(radii) && even(angles);
}

bool Robot::has_rods() const noexcept {
  for (const Section& section : sections) {
    if (section.is_rod()) return true;
  }
  for (const Cable& cable : cables) {
    if (!cable.straight()) return true;
  }
  return false;
}

std::vector<Disk> Section::disks() const {
  const bool equal = disk_positions.empty();
  const auto count = equal ? static_cast<std::size_t>(num_disks) : disk_positions.size();
  std::vector<Disk> all;
  for (std::size_t k = 0; k < count; ++k) {
    const double spaced = static_cast<double>(k + 1) / static_cast<double>(count);
    all.push_back({equal ? spaced : disk_positions[k],
                   disk_masses.empty() ? disk_mass : disk_masses[k],
                   disk_diameters.empty() ? disk_diameter : disk_diameters[k]});
  }
  return all;
}

std::vector<Cable> Robot::all_cables() const {
  std::vector<Cable> all;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const Section& s = sections[i];
    for (const double angle : s.cable_angles) {
      Cable cable;
      cable.radius = s.cable_radius;
      cable.angle = angle;
      cable.end_section = static_cast<int>(i);
      cable.stiffness = s.cable_stiffness;
      cable.damping = s.cable_damping;
      cable.entry_friction = s.cable_entry_friction;
      cable.sheath_friction = s.cable_sheath_friction;
      cable.viscosity = s.cable_viscosity;
      cable.pretension = s.cable_pretension;
      cable.backlash = s.cable_backlash;
      all.push_back(std::move(cable));
    }
  }
  all.insert(all.end(), cables.begin(), cables.end());
  return all;
}

Place Robot::locate(double arc_length) const {
  double length = 0.0;
  for (const Section& section : sections) length += section.length;
  // Whoever adds up the lengths in another order misses this sum by rounding.
  const double rounding =
      length * std::numeric_limits<double>::epsilon() * static_cast<double>(sections.size());
  detail::require(!sections.empty() && arc_length >= 0.0 && arc_length <= length + rounding,
                  "s must be 0 to ", length, " m, the length of the robot, got ", arc_length);
  double begin = 0.0;
  for (Index i = 0;; ++i) {
    const double end = begin + sections[i].length;
    const bool is_last = i + 1 == static_cast<Index>(sections.size());
    if (arc_length < end) return {i, std::fmin((arc_length - begin) / sections[i].length, 1.0)};
    if (arc_length == end || is_last) return {i, 1.0};
    begin = end;
  }
}

Robot amouri2020() {
  Section section;
  section.length = 0.802;
  section.backbone_mass = 0.0326;
  section.backbone_diameter = 0.005;
  section.youngs_modulus = 9.5e9;
  section.disk_mass = 0.0082;
  section.disk_diameter = 0.04;
  section.num_disks = 10;
  section.cable_radius = 0.019;
  section.cable_angles = {0.0, 2.0 * pi / 3.0, 4.0 * pi / 3.0};
  Robot robot;
  robot.sections = {section};
  return robot;
}

}  // namespace cdcr
