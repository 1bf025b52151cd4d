#include <pybind11/native_enum.h>
#include <pybind11/stl.h>

#include <sstream>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/allocation.hpp"
#include "cdcr/statics.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

void bind_statics(py::module_& m, PyModel& model) {
  py::class_<Equilibrium>(m, "Equilibrium", "A point of rest and whether the robot stays there.")
      .def_property_readonly("q", [](const Equilibrium& self) { return to_array(self.q); })
      .def_property_readonly("eigenvalues",
                             [](const Equilibrium& self) { return to_array(self.eigenvalues); })
      .def_property_readonly("tension",
                             [](const Equilibrium& self) { return to_array(self.tension); })
      .def_readonly("stable", &Equilibrium::stable)
      .def_readonly("residual", &Equilibrium::residual)
      .def_readonly("iterations", &Equilibrium::iterations)
      .def_readonly("load_steps", &Equilibrium::load_steps)
      .def_readonly("searches", &Equilibrium::searches)
      .def_readonly("status", &Equilibrium::status);

  py::class_<Allocation>(m, "Allocation", "Tensions for a generalised force, or the nearest.")
      .def_property_readonly("tension",
                             [](const Allocation& self) { return to_array(self.tension); })
      .def_property_readonly("force", [](const Allocation& self) { return to_array(self.force); })
      .def_readonly("distance", &Allocation::distance)
      .def_readonly("feasible", &Allocation::feasible)
      .def_readonly("limiting", &Allocation::limiting)
      .def_readonly("limits", &Allocation::limits);

  py::native_enum<AllocationMethod>(m, "AllocationMethod", "enum.Enum", "How tensions are found.")
      .value("automatic", AllocationMethod::automatic)
      .value("sections", AllocationMethod::sections)
      .value("search", AllocationMethod::search)
      .finalize();

  model.def(
      "find_tension",
      [](const Model& self, const py::object& force, double min_tension, double max_tension,
         AllocationMethod method) {
        if (!(min_tension >= 0.0)) {
          std::ostringstream text;
          text << "min_tension must be >= 0 N (a cable cannot push), got " << min_tension;
          throw py::value_error(text.str());
        }
        return allocate(self, *VectorArgument(force, "force", self.num_coordinates()),
                        {min_tension, max_tension, {}, method});
      },
      "force"_a, "min_tension"_a, "max_tension"_a, "method"_a = AllocationMethod::automatic);
  model.def(
      "find_equilibrium",
      [](const Model& self, const py::object& tension, const py::object& q0,
         const py::object& wrenches) {
        const VectorXd start = q0.is_none() ? VectorXd() : VectorXd(*read_bending(self, q0, "q0"));
        return equilibrium(self, *read_tension(self, tension), start,
                           read_wrenches(self, wrenches));
      },
      "tension"_a, "q0"_a = py::none(), "wrenches"_a = py::tuple());
  model.def(
      "static_stiffness",
      [](const Model& self, const py::object& q, const py::object& tension,
         const py::object& wrenches) {
        MatrixXd K(self.num_coordinates(), self.num_coordinates());
        static_stiffness(self, *read_bending(self, q, "q"), *read_tension(self, tension),
                         read_wrenches(self, wrenches), K);
        return to_rows(K);
      },
      "q"_a, "tension"_a, "wrenches"_a = py::tuple());
  model.def(
      "commands",
      [](const Model& self, const py::object& q, const py::object& tension) {
        VectorXd command(self.num_cables());
        cable_commands(self, *read_bending(self, q, "q"), *read_tension(self, tension), command);
        return to_array(command);
      },
      "q"_a, "tension"_a);
}

}  // namespace cdcr::python
