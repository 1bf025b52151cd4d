#include <algorithm>
#include <array>

#include "bind.hpp"
#include "cdcr/base_wrench.hpp"
#include "cdcr/dynamics.hpp"
#include "derivatives/linearization.hpp"
#include "docs.hpp"
#include "many_states.hpp"

namespace cdcr::python {
namespace {

namespace py = pybind11;
using namespace py::literals;
using detail::by_rows, detail::differentiate_motion;

py::tuple linearize_states(const Model& self, const py::object& q, const py::object& qd,
                           const py::object& tension, const py::object& wrenches) {
  require_inertia(self);
  const Wrenches loads = read_wrenches(self, wrenches);
  const States states{read_bendings(self, q), read_rates(self, qd, "qd"),
                      read_tensions(self, tension)};
  keep_freed_memory();
  const Index d = self.num_coordinates(), num_cables = self.num_cables();
  py::array_t<double> A = states.output({2 * d, 2 * d}), B = states.output({2 * d, num_cables});
  double *a = A.mutable_data(), *b = B.mutable_data();
  states.each([&](Index i, const auto& x, const auto& xd, const auto& command) {
    double *a_i = a + i * 4 * d * d, *b_i = b + i * 2 * d * num_cables;
    Eigen::Map<RowMatrixXd> upper(a_i, d, 2 * d);  // d(q)/dt = qd
    upper.setZero();
    upper.rightCols(d).setIdentity();
    std::fill_n(b_i, d * num_cables, 0.0);
    a_i += 2 * d * d;
    auto on_command = by_rows(b_i + d * num_cables, d, num_cables, num_cables);
    differentiate_motion(self, scratch(self), x, xd, command, loads,
                         {by_rows(a_i, d, d, 2 * d), by_rows(a_i, d, d, 2 * d, d), &on_command});
  });
  return py::make_tuple(std::move(A), std::move(B));
}

py::array_t<double> accelerations(const Model& self, const py::object& q, const py::object& qd,
                                  const py::object& tension, const Wrenches& loads) {
  const Index d = self.num_coordinates();
  const States states{read_bendings(self, q), read_rates(self, qd, "qd"),
                      read_tensions(self, tension)};
  if (!loads.empty()) {
    return states.vectors(d, [&](auto& x, auto& xd, auto& command, auto& out) {
      forward_dynamics(self, scratch(self), x, xd, command, loads, out);
    });
  }
  return arrays(states, {d}, [&](Index count, const auto&... rows) {
    forward_dynamics(self, scratch(self), count, rows...);
  });
}

py::array_t<double> generalised_forces(const Model& self, const py::object& q, const py::object& qd,
                                       const py::object& qdd, const Wrenches& loads) {
  const Index d = self.num_coordinates();
  const States states{read_bendings(self, q), read_rates(self, qd, "qd"),
                      read_rates(self, qdd, "qdd")};
  if (!loads.empty()) {
    return states.vectors(d, [&](auto& x, auto& xd, auto& xdd, auto& out) {
      inverse_dynamics(self, scratch(self), x, xd, xdd, loads, out);
    });
  }
  return arrays(states, {d}, [&](Index count, const auto&... rows) {
    inverse_dynamics(self, scratch(self), count, rows...);
  });
}

py::tuple differentiate_states(const Model& self, const py::object& q, const py::object& qd,
                               const py::object& tension, const py::object& wrenches) {
  require_inertia(self);
  const Wrenches loads = read_wrenches(self, wrenches);
  const States states{read_bendings(self, q), read_rates(self, qd, "qd"),
                      read_tensions(self, tension)};
  const Index d = self.num_coordinates(), num_cables = self.num_cables();
  const auto num_wrenches = static_cast<Index>(loads.size());
  keep_freed_memory();
  std::array<py::array_t<double>, 4> outputs{states.output({d, d}), states.output({d, d}),
                                             states.output({d, num_cables}),
                                             states.output({d, num_wrenches, 6})};
  std::array<double*, 4> data{};
  for (std::size_t k = 0; k < data.size(); ++k) data[k] = outputs[k].mutable_data();
  states.each([&](Index i, const auto& x, const auto& xd, const auto& command) {
    const auto part = [&](std::size_t k, Index width) {
      return by_rows(data[k] + i * d * width, d, width, width);
    };
    auto on_command = part(2, num_cables), on_wrenches = part(3, 6 * num_wrenches);
    differentiate_motion(self, scratch(self), x, xd, command, loads,
                         {part(0, d), part(1, d), &on_command, &on_wrenches});
  });
  return py::make_tuple(outputs[0], outputs[1], outputs[2], outputs[3]);
}

}  // namespace

void bind_dynamics(PyModel& model) {
  model
      .def(
          "mass_matrix",
          [](const Model& self, const py::object& q) {
            const Index d = self.num_coordinates();
            return arrays(States{read_bendings(self, q)}, {d, d},
                          [&](Index count, const auto&... rows) {
                            mass_matrix(self, scratch(self), count, rows...);
                          });
          },
          "q"_a,
          Doc("Mass matrix M(q): cpp/README.md eq. (11), cpp/several-sections.md eq. (34).",
              {docs::q}, "(..., d, d) array\n    Symmetric [kg m^2].", docs::bad_states))
      .def(
          "bias",
          [](const Model& self, const py::object& q, const py::object& qd) {
            return arrays(States{read_bendings(self, q), read_rates(self, qd, "qd")},
                          {self.num_coordinates()}, [&](Index count, const auto&... rows) {
                            bias(self, scratch(self), count, rows...);
                          });
          },
          "q"_a, "qd"_a,
          Doc("Coriolis, damping, elastic and gravity terms h(q, qd): cpp/README.md eq. (16),\n"
              "cpp/several-sections.md eq. (33).",
              {docs::q, docs::qd}, "(..., d) array\n    Generalised force [N m].",
              docs::bad_states))
      .def(
          "forward_dynamics",
          [](const Model& self, const py::object& q, const py::object& qd,
             const py::object& tension, const py::object& wrenches) {
            require_inertia(self);
            return accelerations(self, q, qd, tension, read_wrenches(self, wrenches));
          },
          "q"_a, "qd"_a, "tension"_a = py::none(), "wrenches"_a = py::tuple(),
          Doc("Accelerations under cables and wrenches: cpp/README.md eqs. (12), (16),\n"
              "cpp/several-sections.md eq. (32).",
              {docs::q, docs::qd, docs::tension_or_rest, docs::wrenches},
              "(..., d) array\n    Accelerations qdd [rad/s^2].", docs::bad_states))
      .def(
          "inverse_dynamics",
          [](const Model& self, const py::object& q, const py::object& qd, const py::object& qdd,
             const py::object& wrenches) {
            return generalised_forces(self, q, qd, qdd, read_wrenches(self, wrenches));
          },
          "q"_a, "qd"_a, "qdd"_a, "wrenches"_a = py::tuple(),
          Doc("Generalised force of the cables that produces given accelerations beside wrenches:\n"
              "cpp/README.md eq. (16), cpp/several-sections.md eqs. (33), (35).",
              {docs::q, docs::qd,
               "qdd : (..., d) array_like\n"
               "    Accelerations [rad/s^2].\n",
               docs::wrenches},
              "(..., d) array\n    Generalised force [N m].", docs::bad_states))
      .def(
          "base_wrench",
          [](const Model& self, const py::object& q, const py::object& qd, const py::object& qdd,
             const py::object& wrenches) {
            const Wrenches loads = read_wrenches(self, wrenches);
            return States{read_bendings(self, q), read_rates(self, qd, "qd"),
                          read_rates(self, qdd, "qdd")}
                .vectors(6, [&](auto& x, auto& xd, auto& xdd, auto& out) {
                  base_wrench(self, x, xd, xdd, loads, out);
                });
          },
          "q"_a, "qd"_a, "qdd"_a, "wrenches"_a = py::tuple(),
          Doc("Force and moment of the robot on its base, where the drives of its cables stand "
              "too:\ncpp/base-wrench.md eq. (123). At rest the weight, and the wrenches on it.",
              {docs::q, docs::qd,
               "qdd : (..., d) array_like\n"
               "    Accelerations [rad/s^2].\n",
               docs::wrenches},
              "(..., 6) array\n    Force [N], and moment about base_position [N m], in the base "
              "frame.",
              docs::bad_states))
      .def(
          "linearize", &linearize_states, "q"_a, "qd"_a, "tension"_a = py::none(),
          "wrenches"_a = py::tuple(),
          Doc("Derivatives A, B of d(q, qd)/dt by state and command, cpp/README.md eq. (19).\n\n"
              "Exact, at rest or moving, through cables and wrenches too. At the kinks of a cable\n"
              "(just slack; friction at a straight section) one side is taken.",
              {docs::q, docs::qd, docs::tension_or_rest, docs::wrenches},
              "A : (..., 2d, 2d) array\n"
              "    By the state (q, qd) [rad, rad/s], of its rate [rad/s, rad/s^2].\n"
              "B : (..., 2d, num_cables) array\n"
              "    By the command [N], or [m] for cables driven by length.",
              docs::bad_states))
      .def("_derivatives", &differentiate_states, "q"_a, "qd"_a, "tension"_a, "wrenches"_a,
           Doc("See cdcr.Model.derivatives."))
      .def(
          "wrench_force",
          [](const Model& self, const py::object& q, const py::object& wrenches) {
            const Wrenches loads = read_wrenches(self, wrenches);
            return States{read_bendings(self, q)}.vectors(self.num_coordinates(),
                                                          [&](auto& x, auto& out) {
                                                            out.setZero();
                                                            add_wrench_force(self, x, loads, out);
                                                          });
          },
          "q"_a, "wrenches"_a,
          Doc("Generalised force of wrenches, cpp/several-sections.md eq. (35).",
              {docs::q, docs::wrenches}, "(..., d) array\n    Generalised force [N m].",
              docs::bad_states));
}

}  // namespace cdcr::python
