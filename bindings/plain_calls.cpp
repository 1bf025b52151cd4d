#include "plain_calls.hpp"

#include <pybind11/numpy.h>

#include <string>

namespace cdcr::python {
namespace {

namespace py = pybind11;
using Call = PyObject* (*)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*);

Call dispatcher = nullptr;            // of pybind11, the same for all functions
py::handle functions;                 // a dict by their records, which are all that a call is given
PyTypeObject* truth_value = nullptr;  // of NumPy

/// Sets a TypeError that says what is wrong with a call.
void explain(PyObject* record, PyObject* const* values, Py_ssize_t num_positional,
             PyObject* names) {
  try {
    py::tuple args(num_positional);
    for (Py_ssize_t i = 0; i < num_positional; ++i) args[i] = py::handle(values[i]);
    py::dict kwargs;
    for (Py_ssize_t i = 0; names != nullptr && i < PyTuple_GET_SIZE(names); ++i) {
      kwargs[PyTuple_GET_ITEM(names, i)] = py::handle(values[num_positional + i]);
    }
    const py::object sentence =
        py::module_::import("cdcr.base.calls").attr("explain")(functions[record], args, kwargs);
    PyErr_SetObject(PyExc_TypeError, sentence.ptr());
  } catch (py::error_already_set& other) {
    other.restore();
  } catch (const std::exception& other) {
    PyErr_SetString(PyExc_TypeError, other.what());
  }
}

/// Whether words are in the error that is set.
bool error_has(const char* words) {
  py::error_already_set error;
  bool has = false;
  try {
    has = py::str(error.value()).contains(words);
  } catch (const py::error_already_set&) {  // an error that has no words
    has = false;
  }
  error.restore();
  return has;
}

/// Whether it is a text in an array without dimensions, or a truth value, which Python and NumPy
/// read as numbers.
bool is_no_number(PyObject* value) {
  if (PyFloat_CheckExact(value)) return false;
  if (PyBool_Check(value) || Py_IS_TYPE(value, truth_value)) return true;
  if (!py::isinstance<py::array>(value)) return false;
  const auto array = py::reinterpret_borrow<py::array>(value);
  const char kind = array.dtype().kind();
  return array.ndim() == 0 && (kind == 'U' || kind == 'S' || kind == 'b');
}

/// Whether an argument of a function is one number, by what pybind11 has written of it; else it
/// stands for an array, which the function looks at, or is a switch.
bool is_number(PyObject* record, Py_ssize_t i, Py_ssize_t num_positional, PyObject* names) {
  const py::detail::function_record* known = py::detail::function_record_ptr_from_PyObject(record);
  const auto place = static_cast<std::size_t>(i);
  if (known == nullptr || (i < num_positional && place >= known->args.size())) return false;
  const char* name = i < num_positional
                         ? known->args[place].name
                         : PyUnicode_AsUTF8(PyTuple_GET_ITEM(names, i - num_positional));
  if (name == nullptr) {  // no text in UTF-8 either
    PyErr_Clear();
    return false;
  }
  const std::string signature = known->signature, wanted = name + std::string(": typing.Supports");
  return signature.find(" " + wanted) != std::string::npos ||
         signature.find("(" + wanted) != std::string::npos;
}

PyObject* call(PyObject* record, PyObject* const* values, Py_ssize_t num_positional,
               PyObject* names) {
  const Py_ssize_t num_named = names == nullptr ? 0 : PyTuple_GET_SIZE(names);
  for (Py_ssize_t i = 0; i < num_positional + num_named; ++i) {
    if (!is_no_number(values[i]) || !is_number(record, i, num_positional, names)) continue;
    explain(record, values, num_positional, names);
    return nullptr;
  }
  PyObject* result = nullptr;
  try {
    result = dispatcher(record, values, num_positional, names);
  } catch (py::error_already_set& other) {  // a name that is no text in UTF-8
    other.restore();
  }
  if (result == nullptr && PyErr_ExceptionMatches(PyExc_TypeError) != 0 &&
      error_has("(): incompatible ")) {
    PyErr_Clear();
    explain(record, values, num_positional, names);
  }
  return result;
}

template <class To, class From>
To function_cast(From from) {
  return reinterpret_cast<To>(reinterpret_cast<void (*)()>(from));
}

void wrap(const py::handle& item) {
  const py::handle inner = py::detail::get_function(item);
  if (!inner || PyCFunction_Check(inner.ptr()) == 0) return;
  PyMethodDef* definition = reinterpret_cast<PyCFunctionObject*>(inner.ptr())->m_ml;
  const auto own = function_cast<Call>(definition->ml_meth);
  if (dispatcher == nullptr) dispatcher = own;
  if (own != dispatcher) return;  // not pybind11's, or wrapped already
  functions[PyCFunction_GET_SELF(inner.ptr())] = item;
  definition->ml_meth = function_cast<PyCFunction>(call);
}

}  // namespace

void tell_calls_plainly(const py::module_& m) {
  functions = py::dict().release();  // never freed: as long as the module
  const py::object type = py::module_::import("numpy").attr("bool_");
  truth_value = reinterpret_cast<PyTypeObject*>(type.inc_ref().ptr());
  for (const auto& item : py::dict(m.attr("__dict__"))) {
    wrap(item.second);
    if (!PyType_Check(item.second.ptr())) continue;
    for (const auto& member : py::dict(item.second.attr("__dict__"))) {
      const bool is_static = Py_IS_TYPE(member.second.ptr(), &PyStaticMethod_Type);
      wrap(is_static ? py::object(member.second.attr("__func__")) : member.second);
    }
  }
}

}  // namespace cdcr::python
