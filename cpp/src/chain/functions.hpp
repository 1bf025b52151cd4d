#pragma once

#include "chain/chain.hpp"

// The recursions on doubles, for both kinds of section. Compiled apart: their large frames would
// slow down the closed form of one section beside them.

namespace cdcr::detail {

using MotionState = ArcChainState<double>;
using RodMotionState = RodChainState<double>;

/// The functions of ChainState.
template <class Section>
void update_position(const Chain& chain, ChainState<Section>& state, const double* q) noexcept;
template <class Section>
void update_velocity(const Chain& chain, ChainState<Section>& state, const double* qd) noexcept;
template <class Section>
void update_motion(const Chain& chain, ChainState<Section>& state, const double* q,
                   const double* qd) noexcept;

/// chain/forward.hpp and chain/inverse.hpp.
template <class Section>
void forward_motion(const Chain& chain, const ChainState<Section>& state, const double* force,
                    double* qdd) noexcept;
template <class Section>
void inverse_motion(const Chain& chain, const ChainState<Section>& state, const double* qdd,
                    double* force) noexcept;

/// chain/mass_matrix.hpp.
template <class Section>
void mass_matrix(const Chain& chain, const ChainState<Section>& state, MatrixRef M) noexcept;

/// chain/energy.hpp and chain/gradient.hpp.
template <class Section>
[[nodiscard]] double kinetic_energy(const Chain& chain, const ChainState<Section>& state,
                                    const double* qd) noexcept;
template <class Section>
[[nodiscard]] double potential_energy(const Chain& chain, const ChainState<Section>& state,
                                      const double* q) noexcept;
template <class Section>
void weight_gradient(const Chain& chain, const ChainState<Section>& state, const double* q,
                     double* gradient) noexcept;

/// The section nearest the tip some motion of which, about the straight robot, moves no mass once
/// the sections beyond give way to it; -1 when there is none.
[[nodiscard]] Index find_singular_section(const Chain& chain);

}  // namespace cdcr::detail
