#include <complex>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/modes.hpp"
#include "docs.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

void bind_modes(py::module_& m, PyModel& model) {
  py::class_<Modes>(m, "CoreModes",
                    "Small vibrations about a shape, as cdcr.Modes holds them:\n"
                    "cpp/several-sections.md eqs. (44), (45).")
      .def_property_readonly(
          "squared_frequency", [](const Modes& self) { return to_array(self.squared_frequency); },
          "Squares of the frequencies (d,), increasing [rad^2/s^2].")
      .def_property_readonly(
          "frequency", [](const Modes& self) { return to_array(self.frequency); },
          "Natural frequencies of the undamped robot (d,) [rad/s].")
      .def_property_readonly(
          "shape", [](const Modes& self) { return to_rows(self.shape); },
          "A mode shape in each column (d, d) [rad/(m sqrt(kg))].")
      .def_property_readonly(
          "damping_ratio", [](const Modes& self) { return to_array(self.damping_ratio); },
          "Damping ratio of each mode alone (d,) [-].")
      .def_property_readonly(
          "eigenvalues",
          [](const Modes& self) {
            return py::array_t<std::complex<double>>(self.eigenvalues.size(),
                                                     self.eigenvalues.data());
          },
          "Eigenvalues of the damped robot (2d,) [1/s].")
      .def_readonly("stable", &Modes::stable, "Whether every small motion stays small.");

  model.def(
      "_modes",
      [](const Model& self, const py::object& q, const py::object& tension,
         const py::object& wrenches) {
        return modes(self, *read_bending(self, q, "q"), *read_tension(self, tension),
                     read_wrenches(self, wrenches));
      },
      "q"_a, "tension"_a, "wrenches"_a, Doc("See cdcr.Model.modes."));
}

}  // namespace cdcr::python
