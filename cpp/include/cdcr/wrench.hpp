#pragma once

#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/status.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// A force and a moment on the backbone at a fraction of a section's length.
struct Wrench {
  /// base: keeps its direction in the base frame. local: turns with the backbone where it acts.
  enum class Frame { base, local };

  Index section = 0;
  double fraction = 1.0;               ///< 0 to 1
  Vector3d force = Vector3d::Zero();   ///< [N]
  Vector3d moment = Vector3d::Zero();  ///< about the point where the force acts [N m]
  Frame frame = Frame::base;
};

using Wrenches = std::vector<Wrench>;

/// An empty list.
[[nodiscard]] const Wrenches& no_wrenches() noexcept;

/// Throws std::invalid_argument with a sentence that names the wrench, what is wrong with it and
/// what is allowed.
void validate(const Model& model, const Wrenches& wrenches);
/// ok, or invalid_wrench where validate() throws. Real-time safe.
[[nodiscard]] Status check_wrenches(const Model& model, const Wrenches& wrenches) noexcept;

/// Adds the generalised force (d) [N m] of the wrenches, eq. (35), to `force`. Real-time
/// safe for wrenches that validate() accepts.
void add_wrench_force(const Model& model, const ConstVectorRef& q, const Wrenches& wrenches,
                      VectorRef force) noexcept;

}  // namespace CDCR_EXPORT cdcr
