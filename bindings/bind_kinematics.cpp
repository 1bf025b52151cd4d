#include <pybind11/stl.h>

#include <optional>
#include <sstream>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/inverse_kinematics.hpp"

namespace cdcr::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

py::tuple to_tuple(const Pose& pose) {
  return py::make_tuple(to_rows(pose.R), to_array(pose.p));
}

void check_place(const Model& model, Index section, double fraction) {
  if (section < 0 || section >= model.num_sections()) {
    throw py::value_error("section must be 0 to " + std::to_string(model.num_sections() - 1) +
                          ", got " + std::to_string(section));
  }
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
             : VectorXd(*VectorArgument(max_theta, "max_theta", model.num_sections()));
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
  InverseKinematics answer;
  {
    const py::gil_scoped_release unlocked;
    answer = inverse_kinematics(self, point, rotation, start, options);
  }
  return py::make_tuple(to_array(answer.q), to_array(answer.position), to_rows(answer.rotation),
                        answer.distance, answer.angle, answer.residual, answer.reachable,
                        answer.seeds, answer.iterations, answer.message);
}

}  // namespace

void bind_kinematics(PyModel& model) {
  model
      .def(
          "pose",
          [](const Model& self, const py::object& q, Index section, double fraction) {
            const VectorArgument bending = read_bending(self, q, "q");
            check_place(self, section, fraction);
            return to_tuple(pose(self, *bending, section, fraction));
          },
          "q"_a, "section"_a, "fraction"_a)
      .def(
          "tip",
          [](const Model& self, const py::object& q) {
            return to_tuple(tip(self, *read_bending(self, q, "q")));
          },
          "q"_a)
      .def(
          "tips",
          [](const Model& self, const py::object& q) {
            const Array rows = read_array(q, "q", {-1, self.num_coordinates()});
            RowMatrixXd tips(rows.shape(0), 3);
            {
              const py::gil_scoped_release unlocked;
              const Index m = self.num_coordinates();
              for (Index i = 0; i < tips.rows(); ++i) {
                const Eigen::Map<const VectorXd> row(rows.data() + i * m, m);
                tips.row(i) = tip(self, row).p.transpose();
              }
            }
            return to_rows(tips);
          },
          "q"_a)
      .def(
          "jacobian",
          [](const Model& self, const py::object& q, Index section, double fraction) {
            const VectorArgument bending = read_bending(self, q, "q");
            check_place(self, section, fraction);
            MatrixXd J(6, self.num_coordinates());
            jacobian(self, *bending, section, fraction, J);
            return to_rows(J);
          },
          "q"_a, "section"_a, "fraction"_a)
      .def(
          "cable_lengths",
          [](const Model& self, const py::object& q) {
            VectorXd lengths(self.num_cables());
            cable_lengths(self, *read_bending(self, q, "q"), lengths);
            return to_array(lengths);
          },
          "q"_a);
  model.def("_inverse_kinematics", &find_bending, "p"_a, "R"_a, "q0"_a, py::kw_only(),
            "max_theta"_a, "orientation_weight"_a, "tolerance"_a, "seeds"_a, "iterations"_a);
}

}  // namespace cdcr::python
