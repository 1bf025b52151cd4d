#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bind.hpp"
#include "cdcr/robot.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

void bind_robot(py::module_& m) {
  py::class_<Section>(m, "Section", "One section as the core sees it; not validated.")
      .def(py::init([](double length, double backbone_mass, double backbone_diameter,
                       double youngs_modulus, double disk_mass, double disk_diameter, int num_disks,
                       double cable_radius, std::vector<double> cable_angles, double damping) {
             return Section{length,         backbone_mass, backbone_diameter,
                            youngs_modulus, disk_mass,     disk_diameter,
                            num_disks,      cable_radius,  std::move(cable_angles),
                            damping};
           }),
           py::kw_only(), "length"_a, "backbone_mass"_a, "backbone_diameter"_a, "youngs_modulus"_a,
           "disk_mass"_a, "disk_diameter"_a, "num_disks"_a, "cable_radius"_a, "cable_angles"_a,
           "damping"_a)
      .def(
          "violations", [](const Section& section) { return violations(section); },
          "One sentence for each field out of its range.")
      .def_property_readonly("stiffness", &Section::stiffness, "E I / length [N m/rad].");

  py::class_<Robot>(m, "Robot", "A robot as the core sees it; not validated.")
      .def(py::init([](std::vector<Section> sections, const Vector3d& gravity, double payload) {
             return Robot{std::move(sections), gravity, payload};
           }),
           py::kw_only(), "sections"_a, "gravity"_a, "payload"_a)
      .def(
          "violations", [](const Robot& robot) { return violations(robot); },
          "One sentence for each field out of its range.");
}

}  // namespace cdcr::python
