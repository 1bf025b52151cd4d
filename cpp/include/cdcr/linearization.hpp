#pragma once

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/types.hpp"
#include "cdcr/wrench.hpp"

namespace CDCR_EXPORT cdcr {

/// State (q, qd) and command to state rate, about one point: d(state)/dt = A state + B command.
///
/// A (2d, 2d) and B (2d, num_cables) are the exact derivatives of forward_dynamics
/// (cpp/README.md eq. (19)), at any state, at rest or moving, through cables and wrenches too. At
/// the kinks of a cable (just slack; friction at a straight section) one side is taken. Real-time
/// safe.
void linearize(const Model& model, Data& data, const ConstVectorRef& q, const ConstVectorRef& qd,
               const ConstVectorRef& command, const Wrenches& wrenches, MatrixRef A,
               MatrixRef B) noexcept;
void linearize(const Model& model, Data& data, const ConstVectorRef& q, const ConstVectorRef& qd,
               const ConstVectorRef& command, MatrixRef A, MatrixRef B) noexcept;

/// A alone: the Jacobian of the equations of motion.
void state_jacobian(const Model& model, Data& data, const ConstVectorRef& q,
                    const ConstVectorRef& qd, const ConstVectorRef& command,
                    const Wrenches& wrenches, MatrixRef A) noexcept;
/// The same under a further, constant generalised force `added` (d) [N m].
void state_jacobian_force(const Model& model, Data& data, const ConstVectorRef& q,
                          const ConstVectorRef& qd, const ConstVectorRef& command,
                          const Wrenches& wrenches, const ConstVectorRef& added,
                          MatrixRef A) noexcept;

/// d(qdd)/dq and d(qdd)/dqd (d, d), d(qdd)/d(command) (d, num_cables), and d(qdd)/d(wrenches)
/// (d, 6 wrenches.size()): of each wrench by its force and by its moment, in its own frame. All of
/// them exact, as those of linearize(). Real-time safe.
void acceleration_derivatives(const Model& model, Data& data, const ConstVectorRef& q,
                              const ConstVectorRef& qd, const ConstVectorRef& command,
                              const Wrenches& wrenches, MatrixRef on_q, MatrixRef on_qd,
                              MatrixRef on_command, MatrixRef on_wrenches) noexcept;

}  // namespace CDCR_EXPORT cdcr
