#pragma once

#include "cdcr/cables.hpp"
#include "cdcr/export.hpp"
#include "cdcr/wrench.hpp"

namespace CDCR_EXPORT cdcr {

/// Generalised force (num_coordinates) [N m] of all cables and wrenches: the one force of every
/// right-hand side. command: as in cdcr/cables.hpp. Real-time safe.
void total_force(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const ConstVectorRef& command, const Wrenches& wrenches, VectorRef force) noexcept;

/// Whether that force depends on the command alone: then it holds as long as the command does.
[[nodiscard]] inline bool force_is_constant(const Model& model, const Wrenches& wrenches) noexcept {
  return model.has_plain_cables() && wrenches.empty();
}

}  // namespace CDCR_EXPORT cdcr
