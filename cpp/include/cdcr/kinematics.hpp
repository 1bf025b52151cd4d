#pragma once

#include "cdcr/model.hpp"
#include "cdcr/types.hpp"

// Constant-curvature kinematics, cpp/README.md eqs. (2) to (7). Base frame: origin at the base,
// Z along the straight robot. Real-time safe where it says so; section and fraction are the
// caller's duty: 0 <= section < num_sections, 0 <= fraction <= 1.

namespace cdcr {

/// Where a frame is: p_BF [m] and R_BF, seen from the base B.
struct Pose {
  Matrix3d R = Matrix3d::Identity();
  Vector3d p = Vector3d::Zero();
};

/// Frame of the backbone at a fraction of a section's length, eqs. (2), (3). Real-time safe.
[[nodiscard]] Pose pose(const Model& model, const ConstVectorRef& q, Index section,
                        double fraction) noexcept;

/// Frame at the end of the last section. Real-time safe.
[[nodiscard]] Pose tip(const Model& model, const ConstVectorRef& q) noexcept;

/// Jacobian (6, 2n) of that frame: linear velocity rows, then angular velocity rows, both in the
/// base frame, eq. (5). Real-time safe.
void jacobian(const Model& model, const ConstVectorRef& q, Index section, double fraction,
              MatrixRef J) noexcept;

/// Lengths of the cables inside the robot (num_cables) [m], eq. (6). Real-time safe.
void cable_lengths(const Model& model, const ConstVectorRef& q, VectorRef lengths) noexcept;

/// The bending vector that brings the tip to a point, or as near as one section can come.
struct InverseKinematics {
  Eigen::Vector2d q = Eigen::Vector2d::Zero();  ///< [rad]
  Vector3d position = Vector3d::Zero();         ///< tip position reached [m]
  double distance = 0.0;                        ///< from the point asked for [m]
  bool reachable = false;                       ///< distance is rounding error only
};

/// Closed-form inverse kinematics of a one-section robot, eq. (7).
///
/// The tip of one section moves on a surface. A point on it has theta = 2 atan2(|p_xy|, p_z); for
/// any other point the nearest point of the surface is found. Searches 0 <= theta <= 2 pi. Where
/// the direction is free (a point on the Z axis), phi = 0 is taken. Real-time safe.
[[nodiscard]] InverseKinematics inverse_kinematics(const Model& model, const Vector3d& p) noexcept;

}  // namespace cdcr
