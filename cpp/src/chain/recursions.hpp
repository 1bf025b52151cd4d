#pragma once

#include "chain/energy.hpp"
#include "chain/forward.hpp"
#include "chain/functions.hpp"
#include "chain/gradient.hpp"
#include "chain/inverse.hpp"
#include "chain/mass_matrix.hpp"

// The functions of chain/functions.hpp, for the two files that make them of their kind of section.

namespace cdcr::detail {

template <class Section>
void update_position(const Chain& chain, ChainState<Section>& state, const double* q) noexcept {
  state.update_position(chain, q);
}

template <class Section>
void update_velocity(const Chain& chain, ChainState<Section>& state, const double* qd) noexcept {
  state.update_velocity(chain, qd);
}

template <class Section>
void update_motion(const Chain& chain, ChainState<Section>& state, const double* q,
                   const double* qd) noexcept {
  state.update(chain, q, qd);
}

template <class Section>
void forward_motion(const Chain& chain, const ChainState<Section>& state, const double* force,
                    double* qdd) noexcept {
  forward_dynamics(chain, state, force, qdd);
}

template <class Section>
void inverse_motion(const Chain& chain, const ChainState<Section>& state, const double* qdd,
                    double* force) noexcept {
  inverse_dynamics(chain, state, qdd, force);
}

template <class Section>
void mass_matrix(const Chain& chain, const ChainState<Section>& state, MatrixRef M) noexcept {
  composite_mass(chain, state, M);
}

template <class Section>
double kinetic_energy(const Chain& chain, const ChainState<Section>& state,
                      const double* qd) noexcept {
  return kinetic_energy_of(chain, state, qd);
}

template <class Section>
double potential_energy(const Chain& chain, const ChainState<Section>& state,
                        const double* q) noexcept {
  return potential_energy_of(chain, state, q);
}

template <class Section>
void weight_gradient(const Chain& chain, const ChainState<Section>& state, const double* q,
                     double* gradient) noexcept {
  potential_gradient(chain, state, q, gradient);
}

}  // namespace cdcr::detail
