#pragma once

#include "chain/chain.hpp"
#include "chain/inertia.hpp"

namespace cdcr::detail {

/// T = 1/2 qd^T M qd, from base to tip. `state` needs its position alone.
template <class Section, class S = typename Section::Scalar>
[[nodiscard]] S kinetic_energy_of(const Chain& chain, const ChainState<Section>& state,
                                  const S* qd) {
  using Vectorm = typename Section::Vectorm;
  Vector3<S> v = Vector3<S>::Zero(), omega = Vector3<S>::Zero();
  S twice(0.0);
  for (Index i = 0; i < chain.num_sections(); ++i) {
    const Section& section = state.sections[i];
    const Index first = chain.first[i];
    const Vectorm rate = Eigen::Map<const Vectorm>(qd + first, chain.first[i + 1] - first);
    const Vector3<S> h_rate =
        omega.cross(section.first_moment()) + section.linear_coupling().lazyProduct(rate);
    twice += chain.sections[i].mass * v.dot(v) + 2.0 * v.dot(h_rate) +
             omega.dot(section.second_moment().lazyProduct(omega)) +
             2.0 * omega.dot(section.angular_coupling().lazyProduct(rate)) +
             rate.dot(section.own_mass().lazyProduct(rate));
    v += omega.cross(section.r) + section.J_v.lazyProduct(rate);
    omega += section.J_omega.lazyProduct(rate);
  }
  const Articulated<S> payload = articulated_payload(chain.payload, state.tip);
  twice += v.dot(payload.M * v) + 2.0 * omega.dot(payload.G * v) + omega.dot(payload.J * omega);
  return 0.5 * twice;
}

/// Elastic energy plus weight, the latter zero at the base. `state` needs its position alone.
template <class Section, class S = typename Section::Scalar>
[[nodiscard]] S potential_energy_of(const Chain& chain, const ChainState<Section>& state,
                                    const S* q) {
  const Vector3<S> g = chain.gravity.cast<S>();
  Vector3<S> p = Vector3<S>::Zero();
  S U(0.0);
  for (Index i = 0; i < chain.num_sections(); ++i) {
    const Section& section = state.sections[i];
    U += Section::elastic_energy(chain.sections[i], q + chain.first[i]) -
         g.dot(chain.sections[i].mass * p + section.first_moment());
    p += section.r;
  }
  const Payload& payload = chain.payload;
  return U - payload.mass * g.dot(p + state.tip.rotate(payload.position));
}

}  // namespace cdcr::detail
