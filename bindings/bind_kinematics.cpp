#include <pybind11/stl.h>

#include <optional>
#include <sstream>

#include "bind.hpp"
#include "cdcr/inverse_kinematics.hpp"
#include "cdcr/kinematic_hessian.hpp"
#include "docs.hpp"
#include "gil.hpp"
#include "many_states.hpp"

namespace cdcr::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

/// R and p that `place`(count, q, R, p) writes.
template <class F>
py::tuple poses(const States<1>& states, F&& place) {
  py::array_t<double> all_R = states.output({3, 3}), all_p = states.output({3});
  double *R = all_R.mutable_data(), *p = all_p.mutable_data();
  in_blocks(states, [&](Index first, Index count, const StateRows& q) {
    place(count, q, R + 9 * first, p + 3 * first);
  });
  return py::make_tuple(std::move(all_R), std::move(all_p));
}

/// dJ/dq (.., 6, d, d) that `write` gives for each state.
template <class F>
py::array_t<double> hessians(const Model& model, const States<1>& states, F&& write) {
  const Index d = model.num_coordinates();
  py::array_t<double> all = states.output({6, d, d});
  double* out = all.mutable_data();
  MatrixXd H(6, d * d);
  states.each([&](Index i, const auto& x) {
    write(x, H);
    Eigen::Map<RowMatrixXd>(out + i * H.size(), 6, d * d) = H;
  });
  return all;
}

void check_place(const Model& model, Index section, double fraction) {
  check_section(model, section);
  if (!(fraction >= 0.0 && fraction <= 1.0)) {
    std::ostringstream text;
    text << "fraction must be 0 to 1, got " << fraction;
    throw py::value_error(text.str());
  }
}

VectorXd read_max_theta(const Model& model, const py::object& max_theta) {
  if (max_theta.is_none()) return {};
  const bool one = !py::hasattr(max_theta, "__len__") ||
                   (py::isinstance<py::array>(max_theta) &&
                    py::reinterpret_borrow<py::array>(max_theta).ndim() == 0);
  return one ? VectorXd(VectorXd::Constant(1, read_array(max_theta, "max_theta", {}).data()[0]))
             : VectorXd(*VectorArgument(max_theta, "max_theta", model.num_sections(), of_sections));
}

py::tuple find_bending(const Model& self, const py::object& p, const py::object& R,
                       const py::object& q0, const py::object& max_theta,
                       std::optional<double> orientation_weight, std::optional<double> tolerance,
                       int seeds, int iterations) {
  const Vector3d point(*VectorArgument(p, "p", 3));
  std::optional<Matrix3d> rotation;
  if (!R.is_none()) {
    const Array rows = read_array(R, "R", {3, 3});
    rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
  }
  const VectorXd start = q0.is_none() ? VectorXd() : VectorXd(*read_bending(self, q0, "q0"));
  InverseKinematicsOptions options;
  options.max_theta = read_max_theta(self, max_theta);
  options.orientation_weight = orientation_weight;
  options.tolerance = tolerance;
  options.seeds = seeds;
  options.iterations = iterations;
  Interruption interruption;
  options.stop = [&interruption] { return interruption(); };
  InverseKinematics answer;
  {
    const Unlocked unlocked;
    answer = inverse_kinematics(self, point, rotation, start, options);
  }
  interruption.raise();
  return py::make_tuple(to_array(answer.q), to_array(answer.position), to_rows(answer.rotation),
                        answer.distance, answer.angle, answer.residual, answer.reachable,
                        answer.seeds, answer.iterations, answer.message);
}

}  // namespace

void bind_kinematics(PyModel& model) {
  constexpr const char* frame =
      "R : (..., 3, 3) array\n"
      "    Rotation matrices; their columns are the axes of the frame [-].\n"
      "p : (..., 3) array\n"
      "    Positions [m].";
  model
      .def(
          "pose",
          [](const Model& self, const py::object& q, Index section, double fraction) {
            const States states{read_bendings(self, q)};
            check_place(self, section, fraction);
            return poses(states, [&](Index count, const StateRows& x, double* R, double* p) {
              pose(self, count, x, section, fraction, R, p);
            });
          },
          "q"_a, "section"_a, "fraction"_a,
          Doc("Frame of the backbone at a fraction of a section, in the base frame:\n"
              "cpp/README.md eqs. (2), (3).",
              {docs::q, docs::section, docs::fraction}, frame, docs::bad_states))
      .def(
          "tip",
          [](const Model& self, const py::object& q) {
            return poses(States{read_bendings(self, q)},
                         [&](auto... arguments) { tip(self, arguments...); });
          },
          "q"_a,
          Doc("Frame of the robot's tool in the base frame, of the end of the last section where\n"
              "there is none: cpp/several-sections.md eq. (49).",
              {docs::q}, frame, docs::bad_states))
      .def(
          "tips",
          [](const Model& self, const py::object& q) {
            return arrays(States{read_bendings(self, q)}, {3},
                          [&](Index count, const StateRows& x, double* p) {
                            tip(self, count, x, nullptr, p);
                          });
          },
          "q"_a,
          Doc("Tip positions alone, the p of `tip`.", {docs::q},
              "(..., 3) array\n    Positions in the base frame [m].", docs::bad_states))
      .def(
          "jacobian",
          [](const Model& self, const py::object& q, Index section, double fraction) {
            const States states{read_bendings(self, q)};
            check_place(self, section, fraction);
            return arrays(states, {6, self.num_coordinates()},
                          [&](Index count, const StateRows& x, double* J) {
                            jacobian(self, count, x, section, fraction, J);
                          });
          },
          "q"_a, "section"_a, "fraction"_a,
          Doc("Geometric Jacobian of a frame of the backbone, in the base frame: cpp/README.md\n"
              "eqs. (4), (5).",
              {docs::q, docs::section, docs::fraction},
              "(..., 6, d) array\n"
              "    Rows of the linear velocity [m/rad], then of the angular velocity [rad/rad].",
              docs::bad_states))
      .def(
          "tip_jacobian",
          [](const Model& self, const py::object& q) {
            return arrays(States{read_bendings(self, q)}, {6, self.num_coordinates()},
                          [&](Index count, const StateRows& x, double* J) {
                            tip_jacobian(self, count, x, J);
                          });
          },
          "q"_a,
          Doc("Geometric Jacobian of the frame that `tip` gives, in the base frame:\n"
              "cpp/several-sections.md eq. (50).",
              {docs::q},
              "(..., 6, d) array\n"
              "    Rows of the linear velocity [m/rad], then of the angular velocity [rad/rad].",
              docs::bad_states));
  constexpr const char* hessian =
      "(..., 6, d, d) array\n"
      "    Row, column and coordinate: of the linear velocity [m/rad^2], symmetric in the last "
      "two,\n"
      "    then of the angular velocity [rad/rad^2].";
  model
      .def(
          "kinematic_hessian",
          [](const Model& self, const py::object& q, Index section, double fraction) {
            const States states{read_bendings(self, q)};
            check_place(self, section, fraction);
            return hessians(self, states, [&](auto& x, auto& H) {
              kinematic_hessian(self, x, section, fraction, H);
            });
          },
          "q"_a, "section"_a, "fraction"_a,
          Doc("Derivatives of `jacobian` by the coordinates, exact: the formula after\n"
              "cpp/derivatives.md eq. (83).",
              {docs::q, docs::section, docs::fraction}, hessian, docs::bad_states))
      .def(
          "tip_hessian",
          [](const Model& self, const py::object& q) {
            return hessians(self, States{read_bendings(self, q)},
                            [&](auto& x, auto& H) { tip_hessian(self, x, H); });
          },
          "q"_a,
          Doc("Derivatives of `tip_jacobian` by the coordinates, exact: the formula\n"
              "after cpp/derivatives.md eq. (83).",
              {docs::q}, hessian, docs::bad_states));
  model.def("_inverse_kinematics", &find_bending, "p"_a, "R"_a, "q0"_a, py::kw_only(),
            "max_theta"_a, "orientation_weight"_a, "tolerance"_a, "seeds"_a, "iterations"_a,
            Doc("See cdcr.Model.inverse_kinematics."));
}

}  // namespace cdcr::python
