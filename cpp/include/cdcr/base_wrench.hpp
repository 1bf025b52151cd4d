#pragma once

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/types.hpp"
#include "cdcr/wrench.hpp"

namespace CDCR_EXPORT cdcr {

/// Force [N] and moment [N m] (6) of the robot on its base, in the base frame, the moment about
/// base_position, cpp/base-wrench.md eq. (123): at rest its weight and the wrenches on it.
///
/// The drives of the cables stand on that base too, so their tensions count by the motion alone
/// that they make. Of (q, qd) and accelerations qdd, beside wrenches that validate() accepts.
/// Real-time safe.
void base_wrench(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const ConstVectorRef& qdd, const Wrenches& wrenches, VectorRef wrench) noexcept;

}  // namespace CDCR_EXPORT cdcr
