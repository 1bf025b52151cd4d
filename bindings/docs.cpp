#include "docs.hpp"

#include <cstring>

namespace cdcr::python {
namespace {

namespace py = pybind11;

void add_section(std::string& text, const std::string& title, const std::string& body) {
  if (body.empty()) return;
  text += "\n\n" + title + "\n" + std::string(title.size(), '-') + "\n" + body;
  text.resize(text.find_last_not_of('\n') + 1);
}

/// A default as a literal, which is all that inspect.signature() reads.
std::string literal(const py::handle& value) {
  const std::string text = py::repr(value);
  return text == "inf" ? "1e999" : text;
}

}  // namespace

Doc::Doc(const std::string& summary, std::initializer_list<const char*> parameters,
         const std::string& returns, const std::string& raises)
    : text_(summary) {
  std::string all;
  for (const char* parameter : parameters) all += parameter;
  add_section(text_, "Parameters", all);
  add_section(text_, "Returns", returns);
  add_section(text_, "Raises", raises);
}

std::string Doc::render(const py::detail::function_record& function) const {
  std::string text = function.name;
  text += function.is_method && function.args.empty() ? "(self" : "(";
  for (std::size_t i = 0; i < function.args.size(); ++i) {
    const py::detail::argument_record& argument = function.args[i];
    if (i > 0) text += ", ";
    if (i == function.nargs_pos) text += "*, ";
    text += argument.name;
    if (argument.value) text += "=" + literal(argument.value);
  }
  return text + ")\n--\n\n" + text_;
}

void show_constructors(const py::module_& m) {
  const py::cpp_function signature([](const py::object& cls) {
    const py::object all = py::module_::import("inspect").attr("signature")(cls.attr("__init__"));
    const py::list parameters(all.attr("parameters").attr("values")());
    return all.attr("replace")(py::arg("parameters") =
                                   parameters[py::slice(1, {}, {})]);  // without self
  });
  const py::handle type(
      reinterpret_cast<PyObject*>(py::detail::get_internals().static_property_type));
  const py::object property = type(signature, py::none(), py::none(), "");
  for (const auto& item : py::dict(m.attr("__dict__"))) {
    if (!PyType_Check(item.second.ptr())) continue;
    const py::object constructor = item.second.attr("__dict__").attr("get")("__init__");
    // Where the core alone makes objects, pybind11 leaves a slot that refuses.
    if (constructor.is_none() || Py_IS_TYPE(constructor.ptr(), &PyWrapperDescr_Type)) continue;
    py::setattr(item.second, "__signature__", property);
  }
}

void show_getters(const py::module_& m) {
  for (const auto& item : py::dict(m.attr("__dict__"))) {
    if (!PyType_Check(item.second.ptr())) continue;
    for (const py::handle of_class : item.second.attr("__dict__").attr("values")()) {
      if (!PyObject_TypeCheck(of_class.ptr(), &PyProperty_Type)) continue;
      const py::object text = of_class.attr("__doc__"), fget = of_class.attr("fget");
      const py::handle getter = py::detail::get_function(fget);
      if (text.is_none() || !PyCFunction_Check(getter.ptr())) continue;
      PyMethodDef* const made = reinterpret_cast<PyCFunctionObject*>(getter.ptr())->m_ml;
      // pybind11 frees it with the function.
      if (made->ml_doc == nullptr) made->ml_doc = strdup(text.cast<std::string>().c_str());
    }
  }
}

}  // namespace cdcr::python
