#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/coordinates.hpp"
#include "docs.hpp"

namespace cdcr::python {

namespace py = pybind11;
using namespace py::literals;

void bind_coordinates(py::module_& m) {
  m.def(
      "polar_along",
      [](const py::object& q) {
        const Array array = read_array(q, "q", {any_size, any_size});
        if (array.shape(1) % 2 != 0) {
          throw py::value_error("q must have two columns for each section, got " +
                                std::to_string(array.shape(1)) + " columns");
        }
        const Eigen::Map<const RowMatrixXd> rows(array.data(), array.shape(0), array.shape(1));
        RowMatrixXd theta, phi;
        polar_along(rows, theta, phi);
        return py::make_tuple(to_rows(theta), to_rows(phi));
      },
      "q"_a,
      Doc("Polar form of bending vectors along a run, phi continuous: cpp/README.md eq. (1).",
          {"q : (N, 2n) array_like\n    Bending vectors of one sample in each row [rad].\n"},
          "theta, phi : (N, n) array\n    Bending and orientation angles [rad].",
          docs::bad_argument));
}

}  // namespace cdcr::python
