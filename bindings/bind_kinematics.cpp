#include <sstream>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/kinematics.hpp"

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
          "q"_a)
      .def(
          "_inverse_kinematics",
          [](const Model& self, const py::object& p) {
            const VectorArgument point(p, "p", 3);
            const InverseKinematics answer = inverse_kinematics(self, Vector3d(*point));
            return py::make_tuple(to_array(answer.q), to_array(answer.position), answer.distance,
                                  answer.reachable);
          },
          "p"_a);
}

}  // namespace cdcr::python
