#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/simulator.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

void bind_simulator(py::module_& m) {
  py::class_<Simulator>(m, "Simulator")
      .def(py::init<const Model&, double, int>(), "model"_a, py::kw_only(), "step"_a = 1e-3,
           "substeps"_a = 1)
      .def(
          "reset",
          [](Simulator& self, const py::object& q, const py::object& qd, double time) {
            self.reset(*read_bending(self.model(), q, "q"),
                       *VectorArgument(qd, "qd", self.model().num_coordinates()), time);
          },
          "q"_a, "qd"_a, "time"_a = 0.0)
      .def(
          "step",
          [](Simulator& self, const py::object& tension, const py::object& wrenches) {
            return self.step(*read_tension(self.model(), tension),
                             read_wrenches(self.model(), wrenches));
          },
          "tension"_a, "wrenches"_a = py::tuple())
      .def_property_readonly("q", [](const Simulator& self) { return to_array(self.q()); })
      .def_property_readonly("qd", [](const Simulator& self) { return to_array(self.qd()); })
      .def_property_readonly("time", &Simulator::time)
      .def_property_readonly("period", &Simulator::period);
}

}  // namespace cdcr::python
