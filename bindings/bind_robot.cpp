#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bind.hpp"
#include "cdcr/robot.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

namespace {

using Doubles = std::vector<double>;

void bind_section(py::module_& m) {
  py::class_<Section>(m, "Section", "One section as the core sees it; not validated.")
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
           "cable_damping"_a, "cable_friction"_a, "damping"_a)
      .def(
          "violations", [](const Section& section) { return violations(section); },
          "One sentence for each field out of its range.")
      .def(
          "disks",
          [](const Section& section) {
            py::list disks;
            for (const Disk& disk : section.disks()) {
              disks.append(py::make_tuple(disk.position, disk.mass, disk.diameter));
            }
            return disks;
          },
          "Position, mass and diameter of each disk.")
      .def_property_readonly("stiffness", &Section::stiffness, "E I / length [N m/rad].");
}

void bind_cable(py::module_& m) {
  py::class_<Cable>(m, "Cable", "One cable as the core sees it; not validated.")
      .def(py::init([](double radius, double angle, int end_section, double stiffness,
                       double damping, std::optional<double> friction) {
             return Cable{radius, angle, end_section, stiffness, damping, friction};
           }),
           py::kw_only(), "radius"_a, "angle"_a, "end_section"_a, "stiffness"_a, "damping"_a,
           "friction"_a)
      .def_readonly("radius", &Cable::radius)
      .def_readonly("angle", &Cable::angle)
      .def_readonly("end_section", &Cable::end_section)
      .def_readonly("stiffness", &Cable::stiffness)
      .def_readonly("damping", &Cable::damping)
      .def_readonly("friction", &Cable::friction);
}

}  // namespace

void bind_robot(py::module_& m) {
  m.attr("max_sections") = max_sections;
  bind_section(m);
  bind_cable(m);
  py::class_<Robot>(m, "Robot", "A robot as the core sees it; not validated.")
      .def(py::init([](std::vector<Section> sections, const Vector3d& gravity, double payload,
                       std::vector<Cable> cables, const Matrix3d& base_orientation,
                       const Vector3d& payload_position, const Matrix3d& payload_inertia,
                       double sliding_speed) {
             return Robot{std::move(sections), gravity,          payload,         std::move(cables),
                          base_orientation,    payload_position, payload_inertia, sliding_speed};
           }),
           py::kw_only(), "sections"_a, "gravity"_a, "payload"_a, "cables"_a, "base_orientation"_a,
           "payload_position"_a, "payload_inertia"_a, "sliding_speed"_a)
      .def(
          "violations", [](const Robot& robot) { return violations(robot); },
          "One sentence for each field out of its range.")
      .def("all_cables", &Robot::all_cables, "Every cable, in the order of the tensions.");
}

}  // namespace cdcr::python
