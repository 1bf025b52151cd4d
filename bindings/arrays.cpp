#include "arrays.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace cdcr::python {
namespace {

template <class Sizes>
std::string shape_text(const Sizes& sizes) {
  std::string text = "(";
  for (const Index size : sizes) {
    if (text.size() > 1) text += ", ";
    text += size < 0 ? std::string("any") : std::to_string(size);
  }
  return text + (sizes.size() == 1 ? ",)" : ")");
}

/// "[1]" or "[0, 1]" for the flat index of an entry.
std::string index_text(Index flat, const std::vector<Index>& sizes) {
  std::string text;
  for (std::size_t i = sizes.size(); i-- > 0;) {
    if (!text.empty()) text.insert(0, ", ");
    text.insert(0, std::to_string(flat % sizes[i]));
    flat /= sizes[i];
  }
  return "[" + text + "]";
}

[[noreturn]] void refuse(const std::ostringstream& text) {
  throw py::value_error(text.str());
}

Array convert(const py::handle& object, const char* name, std::initializer_list<Index> shape) {
  // An array that is already right is taken as it is, past the conversion.
  if (Array::check_(object)) return py::reinterpret_borrow<Array>(object);
  try {
    return Array(py::reinterpret_borrow<py::object>(object));
  } catch (const py::error_already_set& error) {
    // Ctrl-C may strike in the middle of a conversion, and is not the argument's fault.
    if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) throw;
  }
  std::ostringstream text;
  text << name << " must be numbers of shape " << shape_text(shape) << ", got "
       << py::str(py::type::of(object).attr("__name__")).cast<std::string>();
  refuse(text);
}

}  // namespace

Array read_array(const py::handle& object, const char* name, std::initializer_list<Index> shape) {
  const Array array = convert(object, name, shape);
  const bool fits =
      std::equal(shape.begin(), shape.end(), array.shape(), array.shape() + array.ndim(),
                 [](Index wanted, Index got) { return wanted < 0 || wanted == got; });
  const auto got = [&array] {
    return std::vector<Index>(array.shape(), array.shape() + array.ndim());
  };
  if (!fits) {
    std::ostringstream text;
    text << name << " must have shape " << shape_text(shape) << ", got " << shape_text(got());
    refuse(text);
  }
  const double* data = array.data();
  for (Index i = 0; i < array.size(); ++i) {
    if (std::isfinite(data[i])) continue;
    std::ostringstream text;
    text << name << index_text(i, got()) << " must be finite, got " << data[i];
    refuse(text);
  }
  return array;
}

VectorArgument read_bending(const Model& model, const py::handle& object, const char* name) {
  VectorArgument q(object, name, model.num_coordinates());
  for (Index i = 0; i < model.num_sections(); ++i) {
    const double theta = (*q).segment<2>(2 * i).norm();
    if (theta <= max_bending) continue;
    std::ostringstream text;
    text << name << " must bend each section by at most 3 pi rad, got " << theta
         << " rad in section " << i + 1;
    refuse(text);
  }
  return q;
}

VectorArgument read_tension(const Model& model, const py::handle& object) {
  VectorArgument tension(object, "tension", model.num_cables());
  for (Index j = 0; j < model.num_cables(); ++j) {
    if ((*tension)[j] >= 0.0) continue;
    std::ostringstream text;
    text << "tension[" << j << "] must be >= 0 ";
    if (model.cables()[static_cast<std::size_t>(j)].length_driven()) {
      text << "m (the length commanded of a length-driven cable)";
    } else {
      text << "N (a cable cannot push)";
    }
    text << ", got " << (*tension)[j];
    refuse(text);
  }
  return tension;
}

py::array_t<double> to_array(const Eigen::Ref<const VectorXd>& vector) {
  return py::array_t<double>(vector.size(), vector.data());
}

py::array_t<double> to_rows(const RowMatrixXd& matrix) {
  return py::array_t<double>({matrix.rows(), matrix.cols()}, matrix.data());
}

}  // namespace cdcr::python
