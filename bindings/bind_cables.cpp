#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/cables.hpp"

namespace cdcr::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

/// Calls f(q, qd, command) with arguments read and checked.
template <class F>
auto with_state(const Model& self, const py::object& q, const py::object& qd,
                const py::object& tension, F&& f) {
  const VectorArgument bending = read_bending(self, q, "q");
  const VectorArgument rate(qd, "qd", self.num_coordinates());
  const VectorArgument command = read_tension(self, tension);
  return f(*bending, *rate, *command);
}

}  // namespace

void bind_cables(PyModel& model) {
  model
      .def(
          "cable_tensions",
          [](const Model& self, const py::object& q, const py::object& qd,
             const py::object& tension) {
            return with_state(self, q, qd, tension, [&](auto& x, auto& xd, auto& command) {
              VectorXd out(self.num_cables());
              cable_tensions(self, x, xd, command, out);
              return to_array(out);
            });
          },
          "q"_a, "qd"_a, "tension"_a)
      .def(
          "tensions_along",
          [](const Model& self, const py::object& q, const py::object& qd,
             const py::object& tension) {
            return with_state(self, q, qd, tension, [&](auto& x, auto& xd, auto& command) {
              MatrixXd out(self.num_sections() + 1, self.num_cables());
              tensions_along(self, x, xd, command, out);
              return to_rows(out);
            });
          },
          "q"_a, "qd"_a, "tension"_a)
      .def(
          "cable_force",
          [](const Model& self, const py::object& q, const py::object& qd,
             const py::object& tension) {
            return with_state(self, q, qd, tension, [&](auto& x, auto& xd, auto& command) {
              VectorXd out(self.num_coordinates());
              cable_force(self, x, xd, command, out);
              return to_array(out);
            });
          },
          "q"_a, "qd"_a, "tension"_a)
      .def(
          "friction_power",
          [](const Model& self, const py::object& q, const py::object& qd,
             const py::object& tension) {
            return with_state(self, q, qd, tension, [&](auto& x, auto& xd, auto& command) {
              return friction_power(self, x, xd, command);
            });
          },
          "q"_a, "qd"_a, "tension"_a)
      .def(
          "cable_energy",
          [](const Model& self, const py::object& q, const py::object& tension) {
            return cable_energy(self, *read_bending(self, q, "q"), *read_tension(self, tension));
          },
          "q"_a, "tension"_a)
      .def("rest_command", [](const Model& self) {
        VectorXd out(self.num_cables());
        rest_command(self, out);
        return to_array(out);
      });
}

}  // namespace cdcr::python
