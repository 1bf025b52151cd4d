#include "arrays.hpp"
#include "bind.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

void bind_model(py::module_& m) {
  PyModel model(m, "Model");
  model.def(py::init<Robot>(), "robot"_a)
      .def_property_readonly("num_sections", &Model::num_sections)
      .def_property_readonly("num_coordinates", &Model::num_coordinates)
      .def_property_readonly("num_cables", &Model::num_cables)
      .def_property_readonly("has_inertia", &Model::has_inertia)
      .def("actuation_matrix",
           [](const Model& self) { return to_rows(self.actuation_matrix()); });
  bind_kinematics(model);
  bind_dynamics(model);
  bind_statics(m, model);
}

}  // namespace cdcr::python
