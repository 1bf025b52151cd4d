#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>

#include "cdcr/integrator.hpp"

#ifdef CDCR_WITH_CVODE
#include "cdcr/cvode.hpp"
#endif

namespace cdcr::python {

namespace py = pybind11;

#ifdef CDCR_WITH_CVODE
inline constexpr bool with_cvode = true;
inline constexpr auto* make_any_integrator = make_cvode_integrator;
#else
inline constexpr bool with_cvode = false;
inline constexpr auto* make_any_integrator = make_integrator;
#endif

/// The method of a simulator, by its name.
inline Method read_fixed_step(const py::handle& name) {
  if (name.equal(py::str("rk4"))) return Method::rk4;
  if (name.equal(py::str("rosenbrock"))) return Method::rosenbrock;
  const auto shown = py::module_::import("reprlib").attr("repr")(name).cast<std::string>();
  throw std::invalid_argument("method must be 'rk4' or 'rosenbrock', got " + shown);
}
inline const char* fixed_step_name(Method method) {
  return method == Method::rk4 ? "rk4" : "rosenbrock";
}

}  // namespace cdcr::python
