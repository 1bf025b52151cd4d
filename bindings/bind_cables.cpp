#include "bind.hpp"
#include "cdcr/cable_friction.hpp"
#include "cdcr/kinematics.hpp"
#include "docs.hpp"
#include "many_states.hpp"

namespace cdcr::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

States<3> with_rates(const Model& self, const py::object& q, const py::object& qd,
                     const py::object& tension) {
  return States{read_bendings(self, q), read_rates(self, qd, "qd"), read_tensions(self, tension)};
}

}  // namespace

void bind_cables(PyModel& model) {
  model
      .def(
          "cable_lengths",
          [](const Model& self, const py::object& q) {
            return arrays(States{read_bendings(self, q)}, {self.num_cables()},
                          [&](Index count, const StateRows& x, double* out) {
                            cable_lengths(self, count, x, out);
                          });
          },
          "q"_a,
          Doc("Lengths of the cables inside the robot, cpp/README.md eq. (6).", {docs::q},
              "(..., num_cables) array\n    Lengths [m].", docs::bad_states))
      .def(
          "cable_tensions",
          [](const Model& self, const py::object& q, const py::object& qd,
             const py::object& tension) {
            return with_rates(self, q, qd, tension)
                .vectors(self.num_cables(), [&](auto& x, auto& xd, auto& command, auto& out) {
                  cable_tensions(self, x, xd, command, out);
                });
          },
          "q"_a, "qd"_a, "tension"_a,
          Doc("Tensions at the base, also of cables driven by length: "
              "cpp/several-sections.md eq. (36).",
              {docs::q, docs::qd, docs::tension},
              "(..., num_cables) array\n    Tensions [N]; 0 for a slack cable.", docs::bad_states))
      .def(
          "tensions_along",
          [](const Model& self, const py::object& q, const py::object& qd,
             const py::object& tension) {
            return with_rates(self, q, qd, tension)
                .matrices(self.num_sections() + 1, self.num_cables(),
                          [&](auto& x, auto& xd, auto& command, auto& out) {
                            tensions_along(self, x, xd, command, out);
                          });
          },
          "q"_a, "qd"_a, "tension"_a,
          Doc("Tensions along the cables, which friction changes: cpp/several-sections.md "
              "eqs. (37), (38).",
              {docs::q, docs::qd, docs::tension},
              "(..., n + 1, num_cables) array\n"
              "    Tensions [N] at the base, then beyond each of the n sections; 0 beyond the end\n"
              "    of a cable.",
              docs::bad_states))
      .def(
          "cable_force",
          [](const Model& self, const py::object& q, const py::object& qd,
             const py::object& tension) {
            return with_rates(self, q, qd, tension)
                .vectors(self.num_coordinates(), [&](auto& x, auto& xd, auto& command, auto& out) {
                  cable_force(self, x, xd, command, out);
                });
          },
          "q"_a, "qd"_a, "tension"_a,
          Doc("Generalised force of the cables, friction included: cpp/several-sections.md "
              "eqs. (36) to (39).",
              {docs::q, docs::qd, docs::tension}, "(..., d) array\n    Generalised force [N m].",
              docs::bad_states))
      .def(
          "friction_power",
          [](const Model& self, const py::object& q, const py::object& qd,
             const py::object& tension, const py::object& deflection) -> py::object {
            if (!deflection.is_none()) {
              return States{read_bendings(self, q), read_rates(self, qd, "qd"),
                            read_tensions(self, tension),
                            StateArgument("deflection", deflection, self.num_cables(), of_cables)}
                  .values([&](auto& x, auto& xd, auto& command, auto& w) {
                    return friction_power(self, x, xd, command, w);
                  });
            }
            return with_rates(self, q, qd, tension).values([&](auto& x, auto& xd, auto& command) {
              return friction_power(self, x, xd, command);
            });
          },
          "q"_a, "qd"_a, "tension"_a, "deflection"_a = py::none(),
          Doc("Heat that friction of the cables makes, never negative: -F.dl/dt - Q.qd of "
              "cpp/README.md\neq. (17).",
              {docs::q, docs::qd, docs::tension,
               "deflection : (..., num_cables) array_like, optional\n"
               "    Of cables whose friction remembers [m]; else that of the sliding speed.\n"},
              "float or (...) array\n    Power [W].", docs::bad_states))
      .def(
          "cable_energy",
          [](const Model& self, const py::object& q, const py::object& tension) {
            return States{read_bendings(self, q), read_tensions(self, tension)}.values(
                [&](auto& x, auto& command) { return cable_energy(self, x, command); });
          },
          "q"_a, "tension"_a,
          Doc("Energy in the springs of cables driven by length, sum k max(0, s)^2/2 of\n"
              "cpp/several-sections.md eq. (42).",
              {docs::q, docs::tension}, "float or (...) array\n    Energy [J].", docs::bad_states))
      .def(
          "rest_command",
          [](const Model& self) {
            VectorXd out(self.num_cables());
            rest_command(self, out);
            return to_array(out);
          },
          Doc("Command that leaves the straight robot alone.", {},
              "(num_cables,) array\n"
              "    No tension [N]; straight lengths [m] of cables driven by length."));
}

}  // namespace cdcr::python
