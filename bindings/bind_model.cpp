#include <pybind11/native_enum.h>
#include <pybind11/stl.h>

#include "bind.hpp"
#include "cdcr/allocation.hpp"
#include "cdcr/cables.hpp"
#include "docs.hpp"
#include "states.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

void bind_model(py::module_& m) {
  py::native_enum<Formulation>(m, "Formulation", "enum.Enum", "Which inertia functions to use.")
      .value("exact", Formulation::exact)
      .value("taylor", Formulation::taylor)
      .value("printed", Formulation::printed)
      .value("printed_taylor", Formulation::printed_taylor)
      .finalize();
  PyModel model(m, "Model", "The equations of motion of a robot; see cdcr.Model.");
  model
      .def(py::init<Robot, Formulation>(), "robot"_a, "formulation"_a,
           Doc("A robot made ready for computing.",
               {"robot : Robot\n    The robot.\n",
                "formulation : Formulation\n    Which inertia functions to use.\n"},
               "", docs::bad_argument))
      .def(py::init<Robot, const Model&>(), "robot"_a, "like"_a,
           Doc("A robot that differs from another in a few numbers.",
               {"robot : Robot\n    The robot.\n",
                "like : Model\n    Of the other, whose formulation it has, and whose tables it\n"
                "    shares where sections have the same inertia.\n"},
               "", docs::bad_argument))
      .def(py::init([](const Model& other, const py::object& gravity) {
             return other.with_gravity(*VectorArgument(gravity, "gravity", 3));
           }),
           "model"_a, "gravity"_a,
           Doc("The same model under another gravity, which shares its tables.",
               {docs::model, "gravity : (3,) array_like\n    In the base frame [m/s^2].\n"}, "",
               docs::bad_argument))
      .def_property_readonly("num_sections", &Model::num_sections,
                             "Number n of sections, from base to tip.")
      .def_property_readonly("num_coordinates", &Model::num_coordinates,
                             "Number d of coordinates q: two for each section of constant\n"
                             "curvature, those of cpp/rods.md eq. (51) for others.")
      .def_property_readonly(
          "coordinate_names",
          [](const Model& self) { return py::tuple(py::cast(self.coordinate_names())); },
          "Names of the coordinates in the order of q, sections from 1: q1_x, q1_y, q2_x, ... of\n"
          "bending; t1, ... of twist; e1, ... of stretch; higher orders q1_x_1, t1_1, e1_2, ...")
      .def(
          "section_slice",
          [](const Model& self, Index section) {
            check_section(self, section);
            const py::int_ first(self.first_coordinate(section));
            return py::slice(first, py::int_(self.first_coordinate(section + 1)), py::none());
          },
          "section"_a,
          Doc("Where the coordinates of a section, cpp/README.md eq. (1), stand in q.",
              {docs::section}, "slice\n    Of the last axis of q, qd and what is like them.",
              docs::bad_argument))
      .def_property_readonly("num_cables", &Model::num_cables,
                             "Number of all cables, those of sections first.")
      .def_property_readonly("has_inertia", &Model::has_inertia,
                             "Whether the robot has dynamics: every motion moves some mass.")
      .def_property_readonly("has_rods", &Model::has_rods,
                             "Whether its sections are more than arcs, or a cable winds.")
      .def_property_readonly("has_constant_actuation", &Model::has_constant_actuation,
                             "Whether the actuation matrix is the same at all q.")
      .def_property_readonly(
          "rest_shape", [](const Model& self) { return to_array(self.rest()); },
          "The unloaded shape (d,) [rad]: zero but for sections bent or twisted at rest, "
          "cpp/rods.md.")
      .def_property_readonly(
          "elastic_stiffness", [](const Model& self) { return to_rows(self.elastic_stiffness()); },
          "Stiffness K of the backbone (d, d) [N m/rad]: its elastic energy is half of (q - "
          "rest)^T K\n"
          "(q - rest), cpp/README.md eq. (14) and cpp/rods.md eq. (52).")
      .def_property_readonly("has_friction", &Model::has_friction,
                             "Whether a cable rubs in its holes or at its entry.")
      .def_property_readonly("num_deflections", &Model::num_deflections,
                             "Deflections that friction remembers: one for each cable, or 0.")
      .def_property_readonly("has_backlash", &Model::has_backlash,
                             "Whether a drive has play, so that it remembers where it came from.")
      .def(
          "actuation_matrix",
          [](const Model& self, const py::object& q) {
            if (q.is_none()) {
              require_constant_actuation(self);
              return to_rows(self.actuation_matrix());
            }
            return States{read_bendings(self, q)}.matrices(
                self.num_coordinates(), self.num_cables(),
                [&](auto& x, auto& B) { actuation_matrix(self, x, B); });
          },
          "q"_a = py::none(),
          Doc("Matrix B of Q = B F, tensions to generalised force: cpp/README.md eq. (6).",
              {"q : (..., d) array_like, optional\n"
               "    Coordinates, which may be left out where B does not depend on them: where no\n"
               "    cable winds or converges, and none runs through a section that twists.\n"},
              "(..., d, num_cables) array\n    A copy [m].", docs::bad_states));
  bind_cables(model);
  bind_kinematics(model);
  bind_dynamics(model);
  bind_energy(model);
  bind_tables(model);
  bind_statics(m, model);
  bind_modes(model);
  bind_parameters(m, model);
}

}  // namespace cdcr::python
