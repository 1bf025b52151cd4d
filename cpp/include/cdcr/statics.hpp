#pragma once

#include "cdcr/model.hpp"
#include "cdcr/status.hpp"

namespace cdcr {

/// A point of rest and whether the robot stays there.
struct Equilibrium {
  VectorXd q;             ///< (2n) [rad]
  VectorXd eigenvalues;   ///< of the stiffness d2U/dq2 at q, increasing (2n) [N m/rad]
  bool stable = false;    ///< all eigenvalues positive; neutral counts as not stable
  double residual = 0.0;  ///< largest component of dU/dq - B F [N m]
  int iterations = 0;
  Status status = Status::not_converged;
};

/// Equilibrium under constant tensions (num_cables) [N], dU/dq = B F, cpp/README.md eq. (18).
///
/// Newton's method on the potential energy, made to go downhill everywhere, so from almost any
/// start it ends in a minimum. A start that is itself a point of rest is returned even when it is
/// unstable, as the upright robot with a heavy payload is. Starts from q0 (2n), or from
/// K^-1 B F when q0 is empty. Throws std::invalid_argument for wrong sizes, a negative or a
/// non-finite tension.
[[nodiscard]] Equilibrium equilibrium(const Model& model, const VectorXd& tension,
                                      const VectorXd& q0 = {});

}  // namespace cdcr
