#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <utility>

#include "arrays.hpp"
#include "bind.hpp"
#include "cdcr/gain.hpp"
#include "cdcr/reference_path.hpp"
#include "cdcr/tracking_controller.hpp"

namespace cdcr::python {

/// A controller that knows the model and the options as Python has them.
template <class Law>
class Tracking final : public Law {
 public:
  template <class Options>
  Tracking(py::object of, py::dict given, Options read)
      : Law(read_model(of), std::move(read)), model(std::move(of)), options(std::move(given)) {}

  py::object model;
  py::dict options;
};

/// A gain: a number, one for each component, or a matrix.
[[nodiscard]] Gain read_gain(const py::dict& options, const char* name);
/// Any option that pybind11 converts.
template <class T>
[[nodiscard]] T read_option(const py::dict& options, const char* name) {
  return options[name].cast<T>();
}
/// A vector, empty where it is None.
[[nodiscard]] VectorXd read_vector(const py::dict& options, const char* name, Index size,
                                   Entries entries);
/// min_tension, max_tension, pretension, cables, max_rate.
[[nodiscard]] CommandLimits read_limits(const Model& model, const py::dict& options);

[[nodiscard]] py::tuple take_path(const ReferencePath& path);
[[nodiscard]] ReferencePath put_path(const py::tuple& parts);

}  // namespace cdcr::python
