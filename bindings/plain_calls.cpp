#include "plain_calls.hpp"

#include <string>

namespace cdcr::python {
namespace {

namespace py = pybind11;
using Call = PyObject* (*)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*);

Call dispatcher = nullptr;  // of pybind11, the same for all functions
py::handle functions;       // a dict by their records, which are all that a call is given

/// Replaces an error that lists types by a sentence.
void explain(PyObject* record, PyObject* const* values, Py_ssize_t num_positional,
             PyObject* names) {
  py::error_already_set error;
  try {
    const std::string message = py::str(error.value());
    if (message.find("(): incompatible ") == std::string::npos) return error.restore();
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
  }
}

PyObject* call(PyObject* record, PyObject* const* values, Py_ssize_t num_positional,
               PyObject* names) {
  PyObject* result = dispatcher(record, values, num_positional, names);
  if (result == nullptr && PyErr_ExceptionMatches(PyExc_TypeError) != 0) {
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
