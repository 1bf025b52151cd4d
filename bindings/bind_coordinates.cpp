#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/coordinates.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

void bind_coordinates(py::module_& m) {
  m.def(
      "polar_along",
      [](const py::object& q) {
        const Array array = read_array(q, "q", {-1, -1});
        if (array.shape(1) % 2 != 0) {
          throw py::value_error("q must have two columns for each section, got " +
                                std::to_string(array.shape(1)) + " columns");
        }
        const Eigen::Map<const RowMatrixXd> rows(array.data(), array.shape(0), array.shape(1));
        RowMatrixXd theta, phi;
        polar_along(rows, theta, phi);
        return py::make_tuple(to_rows(theta), to_rows(phi));
      },
      "q"_a, "theta and phi (N, n) [rad] along a run q (N, 2n), phi continuous.");
}

}  // namespace cdcr::python
