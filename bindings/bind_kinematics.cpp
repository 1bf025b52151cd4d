#include <pybind11/stl.h>

#include <optional>
#include <sstream>

#include "bind.hpp"
#include "cdcr/inverse_kinematics.hpp"
#include "docs.hpp"
#include "gil.hpp"
#include "states.hpp"

namespace cdcr::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

/// R and p that `place` gives for each state.
template <class F>
py::tuple poses(const States<1>& states, F&& place) {
  py::array_t<double> all_R = states.output({3, 3}), all_p = states.output({3});
  double *R = all_R.mutable_data(), *p = all_p.mutable_data();
  states.each([&](Index i, const auto& x) {
    const Pose pose = place(x);
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R + 9 * i) = pose.R;
    Eigen::Map<Vector3d>(p + 3 * i) = pose.p;
  });
  return py::make_tuple(std::move(all_R), std::move(all_p));
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
  const bool one = !py::hasattr(max_theta, "__len__");
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
            return poses(states, [&](auto& x) { return pose(self, x, section, fraction); });
          },
          "q"_a, "section"_a, "fraction"_a,
          Doc("Frame of the backbone at a fraction of a section, in the base frame:\n"
              "cpp/README.md eqs. (2), (3).",
              {docs::q, docs::section, docs::fraction}, frame, docs::bad_states))
      .def(
          "tip",
          [](const Model& self, const py::object& q) {
            return poses(States{read_bendings(self, q)}, [&](auto& x) { return tip(self, x); });
          },
          "q"_a,
          Doc("Frame of the robot's tool in the base frame, of the end of the last section where\n"
              "there is none: cpp/several-sections.md eq. (49).",
              {docs::q}, frame, docs::bad_states))
      .def(
          "tips",
          [](const Model& self, const py::object& q) {
            return States{read_bendings(self, q)}.vectors(
                3, [&](auto& x, auto& p) { p = tip(self, x).p; });
          },
          "q"_a,
          Doc("Tip positions alone, the p of `tip`.", {docs::q},
              "(..., 3) array\n    Positions in the base frame [m].", docs::bad_states))
      .def(
          "jacobian",
          [](const Model& self, const py::object& q, Index section, double fraction) {
            const States states{read_bendings(self, q)};
            check_place(self, section, fraction);
            return states.matrices(6, self.num_coordinates(), [&](auto& x, auto& J) {
              jacobian(self, x, section, fraction, J);
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
            return States{read_bendings(self, q)}.matrices(
                6, self.num_coordinates(), [&](auto& x, auto& J) { tip_jacobian(self, x, J); });
          },
          "q"_a,
          Doc("Geometric Jacobian of the frame that `tip` gives, in the base frame:\n"
              "cpp/several-sections.md eq. (50).",
              {docs::q},
              "(..., 6, d) array\n"
              "    Rows of the linear velocity [m/rad], then of the angular velocity [rad/rad].",
              docs::bad_states));
  model.def("_inverse_kinematics", &find_bending, "p"_a, "R"_a, "q0"_a, py::kw_only(),
            "max_theta"_a, "orientation_weight"_a, "tolerance"_a, "seeds"_a, "iterations"_a,
            Doc("See cdcr.Model.inverse_kinematics."));
}

}  // namespace cdcr::python
