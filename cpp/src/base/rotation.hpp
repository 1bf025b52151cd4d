#pragma once

#include <Eigen/Geometry>

#include "cdcr/types.hpp"

namespace cdcr::detail {

/// What a rotation may miss: the digits of single precision, or six printed ones.
inline constexpr double rotation_digits = 1e-5;

/// Largest entry of R^T R - I; infinite or not a number where R is.
[[nodiscard]] inline double skew_of(const Matrix3d& R) {
  const Matrix3d excess = R.transpose() * R - Matrix3d::Identity();
  return excess.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

/// The rotation nearest to one that misses a few digits; R itself where it is one to rounding.
[[nodiscard]] inline Matrix3d nearest_rotation(const Matrix3d& R) {
  if (skew_of(R) <= 4e-16) return R;
  return Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

/// Axis times angle, at most pi. Real-time safe.
[[nodiscard]] inline Vector3d rotation_vector(const Matrix3d& R) noexcept {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

/// The rotation that a rotation vector stands for. Real-time safe.
[[nodiscard]] inline Matrix3d rotation_of(const Vector3d& v) noexcept {
  const double angle = v.norm();
  if (angle == 0.0) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, v / angle).toRotationMatrix();
}

}  // namespace cdcr::detail
