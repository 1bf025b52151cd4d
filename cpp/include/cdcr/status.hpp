#pragma once

#include <functional>

#include "cdcr/export.hpp"

namespace CDCR_EXPORT cdcr {

/// Asked now and then by what may take long; true ends it, with status interrupted.
using Interrupt = std::function<bool()>;

/// How a computation ended. Anything but ok leaves the last good state in place.
enum class Status {
  ok,
  not_started,        ///< no state has been set yet
  step_limit,         ///< more internal steps than max_steps
  step_too_small,     ///< the step shrank to rounding level
  tolerance_not_met,  ///< the implicit solver's iteration failed to converge
  non_finite_state,   ///< NaN or infinity in the state
  bending_limit,      ///< a section bent beyond max_bending
  invalid_tension,    ///< wrong number of tensions, a negative or a non-finite one
  not_converged,      ///< an equilibrium search ended without an answer
  interrupted,        ///< stopped by the caller
  event,              ///< stopped by an event that ends the run
  wrong_size,         ///< a vector that does not fit the robot
  invalid_wrench,     ///< a wrench beyond the robot, or not finite
  compression_limit,  ///< a section compressed below a tenth of its length
};

/// One sentence: what happened and what to try next; empty for ok. Real-time safe.
[[nodiscard]] const char* message(Status status) noexcept;

/// The enumerator's own name, such as "step_limit". Real-time safe.
[[nodiscard]] const char* name(Status status) noexcept;

}  // namespace CDCR_EXPORT cdcr
