#pragma once

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/total_force.hpp"
#include "cdcr/types.hpp"
#include "cdcr/wrench.hpp"

// Equations of motion  M(q) qdd + h(q, qd) = Q: cpp/README.md eqs. (8) to (16) for one section,
// cpp/several-sections.md eqs. (23) to (34) for several, O(n), the mass matrix O(n^2).
//
// q, qd, qdd: bending vectors and their rates, base to tip, (d) with d = num_coordinates
// [rad], [rad/s], [rad/s^2].
// tension: one command for each cable (num_cables): its tension [N], or its length [m] where it is
// driven by length (cdcr/cables.hpp). Outputs are written to caller-owned storage.
// Every function here is real-time safe: no allocation, no exception, no I/O. Sizes are the
// caller's duty; a non-finite input, or a section bent beyond max_bending, gives NaN.

namespace CDCR_EXPORT cdcr {

/// Mass matrix M(q) (d, d) [kg m^2].
void mass_matrix(const Model& model, Data& data, const ConstVectorRef& q, MatrixRef M) noexcept;

/// Bias h(q, qd) (d) [N m]: Coriolis, damping, elastic and gravity terms.
void bias(const Model& model, Data& data, const ConstVectorRef& q, const ConstVectorRef& qd,
          VectorRef h) noexcept;

/// Accelerations under the given tensions, and wrenches that validate() accepts.
void forward_dynamics(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& tension,
                      VectorRef qdd) noexcept;
void forward_dynamics(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& tension,
                      const Wrenches& wrenches, VectorRef qdd) noexcept;

/// Accelerations under a generalised force (d) [N m].
void forward_dynamics_force(const Model& model, Data& data, const ConstVectorRef& q,
                            const ConstVectorRef& qd, const ConstVectorRef& force,
                            VectorRef qdd) noexcept;

/// Vectors of many states: that of state i begins at data + i * apart.
struct StateRows {
  const double* data = nullptr;
  Index apart = 0;  ///< 0: the same for all
};
/// Accelerations (count, d), row-major, of many states under tensions: as of each by itself, to
/// rounding, but several at once where the robot is of arcs and its cables are has_plain_cables().
/// Allocates.
void forward_dynamics(const Model& model, Data& data, Index count, const StateRows& q,
                      const StateRows& qd, const StateRows& tension, double* qdd);

/// Generalised force (d) [N m] that produces the given accelerations.
void inverse_dynamics(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& qdd,
                      VectorRef force) noexcept;

/// The same beside wrenches that validate() accepts, which give their part of it.
void inverse_dynamics(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& qdd, const Wrenches& wrenches,
                      VectorRef force) noexcept;

/// T = 1/2 qd^T M qd [J].
[[nodiscard]] double kinetic_energy(const Model& model, Data& data, const ConstVectorRef& q,
                                    const ConstVectorRef& qd) noexcept;

/// Elastic energy plus weight, the latter zero at the base: U = K |q|^2 / 2 - sum m g.r [J].
[[nodiscard]] double potential_energy(const Model& model, Data& data,
                                      const ConstVectorRef& q) noexcept;

/// Gradient dU/dq (d) [N m]: the generalised force that holds the robot still at q.
void potential_gradient(const Model& model, Data& data, const ConstVectorRef& q,
                        VectorRef gradient) noexcept;

/// Hessian d2U/dq2 (d, d) [N m/rad]: the stiffness about q.
void potential_hessian(const Model& model, Data& data, const ConstVectorRef& q,
                       MatrixRef hessian) noexcept;

}  // namespace CDCR_EXPORT cdcr
