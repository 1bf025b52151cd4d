#pragma once

#include "cdcr/model.hpp"
#include "cdcr/types.hpp"

namespace cdcr {

/// State (q, qd) and tension to state rate, about one point: d(state)/dt = A state + B tension.
///
/// A (4n, 4n) and B (4n, num_cables) are the exact derivatives of forward_dynamics
/// (cpp/README.md eq. (19)), at any state, at rest or moving. Real-time safe.
void linearize(const Model& model, Data& data, const ConstVectorRef& q, const ConstVectorRef& qd,
               const ConstVectorRef& tension, MatrixRef A, MatrixRef B) noexcept;

/// A alone, under a generalised force (2n) [N m]: the Jacobian of the equations of motion.
void state_jacobian(const Model& model, Data& data, const ConstVectorRef& q,
                    const ConstVectorRef& qd, const ConstVectorRef& force, MatrixRef A) noexcept;

}  // namespace cdcr
