#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace cdcr::python {

/// Takes objects as pybind11 does, but refuses those that `__new__` made and no `__init__` filled:
/// pybind11 would hand out memory that nobody has written to.
template <class T>
class InitialisedCaster : public pybind11::detail::type_caster_base<T> {
 public:
  bool load(pybind11::handle source, bool convert) {
    return this->template load_impl<InitialisedCaster>(source, convert);
  }

 private:
  friend class pybind11::detail::type_caster_generic;
  void load_value(pybind11::detail::value_and_holder found) {
    if (!found.instance_registered()) {
      const auto* type = Py_TYPE(reinterpret_cast<PyObject*>(found.inst));
      throw pybind11::type_error(std::string("this ") + type->tp_name +
                                 " is empty: its __init__ has not been called");
    }
    pybind11::detail::type_caster_generic::load_value(pybind11::detail::value_and_holder(found));
  }
};

}  // namespace cdcr::python

/// For every class that is bound, in a header that all who take it include.
#define CDCR_BOUND_CLASS(...)                      \
  template <>                                      \
  class pybind11::detail::type_caster<__VA_ARGS__> \
      : public cdcr::python::InitialisedCaster<__VA_ARGS__> {}
