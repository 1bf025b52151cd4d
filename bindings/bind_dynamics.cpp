#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/linearization.hpp"

namespace cdcr::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

VectorArgument read_rate(const Model& model, const py::handle& object, const char* name) {
  return {object, name, model.num_coordinates()};
}

/// Applies f to every row of q (N, 2n) and, where given, qd (N, 2n), without the GIL.
template <class F>
py::array_t<double> for_each_row(const Model& self, const py::object& q, const py::object* qd,
                                 F&& f) {
  const Index m = self.num_coordinates();
  const Array rows = read_array(q, "q", {-1, m});
  const Array rates = qd != nullptr ? read_array(*qd, "qd", {rows.shape(0), m}) : rows;
  VectorXd values(rows.shape(0));
  {
    const py::gil_scoped_release unlocked;
    Data data(self);
    for (Index i = 0; i < values.size(); ++i) {
      values[i] = f(data, Eigen::Map<const VectorXd>(rows.data() + i * m, m),
                    Eigen::Map<const VectorXd>(rates.data() + i * m, m));
    }
  }
  return to_array(values);
}

}  // namespace

void bind_dynamics(PyModel& model) {
  model
      .def(
          "mass_matrix",
          [](const Model& self, const py::object& q) {
            Data data(self);
            MatrixXd M(self.num_coordinates(), self.num_coordinates());
            mass_matrix(self, data, *read_bending(self, q, "q"), M);
            return to_rows(M);
          },
          "q"_a)
      .def(
          "bias",
          [](const Model& self, const py::object& q, const py::object& qd) {
            Data data(self);
            py::array_t<double> h(self.num_coordinates());
            bias(self, data, *read_bending(self, q, "q"), *read_rate(self, qd, "qd"),
                 Eigen::Map<VectorXd>(h.mutable_data(), h.size()));
            return h;
          },
          "q"_a, "qd"_a)
      .def(
          "forward_dynamics",
          [](const Model& self, const py::object& q, const py::object& qd,
             const py::object& tension, const py::object& wrenches) {
            require_inertia(self);
            Data data(self);
            py::array_t<double> qdd(self.num_coordinates());
            forward_dynamics(self, data, *read_bending(self, q, "q"), *read_rate(self, qd, "qd"),
                             *read_tension(self, tension), read_wrenches(self, wrenches),
                             Eigen::Map<VectorXd>(qdd.mutable_data(), qdd.size()));
            return qdd;
          },
          "q"_a, "qd"_a, "tension"_a, "wrenches"_a = py::tuple())
      .def(
          "inverse_dynamics",
          [](const Model& self, const py::object& q, const py::object& qd, const py::object& qdd) {
            Data data(self);
            py::array_t<double> force(self.num_coordinates());
            inverse_dynamics(self, data, *read_bending(self, q, "q"), *read_rate(self, qd, "qd"),
                             *read_rate(self, qdd, "qdd"),
                             Eigen::Map<VectorXd>(force.mutable_data(), force.size()));
            return force;
          },
          "q"_a, "qd"_a, "qdd"_a)
      .def(
          "kinetic_energy",
          [](const Model& self, const py::object& q, const py::object& qd) {
            Data data(self);
            return kinetic_energy(self, data, *read_bending(self, q, "q"),
                                  *read_rate(self, qd, "qd"));
          },
          "q"_a, "qd"_a)
      .def(
          "potential_energy",
          [](const Model& self, const py::object& q) {
            Data data(self);
            return potential_energy(self, data, *read_bending(self, q, "q"));
          },
          "q"_a)
      .def(
          "kinetic_energies",
          [](const Model& self, const py::object& q, const py::object& qd) {
            return for_each_row(self, q, &qd, [&self](Data& data, const auto& x, const auto& xd) {
              return kinetic_energy(self, data, x, xd);
            });
          },
          "q"_a, "qd"_a)
      .def(
          "potential_energies",
          [](const Model& self, const py::object& q) {
            return for_each_row(self, q, nullptr, [&self](Data& data, const auto& x, const auto&) {
              return potential_energy(self, data, x);
            });
          },
          "q"_a)
      .def(
          "linearize",
          [](const Model& self, const py::object& q, const py::object& qd,
             const py::object& tension, const py::object& wrenches) {
            require_inertia(self);
            Data data(self);
            const Index num_states = 2 * self.num_coordinates();
            MatrixXd A(num_states, num_states), B(num_states, self.num_cables());
            linearize(self, data, *read_bending(self, q, "q"), *read_rate(self, qd, "qd"),
                      *read_tension(self, tension), read_wrenches(self, wrenches), A, B);
            return py::make_tuple(to_rows(A), to_rows(B));
          },
          "q"_a, "qd"_a, "tension"_a, "wrenches"_a = py::tuple())
      .def(
          "wrench_force",
          [](const Model& self, const py::object& q, const py::object& wrenches) {
            VectorXd force = VectorXd::Zero(self.num_coordinates());
            add_wrench_force(self, *read_bending(self, q, "q"), read_wrenches(self, wrenches),
                             force);
            return to_array(force);
          },
          "q"_a, "wrenches"_a);
}

}  // namespace cdcr::python
