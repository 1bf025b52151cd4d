#pragma once

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/types.hpp"

// Constant-curvature kinematics, cpp/README.md eqs. (2) to (6), seen from the base frame, in which
// the robot stands at base_position and base_orientation. Real-time safe where it says so; section
// and fraction are the caller's duty: 0 <= section < num_sections, 0 <= fraction <= 1.

namespace CDCR_EXPORT cdcr {

/// Where a frame is: p_BF [m] and R_BF, seen from the base B.
struct Pose {
  Matrix3d R = Matrix3d::Identity();
  Vector3d p = Vector3d::Zero();
};

/// Frame of the backbone at a fraction of a section's length, eqs. (2), (3). Real-time safe.
[[nodiscard]] Pose pose(const Model& model, const ConstVectorRef& q, Index section,
                        double fraction) noexcept;

/// Frame of the tool, at the end of the last section where there is none, eq. (49). Real-time safe.
[[nodiscard]] Pose tip(const Model& model, const ConstVectorRef& q) noexcept;

/// Jacobian (6, d) of a frame of the backbone: linear velocity rows, then angular velocity rows,
/// both in the base frame, eq. (5). Real-time safe.
void jacobian(const Model& model, const ConstVectorRef& q, Index section, double fraction,
              MatrixRef J) noexcept;

/// The same of the frame that tip() gives, eq. (50). Real-time safe.
void tip_jacobian(const Model& model, const ConstVectorRef& q, MatrixRef J) noexcept;

/// Lengths of the cables inside the robot (num_cables) [m], eq. (6). Real-time safe.
void cable_lengths(const Model& model, const ConstVectorRef& q, VectorRef lengths) noexcept;

}  // namespace CDCR_EXPORT cdcr
