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

/// In the shape wanted: a dimension of any size, and, at the front, any number of dimensions.
inline constexpr Index any_size = -1, leading = -2;

/// What the entries of an array's last dimension stand for: messages number it from 1, as in
/// "q[2] (section 2)". With a model, entries are its coordinates; else each is one of the nouns.
struct Entries {
  const char* noun = nullptr;
  const Model* model = nullptr;
};
inline constexpr Entries of_cables{"cable"}, of_sections{"section"};
[[nodiscard]] inline Entries of_coordinates(const Model& model) {
  return {"section", &model};
}

/// Reads an argument as finite float64 numbers of one shape, or raises ValueError naming the
/// argument, what was given and what is wanted.
[[nodiscard]] Array read_array(const py::handle& object, const char* name,
                               std::initializer_list<Index> shape, Entries entries = {});

/// A one-dimensional argument; keeps the array alive while the map is used.
class VectorArgument {
 public:
  VectorArgument(const py::handle& object, const char* name, Index size, Entries entries = {})
      : VectorArgument(read_array(object, name, {size}, entries)) {}
  explicit VectorArgument(Array array)
      : array_(std::move(array)), map_(array_.data(), array_.size()) {}

  [[nodiscard]] const Eigen::Map<const VectorXd>& operator*() const { return map_; }

 private:
  Array array_;
  Eigen::Map<const VectorXd> map_;
};

/// An argument of one state in its last dimension; those before count states.
struct StateArgument {
  StateArgument(const char* argument, const py::handle& object, Index state_size, Entries entries)
      : name(argument),
        size(state_size),
        array(read_array(object, name, {leading, size}, entries)) {}

  const char* name;
  Index size;
  Array array;
};

/// A bending vector (d): also refuses a section bent beyond max_bending.
[[nodiscard]] VectorArgument read_bending(const Model& model, const py::handle& object,
                                          const char* name);

/// Commands of the cables (num_cables), tensions or lengths: also refuses a negative one.
/// None stands for the command of the straight robot at rest: no tension, the straight lengths.
[[nodiscard]] py::object command_or_rest(const Model& model, const py::handle& object);
[[nodiscard]] VectorArgument read_tension(const Model& model, const py::handle& object,
                                          const char* name = "tension");

/// The same of arrays of states: any leading dimensions go before the last one.
[[nodiscard]] StateArgument read_bendings(const Model& model, const py::handle& object);
[[nodiscard]] StateArgument read_rates(const Model& model, const py::handle& object,
                                       const char* name);
[[nodiscard]] StateArgument read_tensions(const Model& model, const py::handle& object);

/// What a user's function gives as commands (size): also refuses a negative one.
[[nodiscard]] VectorArgument read_command(const py::handle& object, const char* name, Index size);

/// Raises ValueError where a model has no section of that index.
void check_section(const Model& model, Index section);

/// A model, or TypeError.
[[nodiscard]] const Model& read_model(const py::handle& object);

/// A sequence of cdcr.Wrench, or one, each constant and in its range.
[[nodiscard]] Wrenches read_wrenches(const Model& model, const py::object& object);

/// This thread's Data of a model, kept from call to call: a second function of the same state does
/// not compute it again. To be asked for where no Python runs until its use is over.
[[nodiscard]] Data& scratch(const Model& model);

/// Makes the C library keep what matrices leave as they come and go, where it is glibc: it would
/// hand pages back to the system and fetch them anew, which can cost half of what fills them.
void keep_freed_memory();

/// "[1, 0.5]" with the first few numbers, for a repr.
[[nodiscard]] std::string short_text(const VectorXd& vector);

/// An array after nobody can write to it any more.
[[nodiscard]] py::array_t<double> read_only(py::array_t<double> array);

/// A copy of an array of one dimension that `to_array` has made.
[[nodiscard]] VectorXd to_vector(const py::handle& array);
[[nodiscard]] py::array_t<double> to_array(const Eigen::Ref<const VectorXd>& vector);
[[nodiscard]] py::array_t<double> to_rows(const RowMatrixXd& matrix);

}  // namespace cdcr::python
