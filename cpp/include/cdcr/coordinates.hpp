#pragma once

#include "cdcr/export.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// Bending angle theta >= 0 and orientation angle phi in (-pi, pi] [rad] of one bending vector.
struct Polar {
  double theta = 0.0;
  double phi = 0.0;  ///< 0 for the straight section, which has no direction
};

/// Polar form of q = theta (cos phi, sin phi), cpp/README.md eq. (1).
[[nodiscard]] Polar polar(double q_x, double q_y) noexcept;

/// Bending vector theta (cos phi, sin phi) (2) [rad]; theta may be negative.
[[nodiscard]] Eigen::Vector2d bending(double theta, double phi) noexcept;

/// Polar form along a run: rows of q (N, d) to theta and phi (N, n), phi continuous in time.
///
/// Full turns are undone, and where the section swings through straight theta changes its sign
/// rather than phi jumping by pi; so theta may be negative, and bending(theta, phi) is still q.
/// A straight sample keeps the phi of the sample before it. Starts with theta >= 0.
void polar_along(const RowMatrixXd& q, RowMatrixXd& theta, RowMatrixXd& phi);

}  // namespace CDCR_EXPORT cdcr
