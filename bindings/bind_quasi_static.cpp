#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/quasi_static.hpp"
#include "docs.hpp"
#include "gil.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

namespace {

py::array_t<int> sliding_of(const QuasiStatic& found) {
  const py::ssize_t rows = found.tension.rows(), cables = found.tension.cols();
  py::array_t<int> out({rows, cables});
  for (py::ssize_t i = 0; i < rows * cables; ++i) {
    out.mutable_data()[i] = static_cast<int>(found.sliding[static_cast<std::size_t>(i)]);
  }
  return out;
}

py::dict follow(const Model& model, const py::object& commands, const py::object& q0,
                const py::object& deflection, const py::object& felt, const py::object& wrenches) {
  const Array rows = read_array(commands, "command", {any_size, model.num_cables()}, of_cables);
  const RowMatrixXd asked =
      Eigen::Map<const RowMatrixXd>(rows.data(), rows.shape(0), rows.shape(1));
  QuasiStaticStart start;
  if (!q0.is_none()) start.q = *read_bending(model, q0, "q0");
  const Index m = model.num_cables();
  if (!deflection.is_none()) start.deflection = *VectorArgument(deflection, "deflection", m);
  if (!felt.is_none()) start.felt = *VectorArgument(felt, "felt", m);
  const Wrenches loads = read_wrenches(model, wrenches);
  Interruption interruption;
  QuasiStatic found;
  {
    const Unlocked unlocked;
    found = quasi_static(model, asked, start, loads, [&] { return interruption(); });
  }
  if (found.status == Status::interrupted) interruption.raise();
  py::dict out;
  out["q"] = to_rows(found.q);
  out["tension"] = to_rows(found.tension);
  out["end_tension"] = to_rows(found.end_tension);
  out["friction"] = to_rows(found.friction);
  out["deflection"] = to_rows(found.deflection);
  out["felt"] = to_rows(found.felt);
  out["sliding"] = sliding_of(found);
  out["iterations"] = found.iterations;
  out["status"] = found.status;
  out["message"] = found.message;
  return out;
}

}  // namespace

void bind_quasi_static(py::module_& m) {
  m.def("quasi_static", &follow, "model"_a, "commands"_a, "q0"_a, "deflection"_a, "felt"_a,
        "wrenches"_a,
        Doc("Rest after rest under commands followed slowly; see cdcr.quasi_static.",
            {docs::model,
             "commands : (T, num_cables) array_like\n    Tensions [N], lengths [m].\n"
             "q0 : (d,) array_like or None\n    Where to start [rad].\n"
             "deflection, felt : (num_cables,) array_like or None\n"
             "    Of a run before: deflections [m], and commands behind the play of drives.\n",
             docs::wrenches},
            "dict\n    The fields of cdcr.QuasiStatic.", docs::bad_argument));
}

}  // namespace cdcr::python
