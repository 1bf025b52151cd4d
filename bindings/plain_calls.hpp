#pragma once

#include <pybind11/pybind11.h>

namespace cdcr::python {

/// Lets every function and constructor of a module say in a sentence which argument is missing or
/// of another kind (cdcr.base.calls), where pybind11 would list the types that it takes.
void tell_calls_plainly(const pybind11::module_& m);

}  // namespace cdcr::python
