#include <pybind11/numpy.h>

#include <algorithm>

#include "bind.hpp"
#include "dynamics/parts.hpp"

namespace cdcr::python {

namespace py = pybind11;

namespace {

template <int N>
py::array_t<double> as_array(const detail::PolynomialTable<N>& table) {
  py::array_t<double> all({detail::num_pieces, detail::num_powers, N});
  double* to = all.mutable_data();
  for (int piece = 0; piece < detail::num_pieces; ++piece) {
    const double* from = table.piece(piece);
    to = std::copy(from, from + std::ptrdiff_t{detail::num_powers} * N, to);
  }
  return all;
}

}  // namespace

void bind_tables(PyModel& model) {
  model.def(
      "_tables",
      [](const Model& self) {
        py::list shapes;
        for (const auto& section : detail::chain_of(self).sections) {
          shapes.append(as_array(*section.table));
        }
        return py::make_tuple(as_array(detail::arc_table()), shapes);
      },
      "Functions of sigma of an arc and of each section, [piece][power][function]; of arcs alone.");
}

}  // namespace cdcr::python
