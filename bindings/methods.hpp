#pragma once

#include <stdexcept>
#include <string>

#include "cdcr/integrator.hpp"

#ifdef CDCR_WITH_CVODE
#include "cdcr/cvode.hpp"
#endif

namespace cdcr::python {

#ifdef CDCR_WITH_CVODE
inline constexpr bool with_cvode = true;
inline constexpr auto* make_any_integrator = make_cvode_integrator;
#else
inline constexpr bool with_cvode = false;
inline constexpr auto* make_any_integrator = make_integrator;
#endif

/// The method of a simulator, by its name.
inline Method read_fixed_step(const std::string& name) {
  if (name != "rk4" && name != "rosenbrock") {
    throw std::invalid_argument("method must be 'rk4' or 'rosenbrock', got '" + name + "'");
  }
  return name == "rk4" ? Method::rk4 : Method::rosenbrock;
}
inline const char* fixed_step_name(Method method) {
  return method == Method::rk4 ? "rk4" : "rosenbrock";
}

}  // namespace cdcr::python
