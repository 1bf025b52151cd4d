#pragma once

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/status.hpp"
#include "cdcr/wrench.hpp"

namespace CDCR_EXPORT cdcr {

/// A point of rest and whether the robot stays there.
struct Equilibrium {
  VectorXd q;            ///< (d) [rad]
  VectorXd tension;      ///< what the cables pull with there (num_cables) [N]
  VectorXd eigenvalues;  ///< of the stiffness at q, their real parts, increasing (d) [N m/rad]
  bool stable = false;   ///< all of these positive; neutral counts as not stable
  bool friction_left_out = false;  ///< cables rub, so it rests anywhere in a range of shapes; this
                                   ///< is the one without friction
  double residual = 0.0;           ///< largest component of dU/dq - Q [N m]
  int iterations = 0;              ///< Newton steps, in all searches made
  int load_steps = 0;              ///< steps of the load from nothing to all; 0: found without
  int searches = 0;                ///< places started from
  Status status = Status::not_converged;
};

/// Equilibrium dU/dq = Q under constant commands and wrenches, cpp/README.md eq. (18).
///
/// command (num_cables): tensions [N], lengths [m] for cables driven by length. At rest nothing
/// slides, so friction has no direction: this is the equilibrium without friction.
///
/// Newton's method, made to go downhill in energy, so from almost any start it ends in a minimum;
/// where a load has no energy (a wrench that follows the backbone, a moment), downhill in the
/// unbalanced moment. A start that is itself a point of rest is returned even when it is unstable,
/// as the upright robot with a heavy payload is. Starts from q0 (d), or from K^-1 B F when q0 is
/// empty; if that fails, the load grows from nothing step by step, then other starts are tried.
/// A robot that buckles is an answer; none within max_bending is a status.
///
/// WrenchInput without an energy make the stiffness unsymmetric. Its eigenvalues then tell
/// divergence alone; for flutter see modes(). Throws std::invalid_argument for wrong sizes, a
/// negative or a non-finite command, and wrenches that validate() refuses.
[[nodiscard]] Equilibrium equilibrium(const Model& model, const VectorXd& command,
                                      const VectorXd& q0 = {},
                                      const Wrenches& wrenches = no_wrenches());

/// Stiffness d(dU/dq - Q)/dq (d, d) [N m/rad] of the robot at rest in q, springs of
/// length-driven cables and wrenches included. Real-time safe.
void static_stiffness(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& command, const Wrenches& wrenches,
                      MatrixRef K) noexcept;
/// The same without room of one's own: it allocates where the model has rods.
void static_stiffness(const Model& model, const ConstVectorRef& q, const ConstVectorRef& command,
                      const Wrenches& wrenches, MatrixRef K) noexcept;

/// Whether all wrenches have an energy: forces that keep their direction, and no moments.
[[nodiscard]] bool conservative(const Wrenches& wrenches) noexcept;

}  // namespace CDCR_EXPORT cdcr
