#include "pickling.hpp"

namespace cdcr::python {

void finish_pickling(const py::module_& m) {
  // Never freed: as long as the module, and a lambda may copy it.
  const py::handle new_object =
      py::object(py::module_::import("copyreg").attr("__newobj__")).release();
  const py::cpp_function reduce(
      [new_object](const py::object& self) {
        return py::make_tuple(new_object, py::make_tuple(py::type::of(self)),
                              self.attr("__getstate__")());
      },
      py::name("__reduce__"), py::is_method(py::none()));
  const py::cpp_function refuse(
      [](const py::object& self) -> py::object {
        throw py::type_error("a cdcr " + py::type::of(self).attr("__name__").cast<std::string>() +
                             " can be neither pickled nor copied: make another of what it was "
                             "made of");
      },
      py::name("__reduce__"), py::is_method(py::none()));
  for (const auto& item : py::dict(m.attr("__dict__"))) {
    if (!PyType_Check(item.second.ptr())) continue;
    const py::handle bound = item.second;
    if (!py::isinstance(bound, py::type::handle_of(py::type::of<Model>())))
      continue;  // an enumeration
    const bool picklable = bound.attr("__dict__").contains("__setstate__");
    py::setattr(bound, "__reduce__", picklable ? reduce : refuse);
  }
}

}  // namespace cdcr::python
