#include "bind.hpp"
#include "cdcr/dynamics.hpp"
#include "docs.hpp"
#include "many_states.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

void bind_energy(PyModel& model) {
  model
      .def(
          "kinetic_energy",
          [](const Model& self, const py::object& q, const py::object& qd) {
            return numbers(States{read_bendings(self, q), read_rates(self, qd, "qd")},
                           [&](Index count, const auto&... rows) {
                             kinetic_energy(self, scratch(self), count, rows...);
                           });
          },
          "q"_a, "qd"_a,
          Doc("Kinetic energy T = qd.M(q) qd/2, cpp/README.md eq. (8).", {docs::q, docs::qd},
              "float or (...) array\n    Energy [J].", docs::bad_states))
      .def(
          "potential_energy",
          [](const Model& self, const py::object& q) {
            return numbers(States{read_bendings(self, q)}, [&](Index count, const auto&... rows) {
              potential_energy(self, scratch(self), count, rows...);
            });
          },
          "q"_a,
          Doc("Elastic energy plus weight, the latter zero at the base: cpp/README.md eq. (15).",
              {docs::q}, "float or (...) array\n    Energy U [J].", docs::bad_states))
      .def(
          "potential_gradient",
          [](const Model& self, const py::object& q) {
            return arrays(States{read_bendings(self, q)}, {self.num_coordinates()},
                          [&](Index count, const auto&... rows) {
                            potential_gradient(self, scratch(self), count, rows...);
                          });
          },
          "q"_a,
          Doc("Generalised force dU/dq that holds the robot still, cpp/README.md eq. (18).",
              {docs::q}, "(..., d) array\n    Generalised force [N m].", docs::bad_states))
      .def(
          "potential_hessian",
          [](const Model& self, const py::object& q) {
            const Index d = self.num_coordinates();
            return States{read_bendings(self, q)}.matrices(
                d, d, [&](auto& x, auto& out) { potential_hessian(self, scratch(self), x, out); });
          },
          "q"_a,
          Doc("Stiffness d2U/dq2 of the robot without its cables, cpp/several-sections.md\n"
              "eq. (41).",
              {docs::q}, "(..., d, d) array\n    Symmetric [N m/rad].", docs::bad_states));
  // Names from before arrays of states were taken.
  model.attr("kinetic_energies") = model.attr("kinetic_energy");
  model.attr("potential_energies") = model.attr("potential_energy");
}

}  // namespace cdcr::python
