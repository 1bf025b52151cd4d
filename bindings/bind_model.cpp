#include <pybind11/native_enum.h>

#include "arrays.hpp"
#include "bind.hpp"

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
  PyModel model(m, "Model");
  model.def(py::init<Robot, Formulation>(), "robot"_a, "formulation"_a)
      .def_property_readonly("num_sections", &Model::num_sections)
      .def_property_readonly("num_coordinates", &Model::num_coordinates)
      .def_property_readonly("num_cables", &Model::num_cables)
      .def_property_readonly("has_inertia", &Model::has_inertia)
      .def_property_readonly("has_friction", &Model::has_friction)
      .def("actuation_matrix", [](const Model& self) { return to_rows(self.actuation_matrix()); });
  bind_cables(model);
  bind_kinematics(model);
  bind_dynamics(model);
  bind_statics(m, model);
  bind_modes(m, model);
}

}  // namespace cdcr::python
