#include "arrays.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <vector>

#include "bind.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/robot_ode.hpp"
#include "docs.hpp"
#include "states.hpp"

namespace cdcr::python {
namespace {

/// The sizes of an array's dimensions.
std::vector<Index> sizes_of(const Array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

/// "(4, 2)", as Python writes it; for what is wanted also "any" and "...".
std::string shape_text(const std::vector<Index>& sizes) {
  std::string text = "(";
  for (const Index size : sizes) {
    if (text.size() > 1) text += ", ";
    text += size == leading ? "..." : size == any_size ? "any" : std::to_string(size);
  }
  return text + (sizes.size() == 1 ? ",)" : ")");
}

/// The number, from 1, of what entry k of a dimension stands for.
Index number_of(Index k, const Entries& entries) {
  if (entries.model == nullptr) return k + 1;
  Index section = 0;
  while (section + 1 < entries.model->num_sections() &&
         entries.model->first_coordinate(section + 1) <= k) {
    ++section;
  }
  return section + 1;
}

/// "[1]" or "[0, 1]" for the flat index of an entry, and " (cable 2)" for what that is; nothing
/// where there are no dimensions.
std::string index_text(Index flat, const std::vector<Index>& sizes, const Entries& entries = {}) {
  if (sizes.empty()) return "";
  std::ostringstream named;
  if (entries.noun != nullptr) {
    named << " (" << entries.noun << " " << number_of(flat % sizes.back(), entries) << ")";
  }
  std::string text;
  for (std::size_t i = sizes.size(); i-- > 0;) {
    if (!text.empty()) text.insert(0, ", ");
    text.insert(0, std::to_string(flat % sizes[i]));
    flat /= sizes[i];
  }
  return "[" + text + "]" + named.str();
}

[[noreturn]] void refuse(const std::ostringstream& text) {
  throw py::value_error(text.str());
}

/// An attribute of NumPy, held for as long as the process lives.
py::handle held(const char* name) {
  return py::getattr(py::module_::import("numpy"), name).release();
}

/// Whether an array masks entries, or one in lists within lists does.
bool is_masked(const py::handle& object, int depth = 0) {
  constexpr int deepest = 64;  // dimensions that NumPy can count
  if (depth < deepest && (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object))) {
    return std::any_of(object.begin(), object.end(),
                       [depth](const py::handle& item) { return is_masked(item, depth + 1); });
  }
  return py::isinstance<py::array>(object) && py::hasattr(object, "mask") &&
         object.attr("mask").attr("any")().cast<bool>();
}

bool holds_reals(const py::array& array) {
  const char kind = array.dtype().kind();
  return kind == 'f' || kind == 'i' || kind == 'u' || kind == 'b';
}

/// Whether Python takes an object for a real number of its own accord: no text, no complex number,
/// no duration, although NumPy makes numbers of them.
bool is_real(const py::handle& item) {
  static const py::handle scalar = held("generic");
  if (py::isinstance<py::array>(item) || py::isinstance(item, scalar)) {
    return holds_reals(py::array(py::reinterpret_borrow<py::object>(item)));
  }
  const PyNumberMethods* methods = Py_TYPE(item.ptr())->tp_as_number;
  return methods != nullptr && (methods->nb_float != nullptr || methods->nb_index != nullptr);
}

/// What entries other than real numbers are, as in "complex128"; nothing where there are none.
std::string other_entries(const py::array& array) {
  const char kind = array.dtype().kind();
  if (array.ndim() == 0 && kind == 'b') return "bool";
  if (holds_reals(array)) return "";
  if (kind == 'U' || kind == 'S') return "text";
  if (kind != 'O') return py::str(array.dtype().attr("name"));
  for (const py::handle item : array.attr("flat")) {
    if (!is_real(item)) return py::str(py::type::of(item).attr("__name__"));
  }
  return "";
}

Array convert(const py::handle& object, const char* name, std::initializer_list<Index> shape) {
  // An array that is already right is taken as it is, past the conversion.
  static const py::handle plain_array = held("ndarray");
  if (py::type::handle_of(object).is(plain_array)) {
    static const py::handle float64 = py::dtype::of<double>().release();
    const auto array = py::reinterpret_borrow<py::array>(object);
    const bool in_rows = (static_cast<unsigned>(array.flags()) & unsigned{py::array::c_style}) != 0;
    if (in_rows && array.dtype().is(float64)) {
      return py::reinterpret_borrow<Array>(object);
    }
  }
  std::string got = py::str(py::type::of(object).attr("__name__"));
  try {
    if (is_masked(object)) {
      got += " with masked entries";
    } else {
      const py::array array(py::reinterpret_borrow<py::object>(object));
      const std::string others = other_entries(array);
      if (others.empty()) return Array(array);
      if (array.ndim() > 0) got += " of " + others;
    }
  } catch (const py::error_already_set& error) {
    // Ctrl-C may strike in the middle of a conversion, and is not the argument's fault.
    if (error.matches(PyExc_OverflowError)) {
      got += " with a number too large for float64";
    } else if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) {
      throw;
    }
  }
  std::ostringstream text;
  text << name << " must be numbers";
  if (!(shape.size() == 1 && *shape.begin() == leading)) text << " of shape " << shape_text(shape);
  text << ", got " << got;
  refuse(text);
}

/// Refuses a shape that the model is not valid for, in any state.
void check_bending(const Model& model, const Array& q, const char* name) {
  const Index size = model.num_coordinates(), end = q.size();
  const double* data = q.data();
  for (Index first = 0; first < end; first += size) {
    const Eigen::Map<const VectorXd> state(data + first, size);
    if (check_shape(model, state) == Status::ok) continue;
    std::vector<Index> before = sizes_of(q);
    before.pop_back();
    require_shape((name + index_text(first / size, before)).c_str(), model, state);
  }
}

/// Refuses a negative command, in any state.
void check_tension(const Model& model, const Array& tension, const char* name) {
  const double* data = tension.data();
  for (Index i = 0, end = tension.size(); i < end; ++i) {
    if (data[i] >= 0.0) continue;
    const Index cable = i % model.num_cables();
    std::ostringstream text;
    text << name << index_text(i, sizes_of(tension), of_cables) << " must be >= 0 ";
    if (model.cables()[static_cast<std::size_t>(cable)].length_driven()) {
      text << "m (the length commanded of a length-driven cable)";
    } else {
      text << "N (a cable cannot push)";
    }
    text << ", got " << data[i];
    refuse(text);
  }
}

}  // namespace

Array read_array(const py::handle& object, const char* name, std::initializer_list<Index> shape,
                 Entries entries) {
  Array array = convert(object, name, shape);
  const bool stacked = shape.size() > 0 && *shape.begin() == leading;
  const Index before = stacked ? array.ndim() - static_cast<Index>(shape.size()) + 1 : 0;
  const bool fits = before >= 0 && std::equal(shape.begin() + (stacked ? 1 : 0), shape.end(),
                                              array.shape() + before, array.shape() + array.ndim(),
                                              [](Index wanted, Index got) {
                                                return wanted == any_size || wanted == got;
                                              });
  if (!fits) {
    std::ostringstream text;
    text << name << " must have shape " << shape_text(shape) << ", got "
         << shape_text(sizes_of(array));
    refuse(text);
  }
  const double* data = array.data();
  for (Index i = 0, end = array.size(); i < end; ++i) {
    if (std::isfinite(data[i])) continue;
    std::ostringstream text;
    text << name << index_text(i, sizes_of(array), entries) << " must be finite, got " << data[i];
    refuse(text);
  }
  return array;
}

VectorArgument read_bending(const Model& model, const py::handle& object, const char* name) {
  Array q = read_array(object, name, {model.num_coordinates()}, of_coordinates(model));
  check_bending(model, q, name);
  return VectorArgument(std::move(q));
}

VectorArgument read_command(const py::handle& object, const char* name, Index size) {
  Array command = read_array(object, name, {size}, of_cables);
  for (Index i = 0; i < size; ++i) {
    if (command.data()[i] >= 0.0) continue;
    std::ostringstream text;
    text << name << index_text(i, {size}, of_cables) << " must be >= 0 (a cable cannot push), got "
         << command.data()[i];
    refuse(text);
  }
  return VectorArgument(std::move(command));
}

void check_section(const Model& model, Index section) {
  if (section >= 0 && section < model.num_sections()) return;
  throw py::value_error("section must be 0 to " + std::to_string(model.num_sections() - 1) +
                        ", got " + std::to_string(section));
}

const Model& read_model(const py::handle& object) {
  if (py::isinstance<Model>(object)) return object.cast<const Model&>();
  throw py::type_error("model must be a cdcr.Model, got " +
                       py::type::of(object).attr("__name__").cast<std::string>());
}

py::object command_or_rest(const Model& model, const py::handle& object) {
  if (!object.is_none()) return py::reinterpret_borrow<py::object>(object);
  VectorXd command(model.num_cables());
  rest_command(model, command);
  return to_array(command);
}

VectorArgument read_tension(const Model& model, const py::handle& given, const char* name) {
  const py::object object = command_or_rest(model, given);
  Array tension = read_array(object, name, {model.num_cables()}, of_cables);
  check_tension(model, tension, name);
  return VectorArgument(std::move(tension));
}

StateArgument read_bendings(const Model& model, const py::handle& object) {
  StateArgument q("q", object, model.num_coordinates(), of_coordinates(model));
  check_bending(model, q.array, q.name);
  return q;
}

StateArgument read_rates(const Model& model, const py::handle& object, const char* name) {
  return {name, object, model.num_coordinates(), of_coordinates(model)};
}

StateArgument read_tensions(const Model& model, const py::handle& given) {
  const py::object object = command_or_rest(model, given);
  StateArgument tension("tension", object, model.num_cables(), of_cables);
  check_tension(model, tension.array, tension.name);
  return tension;
}

void refuse_leading(const StateArgument& argument, const std::vector<Index>& before) {
  std::ostringstream text;
  text << argument.name << " must have shape (..., " << argument.size
       << ") with leading dimensions that broadcast with " << shape_text(before) << ", got "
       << shape_text(sizes_of(argument.array));
  refuse(text);
}

void keep_freed_memory() {
  // The size of the largest block freed so far decides how much is kept: twice that (mallopt(3)).
  [[maybe_unused]] static const bool once = [] {
    constexpr std::size_t size = std::size_t{8} << 20U;
    void* volatile block = std::malloc(size);
    std::free(block);
    return true;
  }();
}

std::string short_text(const VectorXd& vector) {
  constexpr Index most = 6;
  std::ostringstream text;
  for (Index i = 0; i < std::min(most, vector.size()); ++i)
    text << (i > 0 ? ", " : "") << vector[i];
  return "[" + text.str() + (vector.size() > most ? ", ...]" : "]");
}

py::array_t<double> read_only(py::array_t<double> array) {
  // As setflags(write=False) does, in a tenth of its time.
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

VectorXd to_vector(const py::handle& array) {
  const auto values = array.cast<Array>();
  return Eigen::Map<const VectorXd>(values.data(), values.size());
}

py::array_t<double> to_array(const Eigen::Ref<const VectorXd>& vector) {
  return py::array_t<double>(vector.size(), vector.data());
}

py::array_t<double> to_rows(const RowMatrixXd& matrix) {
  return py::array_t<double>({matrix.rows(), matrix.cols()}, matrix.data());
}

void bind_arrays(py::module_& m) {
  m.def(
      "finite",
      [](const py::object& value, const std::string& name) {
        return read_array(value, name.c_str(), {leading});
      },
      py::arg("value"), py::arg("name"),
      Doc("A value as an array of finite numbers, float64 in the order of C.",
          {"value : (...) array_like\n    Real numbers of any type, in any unit [-].\n",
           "name : str\n    What a refusal calls it.\n"},
          "(...) array\n    In that unit [-]; the value itself where it is such an array.",
          docs::bad_argument));
  m.def(
      "numbers",
      [](const py::object& value, const std::string& name) {
        return convert(value, name.c_str(), {leading});
      },
      py::arg("value"), py::arg("name"),
      Doc("A value as `finite` has it, but for numbers that are not finite, which are taken.",
          {"value : (...) array_like\n    Real numbers of any type, in any unit [-].\n",
           "name : str\n    What a refusal calls it.\n"},
          "(...) array\n    In that unit [-].", docs::bad_argument));
}

Data& scratch(const Model& model) {
  thread_local std::optional<Data> data;
  if (!data || !data->belongs_to(model)) data.emplace(model);
  return *data;
}

}  // namespace cdcr::python
