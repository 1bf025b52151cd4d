#pragma once

#include <pybind11/pybind11.h>

#include <utility>

#include "arrays.hpp"

namespace cdcr::python {

/// Lets objects of a class be pickled and copied: `take` gives the tuple of which `make` makes
/// another. Attributes that Python has added go along.
template <class Bound, class Take, class Make>
void make_picklable(Bound& bound, Take take, Make make) {
  using T = typename Bound::type;
  bound.def(py::pickle(
      [take](const py::object& self) {
        return py::make_tuple(take(self.cast<const T&>()),
                              py::getattr(self, "__dict__", py::dict()));
      },
      [make](const py::tuple& state) {
        return std::make_pair(make(state[0].cast<py::tuple>()), state[1].cast<py::dict>());
      }));
}

/// Of all classes of a module: those made picklable are so in every protocol of pickle, the others
/// refuse with a sentence.
void finish_pickling(const py::module_& m);

}  // namespace cdcr::python
