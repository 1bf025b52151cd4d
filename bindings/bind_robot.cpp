#include <pybind11/eigen.h>
#include <pybind11/stl.h>

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

void bind_section(py::module_& m) {
  py::class_<Section>(m, "Section",
                      "One section as the core takes it, unchecked; see cdcr.Section.")
      .def(py::init([](double length, double backbone_mass, double backbone_diameter,
                       double youngs_modulus, double disk_mass, double disk_diameter, int num_disks,
                       Doubles disk_positions, Doubles disk_masses, Doubles disk_diameters,
                       double cable_radius, Doubles cable_angles, double cable_stiffness,
                       double cable_damping, double cable_friction, double damping) {
             Section s;
             s.length = length;
             s.backbone_mass = backbone_mass;
             s.backbone_diameter = backbone_diameter;
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
             return s;
           }),
           py::kw_only(), "length"_a, "backbone_mass"_a, "backbone_diameter"_a, "youngs_modulus"_a,
           "disk_mass"_a, "disk_diameter"_a, "num_disks"_a, "disk_positions"_a, "disk_masses"_a,
           "disk_diameters"_a, "cable_radius"_a, "cable_angles"_a, "cable_stiffness"_a,
           "cable_damping"_a, "cable_friction"_a, "damping"_a,
           Doc("Take the fields.", {fields_of_section}))
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
      .def_property_readonly("stiffness", &Section::stiffness,
                             "Bending stiffness K = E I / length [N m/rad], paper eq. (23).");
}

void bind_cable(py::module_& m) {
  py::class_<Cable>(m, "Cable", "One cable as the core takes it, unchecked; see cdcr.Cable.")
      .def(py::init([](double radius, double angle, int end_section, double stiffness,
                       double damping, std::optional<double> friction) {
             return Cable{radius, angle, end_section, stiffness, damping, friction};
           }),
           py::kw_only(), "radius"_a, "angle"_a, "end_section"_a, "stiffness"_a, "damping"_a,
           "friction"_a, Doc("Take the fields.", {fields_of_cable}))
      .def_readonly("radius", &Cable::radius, "Distance from the backbone [m].")
      .def_readonly("angle", &Cable::angle, "Angle about Z, from X [rad].")
      .def_readonly("end_section", &Cable::end_section, "Index of the section where it ends.")
      .def_readonly("stiffness", &Cable::stiffness,
                    "Of the cable and its drive [N/m]; 0: driven by tension.")
      .def_readonly("damping", &Cable::damping, "Along with the stiffness [N s/m].")
      .def_readonly("friction", &Cable::friction,
                    "Coulomb's coefficient in its holes, or None [-].");
}

}  // namespace

void bind_robot(py::module_& m) {
  m.attr("max_sections") = max_sections;
  bind_section(m);
  bind_cable(m);
  py::class_<Robot>(m, "Robot", "A robot as the core takes it, unchecked; see cdcr.Robot.")
      .def(py::init([](std::vector<Section> sections, const Vector3d& gravity, double payload,
                       std::vector<Cable> cables, const Matrix3d& base_orientation,
                       const Vector3d& base_position, const Vector3d& payload_position,
                       const Matrix3d& payload_inertia, double sliding_speed,
                       const Transform& tool) {
             return Robot{std::move(sections), gravity,       payload,          std::move(cables),
                          base_orientation,    base_position, payload_position, payload_inertia,
                          sliding_speed,       tool};
           }),
           py::kw_only(), "sections"_a, "gravity"_a, "payload"_a, "cables"_a, "base_orientation"_a,
           "base_position"_a, "payload_position"_a, "payload_inertia"_a, "sliding_speed"_a,
           "tool"_a, Doc("Take the fields.", {fields_of_robot}))
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
