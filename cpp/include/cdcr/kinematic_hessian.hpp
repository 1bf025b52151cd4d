#pragma once

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// How the Jacobian of a frame of the backbone (cdcr/kinematics.hpp) changes with q: dJ(r, c)/dq_k
/// at H(r, d c + k), (6, d^2); exact, the last formula of cpp/derivatives.md. The first three rows
/// are second derivatives of the position, symmetric in c and k; those of the angular velocity are
/// not. Real-time safe.
void kinematic_hessian(const Model& model, const ConstVectorRef& q, Index section, double fraction,
                       MatrixRef H) noexcept;

/// The same of the frame that tip() gives.
void tip_hessian(const Model& model, const ConstVectorRef& q, MatrixRef H) noexcept;

}  // namespace CDCR_EXPORT cdcr
