#pragma once

#include "chain.hpp"

// Functions of a chain that are wanted in double precision alone.

namespace cdcr::detail {

/// The recursions of chain_forward.hpp and chain_inverse.hpp on doubles. Compiled apart: their
/// large frames would slow down the closed form beside them.
void forward_motion(const Chain& chain, const double* q, const double* qd, const double* force,
                    double* qdd) noexcept;
void inverse_motion(const Chain& chain, const double* q, const double* qd, const double* qdd,
                    double* force) noexcept;

/// Mass matrix (2n, 2n), by composite inertia from tip to base, eq. (34): O(n^2).
void mass_matrix(const Chain& chain, const double* q, MatrixRef M) noexcept;

[[nodiscard]] double kinetic_energy(const Chain& chain, const double* q, const double* qd) noexcept;
[[nodiscard]] double potential_energy(const Chain& chain, const double* q) noexcept;

/// The section nearest the tip whose bending, about the straight robot, moves no mass once the
/// sections beyond give way to it; -1 when there is none.
[[nodiscard]] Index find_singular_section(const Chain& chain);

}  // namespace cdcr::detail
