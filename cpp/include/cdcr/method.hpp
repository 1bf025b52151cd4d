#pragma once

#include "cdcr/export.hpp"

namespace CDCR_EXPORT cdcr {

/// How a robot is carried through time. rk4, rosenbrock: fixed step, explicit and linearly
/// implicit. dopri5, dop853: Dormand-Prince 5(4) and 8(5,3), adaptive. bdf, adams: CVODE
/// (cdcr/cvode.hpp). automatic: dop853, and bdf where stability alone would make its steps small.
enum class Method { rk4, dopri5, bdf, adams, dop853, automatic, rosenbrock };

}  // namespace CDCR_EXPORT cdcr
