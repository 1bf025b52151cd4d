#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "base/rotation.hpp"
#include "cdcr/robot.hpp"
#include "description/check.hpp"

namespace cdcr {
namespace {

using detail::Check, detail::indexed;

constexpr int max_disks = 64;
constexpr int max_section_cables = 16;
constexpr int max_cables = 64;
// Of an inertia, relative to its largest entry.
constexpr double tolerance = 1e-9;

Eigen::IOFormat rows() {
  return {12, Eigen::DontAlignCols, ", ", ", ", "[", "]", "[", "]"};
}
Eigen::IOFormat row() {
  return {12, Eigen::DontAlignCols, ", ", ", ", "", "", "[", "]"};
}

/// The disks of a section; `in` is "section 1: " or empty, as below.
void check_disks(const Section& s, const std::string& in, Check& check) {
  check.not_negative(in + "disk_mass", s.disk_mass, "kg");
  check.not_negative(in + "disk_diameter", s.disk_diameter, "m");
  check.count(in + "num_disks", s.num_disks, 0, max_disks);
  const auto num_positions = static_cast<long long>(s.disk_positions.size());
  check.count(in + "the number of disk_positions", num_positions, 0, max_disks);
  if (num_positions > 0 && s.num_disks != 0 && s.num_disks != num_positions) {
    check.refuse(in + "num_disks",
                 "0 or the number of disk_positions, " + std::to_string(num_positions),
                 s.num_disks);
  }
  const long long num_disks = num_positions > 0 ? num_positions : s.num_disks;
  const auto one_each = [&](const char* name, std::size_t size) {
    if (size != 0 && static_cast<long long>(size) != num_disks) {
      check.refuse(in + "the number of " + name,
                   "0 or the number of disks, " + std::to_string(num_disks), size);
    }
  };
  one_each("disk_masses", s.disk_masses.size());
  one_each("disk_diameters", s.disk_diameters.size());
  for (std::size_t k = 0; k < s.disk_positions.size(); ++k) {
    check.fraction(indexed(in + "disk_positions", k), s.disk_positions[k]);
  }
  for (std::size_t k = 0; k < s.disk_masses.size(); ++k) {
    check.not_negative(indexed(in + "disk_masses", k), s.disk_masses[k], "kg");
  }
  for (std::size_t k = 0; k < s.disk_diameters.size(); ++k) {
    check.not_negative(indexed(in + "disk_diameters", k), s.disk_diameters[k], "m");
  }
}

/// What a cable loses on its way, and its drive; only one by length has pretension and play.
void check_drive(const std::string& in, const Cable& c, Check& check) {
  check.not_negative(in + "stiffness", c.stiffness, "N/m");
  check.not_negative(in + "damping", c.damping, "N s/m");
  check.not_negative(in + "entry_friction", c.entry_friction, "N");
  check.not_negative(in + "sheath_friction", c.sheath_friction, "");
  check.not_negative(in + "viscosity", c.viscosity, "N s/m");
  check.not_negative(in + "pretension", c.pretension, "N");
  check.not_negative(in + "backlash", c.backlash, "m");
  if (c.length_driven()) return;
  const char* otherwise = " where the stiffness is 0, driven by tension";
  const auto zero = [&](const char* name, double value, const std::string& none) {
    if (value > 0.0) check.refuse(in + name, none + otherwise, value);
  };
  zero("pretension", c.pretension, "0 N");
  zero("backlash", c.backlash, "0 m");
}

void check_section_cables(const Section& s, const std::string& in, Check& check) {
  const auto num_cables = static_cast<long long>(s.cable_angles.size());
  check.count(in + "the number of cable_angles", num_cables, 0, max_section_cables);
  if (num_cables > 0) {
    check.positive(in + "cable_radius", s.cable_radius, "m");
  } else {
    check.not_negative(in + "cable_radius", s.cable_radius, "m");
  }
  for (std::size_t j = 0; j < s.cable_angles.size(); ++j) {
    check.finite(indexed(in + "cable_angles", j), s.cable_angles[j], "rad");
  }
  check.not_negative(in + "cable_friction", s.cable_friction, "");
  const Cable cable{1.0,
                    0.0,
                    0,
                    s.cable_stiffness,
                    s.cable_damping,
                    {},
                    0,
                    {},
                    {},
                    s.cable_entry_friction,
                    s.cable_sheath_friction,
                    s.cable_viscosity,
                    s.cable_pretension,
                    s.cable_backlash};
  check_drive(in + "cable_", cable, check);
}

void check_order(const std::string& item, int order, Check& check) {
  if (order >= locked && order <= max_order) return;
  check.refuse(item, "0 to " + std::to_string(max_order) + ", or None to lock it", order);
}

/// The strains of a section: orders, stiffnesses, dampings, and its shape at rest.
void check_strains(const Section& s, const std::string& in, Check& check) {
  check_order(in + "bending_order", s.bending_order, check);
  check_order(in + "twist_order", s.twist_order, check);
  check_order(in + "stretch_order", s.stretch_order, check);
  if (s.shear_modulus) check.positive(in + "shear_modulus", *s.shear_modulus, "Pa");
  if (s.twist_order != locked && !s.shear_modulus && !s.twist_stiffness) {
    check.found.push_back(in +
                          "a section that twists must have a shear_modulus [Pa] or a "
                          "twist_stiffness [N m^2]");
  }
  if (s.bending_stiffness) {
    check.positive(in + "bending_stiffness", *s.bending_stiffness, "N m^2");
  }
  if (s.twist_stiffness) check.positive(in + "twist_stiffness", *s.twist_stiffness, "N m^2");
  if (s.stretch_stiffness) check.positive(in + "stretch_stiffness", *s.stretch_stiffness, "N");
  check.not_negative(in + "damping", s.damping, "N m s/rad");
  check.not_negative(in + "twist_damping", s.twist_damping, "N m s/rad");
  check.not_negative(in + "stretch_damping", s.stretch_damping, "N s/m");
  check.not_negative(in + "material_damping", s.material_damping, "s");
  for (std::size_t k = 0; k < 2; ++k) {
    check.finite(indexed(in + "rest_bending", k), s.rest_bending[k], "rad");
  }
  check.finite(in + "rest_twist", s.rest_twist, "rad");
  const double turning = std::hypot(s.rest_bending[0], s.rest_bending[1], s.rest_twist);
  if (turning > max_bending) {
    check.refuse(in + "rest_bending and rest_twist", "together at most 3 pi rad", turning);
  }
  if (s.nodes) check.count(in + "nodes", *s.nodes, min_nodes, max_nodes);
}

void check_backbone(const Section& s, const std::string& in, Check& check) {
  check.positive(in + "length", s.length, "m");
  check.not_negative(in + "backbone_mass", s.backbone_mass, "kg");
  check.positive(in + "backbone_diameter", s.backbone_diameter, "m");
  double least = s.backbone_diameter;
  if (s.backbone_tip_diameter) {
    check.positive(in + "backbone_diameter at the tip", *s.backbone_tip_diameter, "m");
    least = std::fmin(least, *s.backbone_tip_diameter);
  }
  check.not_negative(in + "backbone_inner_diameter", s.backbone_inner_diameter, "m");
  if (least > 0.0 && s.backbone_inner_diameter >= least && std::isfinite(least)) {
    std::ostringstream wanted;
    wanted.precision(12);
    wanted << "below the outer diameter, " << least << " m";
    check.refuse(in + "backbone_inner_diameter", wanted.str(), s.backbone_inner_diameter);
  }
  check.positive(in + "youngs_modulus", s.youngs_modulus, "Pa");
}

void check_section(const Section& s, const std::string& in, Check& check) {
  check_backbone(s, in, check);
  check_disks(s, in, check);
  check_section_cables(s, in, check);
  check_strains(s, in, check);
}

/// Values at the base and the tip of each section that a cable passes.
template <class CheckOne>
void check_pairs(const std::string& in, const std::string& name,
                 const std::vector<std::array<double, 2>>& pairs, long long num_passed,
                 Check& check, const CheckOne& check_one) {
  const auto count = static_cast<long long>(pairs.size());
  if (count != 0 && num_passed > 0 && count != num_passed) {
    check.refuse(in + "the number of (base, tip) pairs of " + name,
                 std::to_string(num_passed) + ", one for each section passed", count);
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    for (std::size_t end = 0; end < 2; ++end) {
      check_one(indexed(indexed(in + name, k), end), pairs[k][end]);
    }
  }
}

/// `last` is the index of the robot's last section, negative for a robot without any.
void check_cable(const Cable& cable, const std::string& in, long long last, Check& check) {
  if (last >= 0) {
    check.count(in + "end_section", cable.end_section, 0, last);
    if (cable.end_section >= 0 && cable.end_section <= last) {
      check.count(in + "start_section", cable.start_section, 0, cable.end_section);
    }
  }
  const long long num_passed = cable.end_section - cable.start_section + 1LL;
  const auto radius = [&](const std::string& item, double value) {
    check.positive(item, value, "m");
  };
  const auto angle = [&](const std::string& item, double value) {
    check.finite(item, value, "rad");
  };
  if (cable.radii.empty()) radius(in + "radius", cable.radius);
  if (cable.angles.empty()) angle(in + "angle", cable.angle);
  check_pairs(in, "radius", cable.radii, num_passed, check, radius);
  check_pairs(in, "angle", cable.angles, num_passed, check, angle);
  if (cable.friction) check.not_negative(in + "friction", *cable.friction, "");
  check_drive(in, cable, check);
}

void check_vector(const std::string& item, const Vector3d& v, const char* unit, Check& check) {
  for (Index k = 0; k < 3; ++k) check.finite(indexed(item, k), v[k], unit);
}

/// Whether all entries are finite; each that is not has its sentence.
template <class Matrix>
bool check_matrix(const std::string& item, const Matrix& m, const char* unit, Check& check) {
  for (Index i = 0; i < m.rows(); ++i) {
    for (Index k = 0; k < m.cols(); ++k) check.finite(indexed(indexed(item, i), k), m(i, k), unit);
  }
  return m.allFinite();
}

bool is_rotation(const Matrix3d& R) {
  return detail::skew_of(R) <= detail::rotation_digits && R.determinant() > 0.0;
}

void check_base_orientation(const Matrix3d& R, Check& check) {
  if (!check_matrix("base_orientation", R, "", check) || is_rotation(R)) return;
  check.refuse("base_orientation", "a right-handed rotation matrix, to 1e-5", R.format(rows()));
}

void check_tool(const Transform& tool, Check& check) {
  if (!check_matrix("tool", tool, "", check)) return;
  const bool ends = tool.row(3) == Eigen::RowVector4d::UnitW();
  if (ends && is_rotation(tool.topLeftCorner<3, 3>())) return;
  check.refuse("tool",
               "a frame: a right-handed rotation matrix, to 1e-5, with a position beside it and "
               "0, 0, 0, 1 below",
               tool.format(rows()));
}

void check_payload_inertia(const Matrix3d& inertia, Check& check) {
  if (!check_matrix("payload_inertia", inertia, "kg m^2", check)) return;
  const double largest = inertia.cwiseAbs().maxCoeff();
  if (largest < std::numeric_limits<double>::min()) return;  // too few digits to judge
  const Matrix3d relative = inertia / largest;
  if ((relative - relative.transpose()).cwiseAbs().maxCoeff() > tolerance) {
    check.refuse("payload_inertia", "symmetric, to 1e-9 of its largest entry",
                 inertia.format(rows()));
    return;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(relative, Eigen::EigenvaluesOnly);
  const Vector3d& moments = solver.eigenvalues();  // increasing
  if (moments[0] < -tolerance || moments[2] > moments[0] + moments[1] + tolerance) {
    check.refuse("payload_inertia",
                 "that of a body: principal moments >= 0, none above the sum of the others",
                 Vector3d(largest * moments).transpose().format(row()));
  }
}

void check_payload(const Robot& robot, Check& check) {
  check.not_negative("payload", robot.payload, "kg");
  check_vector("payload_position", robot.payload_position, "m", check);
  check_payload_inertia(robot.payload_inertia, check);
  if (robot.payload != 0.0) return;
  if (robot.payload_position.allFinite() && !robot.payload_position.isZero(0.0)) {
    check.refuse("payload_position", "zero where the payload is zero",
                 robot.payload_position.transpose().format(row()));
  }
  if (robot.payload_inertia.allFinite() && !robot.payload_inertia.isZero(0.0)) {
    check.refuse("payload_inertia", "zero where the payload is zero",
                 robot.payload_inertia.format(rows()));
  }
}

}  // namespace

std::vector<std::string> violations(const Section& section) {
  Check check;
  check_section(section, "", check);
  return check.found;
}

std::vector<std::string> violations(const Robot& robot) {
  Check check;
  const auto num_sections = static_cast<long long>(robot.sections.size());
  check.count("the number of sections", num_sections, 1, max_sections);
  for (std::size_t i = 0; i < robot.sections.size(); ++i) {
    check_section(robot.sections[i], "section " + std::to_string(i + 1) + ": ", check);
  }
  bool rigid = num_sections > 0;
  for (const Section& s : robot.sections) {
    rigid =
        rigid && s.bending_order == locked && s.twist_order == locked && s.stretch_order == locked;
  }
  if (rigid) {
    check.found.emplace_back(
        "a robot must bend, twist or stretch somewhere: all strains of all sections are locked");
  }
  check.count("the number of cables", static_cast<long long>(robot.cables.size()), 0, max_cables);
  for (std::size_t j = 0; j < robot.cables.size(); ++j) {
    check_cable(robot.cables[j],
                "cable " + std::to_string(j + 1) + " of cables: ", num_sections - 1, check);
  }
  check_vector("gravity", robot.gravity, "m/s^2", check);
  check_payload(robot, check);
  check_base_orientation(robot.base_orientation, check);
  check_vector("base_position", robot.base_position, "m", check);
  check_tool(robot.tool, check);
  check.positive("sliding_speed", robot.sliding_speed, "m/s");
  check.not_negative("presliding_stiffness", robot.presliding_stiffness, "N/m");
  return check.found;
}

void validate(const Robot& robot) {
  std::string text;
  for (const std::string& sentence : violations(robot)) {
    text += (text.empty() ? "" : "\n") + sentence;
  }
  if (!text.empty()) throw std::invalid_argument(text);
}

}  // namespace cdcr
