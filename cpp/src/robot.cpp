#include "cdcr/robot.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace cdcr {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int max_disks = 64;
constexpr int max_cables = 16;

/// Collects sentences of the form "sections[0].length must be > 0 m and finite, got -1".
class Check {
 public:
  void positive(const std::string& item, double value, const char* unit) {
    if (!(value > 0.0) || !std::isfinite(value)) add(item, "> 0", unit, value);
  }
  void not_negative(const std::string& item, double value, const char* unit) {
    if (!(value >= 0.0) || !std::isfinite(value)) add(item, ">= 0", unit, value);
  }
  void finite(const std::string& item, double value, const char* unit) {
    if (!std::isfinite(value)) {
      std::ostringstream text;
      text << item << " must be a finite number of " << unit << ", got " << value;
      found.push_back(text.str());
    }
  }
  void count(const std::string& item, long long value, long long low, long long high) {
    if (value < low || value > high) {
      std::ostringstream text;
      text << item << " must be " << low << " to " << high << ", got " << value;
      found.push_back(text.str());
    }
  }

  std::vector<std::string> found;

 private:
  void add(const std::string& item, const char* range, const char* unit, double value) {
    std::ostringstream text;
    text.precision(12);
    text << item << " must be " << range << ' ' << unit << " and finite, got " << value;
    found.push_back(text.str());
  }
};

/// `in` is "sections[0]." or empty.
void check_section(const Section& s, const std::string& in, Check& check) {
  check.positive(in + "length", s.length, "m");
  check.not_negative(in + "backbone_mass", s.backbone_mass, "kg");
  check.positive(in + "backbone_diameter", s.backbone_diameter, "m");
  check.positive(in + "youngs_modulus", s.youngs_modulus, "Pa");
  check.not_negative(in + "disk_mass", s.disk_mass, "kg");
  check.not_negative(in + "disk_diameter", s.disk_diameter, "m");
  check.count(in + "num_disks", s.num_disks, 0, max_disks);
  const auto num_cables = static_cast<long long>(s.cable_angles.size());
  check.count("the number of " + in + "cable_angles", num_cables, 0, max_cables);
  if (num_cables > 0) {
    check.positive(in + "cable_radius", s.cable_radius, "m");
  } else {
    check.not_negative(in + "cable_radius", s.cable_radius, "m");
  }
  for (std::size_t j = 0; j < s.cable_angles.size(); ++j) {
    check.finite(in + "cable_angles[" + std::to_string(j) + "]", s.cable_angles[j], "rad");
  }
  check.not_negative(in + "damping", s.damping, "N m s/rad");
}

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
      all.push_back({s.cable_radius, angle, static_cast<int>(i), s.cable_stiffness,
                     s.cable_damping, std::nullopt});
    }
  }
  all.insert(all.end(), cables.begin(), cables.end());
  return all;
}

std::vector<std::string> violations(const Section& section) {
  Check check;
  check_section(section, "", check);
  return check.found;
}

std::vector<std::string> violations(const Robot& robot) {
  Check check;
  check.count("the number of sections", static_cast<long long>(robot.sections.size()), 1,
              max_sections);
  for (std::size_t i = 0; i < robot.sections.size(); ++i) {
    check_section(robot.sections[i], "sections[" + std::to_string(i) + "].", check);
  }
  for (int k = 0; k < 3; ++k) {
    check.finite("gravity[" + std::to_string(k) + "]", robot.gravity[k], "m/s^2");
  }
  check.not_negative("payload", robot.payload, "kg");
  return check.found;
}

void validate(const Robot& robot) {
  std::string text;
  for (const std::string& sentence : violations(robot)) {
    text += (text.empty() ? "" : "\n") + sentence;
  }
  if (!text.empty()) throw std::invalid_argument(text);
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
