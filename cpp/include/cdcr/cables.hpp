#pragma once

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/types.hpp"

// What cables do to the robot, cpp/several-sections.md eqs. (36) to (39).
//
// command: one for each cable (num_cables): its tension [N] when it is driven by tension, its
// length [m] when it is driven by length. All functions are real-time safe; sizes are the caller's
// duty.

namespace CDCR_EXPORT cdcr {

/// B of Q = B F at q (d, num_cables) [m], eq. (6); the same at all q for straight cables and
/// sections of constant curvature.
void actuation_matrix(const Model& model, const ConstVectorRef& q, MatrixRef B) noexcept;

/// Generalised force Q = B F (d) [N m] of the tensions, were there no friction.
void actuation_force(const Model& model, const ConstVectorRef& tension, VectorRef force) noexcept;

/// Tensions at the base (num_cables) [N]: the command itself, or the pull of the cable's spring,
/// F = max(0, k (l - l_commanded) + d dl/dt).
void cable_tensions(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                    const ConstVectorRef& command, VectorRef tension) noexcept;

/// Generalised force (d) [N m] of the cables, friction in their holes included.
void cable_force(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const ConstVectorRef& command, VectorRef force) noexcept;

/// Pull of one length-driven cable [N], k (l - l_commanded) + d dl/dt; slack where negative.
[[nodiscard]] double cable_pull(const Model& model, Index cable, const ConstVectorRef& q,
                                const ConstVectorRef& qd, double command) noexcept;

/// Tensions along the cables (n + 1, num_cables) [N]: at the base, then beyond each section, where
/// friction has left less or, when the cable slides out, added to it; zero beyond its own end.
void tensions_along(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                    const ConstVectorRef& command, MatrixRef tension) noexcept;

/// What friction turns into heat [W], -F.dl/dt - Q.qd: never negative, but for rounding.
[[nodiscard]] double friction_power(const Model& model, const ConstVectorRef& q,
                                    const ConstVectorRef& qd,
                                    const ConstVectorRef& command) noexcept;

/// Energy in the springs of length-driven cables, sum k max(0, l - l_commanded)^2 / 2 [J].
[[nodiscard]] double cable_energy(const Model& model, const ConstVectorRef& q,
                                  const ConstVectorRef& command) noexcept;

/// Command that leaves the straight robot alone: no tension, straight lengths (num_cables).
void rest_command(const Model& model, VectorRef command) noexcept;

}  // namespace CDCR_EXPORT cdcr
