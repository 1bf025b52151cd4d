#pragma once

#include <pybind11/pybind11.h>

#include <initializer_list>
#include <string>

namespace cdcr::python {

/// Documentation of a bound function, after its arguments in `def`: a text in numpydoc's form.
/// In front of it the signature is written as CPython reads it into __text_signature__, where
/// inspect.signature() looks.
class Doc {
 public:
  explicit Doc(std::string text) : text_(std::move(text)) {}
  Doc(const std::string& summary, std::initializer_list<const char*> parameters,
      const std::string& returns = "", const std::string& raises = "");

  [[nodiscard]] std::string render(const pybind11::detail::function_record& function) const;

 private:
  friend struct pybind11::detail::process_attribute<Doc>;
  std::string text_;
  mutable std::string rendered_;  // lives as long as `def` runs, which makes a copy
};

/// Lets inspect.signature() of every class of a module, and of what Python derives from it, be
/// that of the constructor.
void show_constructors(const pybind11::module_& m);

/// Gives the getters of properties the words of these, so that help of either has them.
void show_getters(const pybind11::module_& m);

/// What many functions take; d is the model's num_coordinates.
namespace docs {

inline constexpr const char* q =
    "q : (..., d) array_like\n"
    "    Bending vectors, base to tip [rad].\n";
inline constexpr const char* qd =
    "qd : (..., d) array_like\n"
    "    Their rates [rad/s].\n";
inline constexpr const char* tension =
    "tension : (..., num_cables) array_like\n"
    "    Cable tensions [N]; lengths [m] for cables driven by length.\n";
inline constexpr const char* tension_or_rest =
    "tension : (..., num_cables) array_like, optional\n"
    "    Cable tensions [N]; lengths [m] for cables driven by length; by default `rest_command`.\n";
inline constexpr const char* wrenches =
    "wrenches : Wrench or sequence of Wrench, optional\n"
    "    Constant forces [N] and moments [N m] on the backbone, the same for all states.\n";
inline constexpr const char* section =
    "section : int\n"
    "    Index of the section, 0 at the base.\n";
inline constexpr const char* fraction =
    "fraction : float\n"
    "    Fraction of the section's length, 0 to 1.\n";
inline constexpr const char* model =
    "model : Model\n"
    "    The robot.\n";
/// One state only.
inline constexpr const char* one_q =
    "q : (d,) array_like\n"
    "    Bending vectors, base to tip [rad].\n";
inline constexpr const char* one_qd =
    "qd : (d,) array_like\n"
    "    Their rates [rad/s].\n";
inline constexpr const char* one_tension =
    "tension : (num_cables,) array_like\n"
    "    Cable tensions [N]; lengths [m] for cables driven by length.\n";

inline constexpr const char* bad_states =
    "ValueError\n"
    "    Naming the argument that is not finite, out of its range or of another shape, or whose\n"
    "    leading dimensions do not broadcast.\n";
inline constexpr const char* bad_argument =
    "ValueError\n"
    "    Naming the argument that is not finite, out of its range or of another shape.\n";

}  // namespace docs
}  // namespace cdcr::python

namespace pybind11::detail {

template <>
struct process_attribute<cdcr::python::Doc> : process_attribute_default<cdcr::python::Doc> {
  static void init(const cdcr::python::Doc& doc, function_record* function) {
    doc.rendered_ = doc.render(*function);
    function->doc = doc.rendered_.data();
  }
};

}  // namespace pybind11::detail
