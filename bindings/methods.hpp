#pragma once

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

}  // namespace cdcr::python
