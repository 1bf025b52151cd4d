#include <complex>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/modes.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

void bind_modes(py::module_& m, PyModel& model) {
  py::class_<Modes>(m, "CoreModes", "Small vibrations about a shape.")
      .def_property_readonly("squared_frequency",
                             [](const Modes& self) { return to_array(self.squared_frequency); })
      .def_property_readonly("frequency",
                             [](const Modes& self) { return to_array(self.frequency); })
      .def_property_readonly("shape", [](const Modes& self) { return to_rows(self.shape); })
      .def_property_readonly("damping_ratio",
                             [](const Modes& self) { return to_array(self.damping_ratio); })
      .def_property_readonly("eigenvalues",
                             [](const Modes& self) {
                               return py::array_t<std::complex<double>>(self.eigenvalues.size(),
                                                                        self.eigenvalues.data());
                             })
      .def_readonly("stable", &Modes::stable);

  model.def(
      "_modes",
      [](const Model& self, const py::object& q, const py::object& tension,
         const py::object& wrenches) {
        return modes(self, *read_bending(self, q, "q"), *read_tension(self, tension),
                     read_wrenches(self, wrenches));
      },
      "q"_a, "tension"_a, "wrenches"_a);
}

}  // namespace cdcr::python
