#pragma once

#include "cdcr/export.hpp"
#include "cdcr/integrator.hpp"

namespace CDCR_EXPORT cdcr {

/// All methods: bdf and adams by CVODE, automatic with that bdf, the others by make_integrator. In
/// target cdcr::cvode.
///
/// bdf, of order 1 to 5, keeps its large steps under any damping. adams, of order 1 to 12, needs
/// fewer and dearer steps, and is the more accurate of the two where the robot swings freely. Both
/// solve each step by Newton's method with the exact Jacobian, and start from a first step of their
/// own, so a run does not depend on where it is sampled; both go by the error of one step, and
/// the errors of many steps add up to far more than rtol.
///
/// Set up: throws std::invalid_argument for options out of range, allocates. Run: after the first
/// step nothing more is allocated, restart included, and nothing is ever printed. restart throws
/// std::invalid_argument for a y of the wrong size or t_stop <= t, interpolate for a time outside
/// the last step. What the input's function throws leaves restart and step as it is; the state is
/// then the last good one. After an exception or a failure, restart before the next step.
[[nodiscard]] std::unique_ptr<Integrator> make_cvode_integrator(RobotOde& ode, Method method,
                                                                const Options& options);

}  // namespace CDCR_EXPORT cdcr
