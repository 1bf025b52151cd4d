#pragma once

#include "cdcr/dynamics.hpp"
#include "cdcr/export.hpp"
#include "cdcr/kinematics.hpp"

// Functions of one state, of many: as of each by itself, to rounding, but several at once, in the
// lanes of the processor's registers, where the robot is of arcs. They allocate. Answers are
// row-major, those of one state after those of another. Accelerations are in cdcr/dynamics.hpp.

namespace CDCR_EXPORT cdcr {

/// Generalised forces (count, d) that produce accelerations.
void inverse_dynamics(const Model& model, Data& data, Index count, const StateRows& q,
                      const StateRows& qd, const StateRows& qdd, double* force);
/// (count, d).
void bias(const Model& model, Data& data, Index count, const StateRows& q, const StateRows& qd,
          double* h);
/// (count, d, d).
void mass_matrix(const Model& model, Data& data, Index count, const StateRows& q, double* M);
/// (count).
void kinetic_energy(const Model& model, Data& data, Index count, const StateRows& q,
                    const StateRows& qd, double* energy);
/// (count).
void potential_energy(const Model& model, Data& data, Index count, const StateRows& q,
                      double* energy);
/// (count, d).
void potential_gradient(const Model& model, Data& data, Index count, const StateRows& q,
                        double* gradient);

/// R (count, 3, 3) and p (count, 3), of which null is left out.
void pose(const Model& model, Index count, const StateRows& q, Index section, double fraction,
          double* R, double* p);
void tip(const Model& model, Index count, const StateRows& q, double* R, double* p);
/// (count, 6, d).
void jacobian(const Model& model, Index count, const StateRows& q, Index section, double fraction,
              double* J);
void tip_jacobian(const Model& model, Index count, const StateRows& q, double* J);
/// (count, num_cables).
void cable_lengths(const Model& model, Index count, const StateRows& q, double* lengths);

}  // namespace CDCR_EXPORT cdcr
