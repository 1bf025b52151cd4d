#include "cdcr/robot.hpp"

#include <cmath>
#include <limits>

#include "base/arguments.hpp"
#include "base/constants.hpp"

namespace cdcr {
namespace {

using detail::pi;

}  // namespace

double Section::stiffness() const noexcept {
  const double d2 = backbone_diameter * backbone_diameter;
  return youngs_modulus * (pi / 64.0) * d2 * d2 / length;
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
      all.push_back({s.cable_radius, angle, static_cast<int>(i), s.cable_stiffness, s.cable_damping,
                     std::nullopt});
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
