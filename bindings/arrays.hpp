#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <initializer_list>
#include <string>

#include "cdcr/model.hpp"
#include "cdcr/wrench.hpp"

namespace cdcr::python {

namespace py = pybind11;
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Reads an argument as finite float64 numbers of one shape, or raises ValueError naming the
/// argument, what was given and what is wanted. A dimension of -1 takes any size.
[[nodiscard]] Array read_array(const py::handle& object, const char* name,
                               std::initializer_list<Index> shape);

/// A one-dimensional argument; keeps the array alive while the map is used.
class VectorArgument {
 public:
  VectorArgument(const py::handle& object, const char* name, Index size)
      : array_(read_array(object, name, {size})), map_(array_.data(), array_.size()) {}

  [[nodiscard]] const Eigen::Map<const VectorXd>& operator*() const { return map_; }

 private:
  Array array_;
  Eigen::Map<const VectorXd> map_;
};

/// A bending vector (2n): also refuses a section bent beyond max_bending.
[[nodiscard]] VectorArgument read_bending(const Model& model, const py::handle& object,
                                          const char* name);

/// Commands of the cables (num_cables), tensions or lengths: also refuses a negative one.
[[nodiscard]] VectorArgument read_tension(const Model& model, const py::handle& object);

/// A sequence of cdcr.Wrench, or one, each constant and in its range.
[[nodiscard]] Wrenches read_wrenches(const Model& model, const py::object& object);

[[nodiscard]] py::array_t<double> to_array(const Eigen::Ref<const VectorXd>& vector);
[[nodiscard]] py::array_t<double> to_rows(const RowMatrixXd& matrix);

}  // namespace cdcr::python
