#pragma once

#include "chain/chain.hpp"

// The recursions on doubles. Compiled apart: their large frames would slow down the closed form of
// one section beside them.

namespace cdcr::detail {

using MotionState = ArcChainState<double>;

/// chain/forward.hpp and chain/inverse.hpp.
void forward_motion(const Chain& chain, const MotionState& state, const double* force,
                    double* qdd) noexcept;
void inverse_motion(const Chain& chain, const MotionState& state, const double* qdd,
                    double* force) noexcept;

/// chain/mass_matrix.hpp.
void mass_matrix(const Chain& chain, const MotionState& state, MatrixRef M) noexcept;

/// chain/energy.hpp and chain/gradient.hpp.
[[nodiscard]] double kinetic_energy(const Chain& chain, const MotionState& state,
                                    const double* qd) noexcept;
[[nodiscard]] double potential_energy(const Chain& chain, const MotionState& state,
                                      const double* q) noexcept;
void potential_gradient(const Chain& chain, const MotionState& state, const double* q,
                        double* gradient) noexcept;

/// The section nearest the tip whose bending, about the straight robot, moves no mass once the
/// sections beyond give way to it; -1 when there is none.
[[nodiscard]] Index find_singular_section(const Chain& chain);

}  // namespace cdcr::detail
