#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <variant>

#include "bind.hpp"
#include "cdcr/robot.hpp"
#include "docs.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

namespace {

using Doubles = std::vector<double>;

constexpr const char* fields_of_section = "**fields\n    Those of cdcr.Section, in its units.\n";
constexpr const char* fields_of_cable = "**fields\n    Those of cdcr.Cable, in its units.\n";
constexpr const char* fields_of_robot = "**fields\n    Those of cdcr.Robot, in its units.\n";
constexpr const char* sentences = "list of str\n    Empty when all is sound.";

/// A number, or one (base, tip) pair for each section passed.
using Pairs = std::vector<std::array<double, 2>>;
using Route = std::variant<double, Pairs>;

void read_route(const Route& given, double& even, Pairs& pairs) {
  if (const double* number = std::get_if<double>(&given)) {
    even = *number;
  } else {
    pairs = std::get<Pairs>(given);
  }
}

void bind_section(py::module_& m) {
  py::class_<Section>(m, "Section",
                      "One section as the core takes it, unchecked; see cdcr.Section.")
      .def(py::init(
               [](double length, double backbone_mass,
                  std::variant<double, std::array<double, 2>> backbone_diameter,
                  double youngs_modulus, double disk_mass, double disk_diameter, int num_disks,
                  Doubles disk_positions, Doubles disk_masses, Doubles disk_diameters,
                  double cable_radius, Doubles cable_angles, double cable_stiffness,
                  double cable_damping, double cable_friction, double damping,
                  std::optional<int> bending_order, std::optional<int> twist_order,
                  std::optional<int> stretch_order, double backbone_inner_diameter,
                  std::optional<double> shear_modulus, std::optional<double> bending_stiffness,
                  std::optional<double> twist_stiffness, std::optional<double> stretch_stiffness,
                  double twist_damping, double stretch_damping, double material_damping,
                  std::array<double, 2> rest_bending, double rest_twist, std::optional<int> nodes,
                  double cable_entry_friction, double cable_sheath_friction, double cable_viscosity,
                  double cable_pretension, double cable_backlash) {
                 Section s;
                 s.length = length;
                 s.backbone_mass = backbone_mass;
                 if (const auto* ends = std::get_if<1>(&backbone_diameter)) {
                   s.backbone_diameter = (*ends)[0];
                   s.backbone_tip_diameter = (*ends)[1];
                 } else {
                   s.backbone_diameter = std::get<0>(backbone_diameter);
                 }
                 s.youngs_modulus = youngs_modulus;
                 s.disk_mass = disk_mass;
                 s.disk_diameter = disk_diameter;
                 s.num_disks = num_disks;
                 s.disk_positions = std::move(disk_positions);
                 s.disk_masses = std::move(disk_masses);
                 s.disk_diameters = std::move(disk_diameters);
                 s.cable_radius = cable_radius;
                 s.cable_angles = std::move(cable_angles);
                 s.cable_stiffness = cable_stiffness;
                 s.cable_damping = cable_damping;
                 s.cable_friction = cable_friction;
                 s.damping = damping;
                 s.bending_order = bending_order.value_or(locked);
                 s.twist_order = twist_order.value_or(locked);
                 s.stretch_order = stretch_order.value_or(locked);
                 s.backbone_inner_diameter = backbone_inner_diameter;
                 s.shear_modulus = shear_modulus;
                 s.bending_stiffness = bending_stiffness;
                 s.twist_stiffness = twist_stiffness;
                 s.stretch_stiffness = stretch_stiffness;
                 s.twist_damping = twist_damping;
                 s.stretch_damping = stretch_damping;
                 s.material_damping = material_damping;
                 s.rest_bending = rest_bending;
                 s.rest_twist = rest_twist;
                 s.nodes = nodes;
                 s.cable_entry_friction = cable_entry_friction;
                 s.cable_sheath_friction = cable_sheath_friction;
                 s.cable_viscosity = cable_viscosity;
                 s.cable_pretension = cable_pretension;
                 s.cable_backlash = cable_backlash;
                 return s;
               }),
           py::kw_only(), "length"_a, "backbone_mass"_a, "backbone_diameter"_a, "youngs_modulus"_a,
           "disk_mass"_a, "disk_diameter"_a, "num_disks"_a, "disk_positions"_a, "disk_masses"_a,
           "disk_diameters"_a, "cable_radius"_a, "cable_angles"_a, "cable_stiffness"_a,
           "cable_damping"_a, "cable_friction"_a, "damping"_a, "bending_order"_a, "twist_order"_a,
           "stretch_order"_a, "backbone_inner_diameter"_a, "shear_modulus"_a, "bending_stiffness"_a,
           "twist_stiffness"_a, "stretch_stiffness"_a, "twist_damping"_a, "stretch_damping"_a,
           "material_damping"_a, "rest_bending"_a, "rest_twist"_a, "nodes"_a,
           "cable_entry_friction"_a, "cable_sheath_friction"_a, "cable_viscosity"_a,
           "cable_pretension"_a, "cable_backlash"_a, Doc("Take the fields.", {fields_of_section}))
      .def(
          "violations", [](const Section& section) { return violations(section); },
          Doc("One sentence for each field out of its range.", {}, sentences))
      .def(
          "disks",
          [](const Section& section) {
            py::list disks;
            for (const Disk& disk : section.disks()) {
              disks.append(py::make_tuple(disk.position, disk.mass, disk.diameter));
            }
            return disks;
          },
          Doc("The disks, base to tip in the order given.", {},
              "list of (float, float, float)\n"
              "    Position [fraction of the length], mass [kg] and diameter [m] of each."))
      .def_property_readonly(
          "stiffness", &Section::stiffness,
          "Bending stiffness K = E I / length [N m/rad], paper eq. (23); the mean of a taper.")
      .def_property_readonly("is_rod", &Section::is_rod,
                             "Whether it is more than an arc, cpp/rods.md.");
}

void bind_cable(py::module_& m) {
  py::class_<Cable>(m, "Cable", "One cable as the core takes it, unchecked; see cdcr.Cable.")
      .def(py::init([](const Route& radius, const Route& angle, int end_section, double stiffness,
                       double damping, std::optional<double> friction, int start_section,
                       double entry_friction, double sheath_friction, double viscosity,
                       double pretension, double backlash) {
             Cable cable;
             cable.end_section = end_section;
             cable.stiffness = stiffness;
             cable.damping = damping;
             cable.friction = friction;
             cable.start_section = start_section;
             cable.entry_friction = entry_friction;
             cable.sheath_friction = sheath_friction;
             cable.viscosity = viscosity;
             cable.pretension = pretension;
             cable.backlash = backlash;
             read_route(radius, cable.radius, cable.radii);
             read_route(angle, cable.angle, cable.angles);
             return cable;
           }),
           py::kw_only(), "radius"_a, "angle"_a, "end_section"_a, "stiffness"_a, "damping"_a,
           "friction"_a, "start_section"_a, "entry_friction"_a, "sheath_friction"_a, "viscosity"_a,
           "pretension"_a, "backlash"_a, Doc("Take the fields.", {fields_of_cable}))
      .def_readonly("radius", &Cable::radius, "Distance from the backbone [m], where even.")
      .def_readonly("angle", &Cable::angle, "Angle about Z, from X [rad], where even.")
      .def_readonly("radii", &Cable::radii,
                    "Distances at base and tip of each section passed [m], or none.")
      .def_readonly("angles", &Cable::angles,
                    "Angles at base and tip of each section passed [rad], or none.")
      .def_readonly("start_section", &Cable::start_section,
                    "Index of the section at whose base it begins.")
      .def_readonly("end_section", &Cable::end_section, "Index of the section where it ends.")
      .def_readonly("stiffness", &Cable::stiffness,
                    "Of the cable and its drive [N/m]; 0: driven by tension.")
      .def_readonly("damping", &Cable::damping, "Along with the stiffness [N s/m].")
      .def_readonly("friction", &Cable::friction,
                    "Coulomb's coefficient in its holes, or None [-].")
      .def_readonly("entry_friction", &Cable::entry_friction, "Coulomb's, at its entry [N].")
      .def_readonly("sheath_friction", &Cable::sheath_friction,
                    "Coefficient of its sheath times the sheath's turning [-].")
      .def_readonly("viscosity", &Cable::viscosity, "Viscous friction at its entry [N s/m].")
      .def_readonly("pretension", &Cable::pretension,
                    "Pull at the length commanded, where driven by length [N].")
      .def_readonly("backlash", &Cable::backlash, "Play of its drive, where driven by length [m].");
}

}  // namespace

void bind_robot(py::module_& m) {
  m.attr("max_sections") = max_sections;
  m.attr("max_order") = max_order;
  bind_section(m);
  bind_cable(m);
  py::class_<Robot>(m, "Robot", "A robot as the core takes it, unchecked; see cdcr.Robot.")
      .def(py::init([](std::vector<Section> sections, const Vector3d& gravity, double payload,
                       std::vector<Cable> cables, const Matrix3d& base_orientation,
                       const Vector3d& base_position, const Vector3d& payload_position,
                       const Matrix3d& payload_inertia, double sliding_speed, const Transform& tool,
                       double presliding_stiffness) {
             return Robot{std::move(sections),
                          gravity,
                          payload,
                          std::move(cables),
                          base_orientation,
                          base_position,
                          payload_position,
                          payload_inertia,
                          sliding_speed,
                          tool,
                          presliding_stiffness};
           }),
           py::kw_only(), "sections"_a, "gravity"_a, "payload"_a, "cables"_a, "base_orientation"_a,
           "base_position"_a, "payload_position"_a, "payload_inertia"_a, "sliding_speed"_a,
           "tool"_a, "presliding_stiffness"_a, Doc("Take the fields.", {fields_of_robot}))
      .def(
          "violations", [](const Robot& robot) { return violations(robot); },
          Doc("One sentence for each field out of its range.", {}, sentences))
      .def(
          "locate",
          [](const Robot& robot, double s) {
            const Place place = robot.locate(s);
            return py::make_tuple(place.section, place.fraction);
          },
          "s"_a,
          Doc("The place at an arc length from the base.", {"s : float\n    Arc length [m].\n"},
              "section : int\nfraction : float", docs::bad_argument))
      .def("all_cables", &Robot::all_cables,
           Doc("Every cable, in the order of the commands.", {},
               "list of Cable\n    Those of the sections, then those of the robot."));
}

}  // namespace cdcr::python
