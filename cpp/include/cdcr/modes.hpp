#pragma once

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/wrench.hpp"

namespace CDCR_EXPORT cdcr {

/// Small vibrations about a shape, cpp/several-sections.md eqs. (44), (45).
struct Modes {
  VectorXd q;                    ///< the shape (d) [rad]
  VectorXd squared_frequency;    ///< w^2, increasing (d) [rad^2/s^2]; negative: unstable
  VectorXd frequency;            ///< w of the undamped robot (d) [rad/s]; 0 where w^2 <= 0
  MatrixXd shape;                ///< a column for each, phi^T M phi = 1 (d, d) [rad/(m sqrt(kg))]
  VectorXd damping_ratio;        ///< phi^T C phi/(2 w), 1 is critical (d); 0 where w^2 <= 0
  Eigen::VectorXcd eigenvalues;  ///< of the damped robot, by magnitude (2d) [1/s]
  bool stable = false;           ///< no w^2 <= 0, and no eigenvalue's real part positive
};

/// Natural frequencies and mode shapes of K phi = w^2 M phi about q, at rest or held there, and
/// the eigenvalues of A from linearize().
///
/// K is the static stiffness, springs of length-driven cables and wrenches included; where
/// wrenches make it unsymmetric, its symmetric part shapes the modes and the eigenvalues alone
/// tell all. C is what A says of damping, with friction as at rest. damping_ratio is that of the
/// eigenvalues as far as damping does not couple the modes. Throws std::invalid_argument for wrong
/// sizes, values that are not finite, a robot without inertia, a singular mass matrix and what
/// overflows.
[[nodiscard]] Modes modes(const Model& model, const VectorXd& q, const VectorXd& command,
                          const Wrenches& wrenches = no_wrenches());

}  // namespace CDCR_EXPORT cdcr
