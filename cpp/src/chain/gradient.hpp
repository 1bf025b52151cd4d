#pragma once

#include "chain/chain.hpp"

namespace cdcr::detail {

/// dU/dq by weights alone, from tip to base: the inverse dynamics of a robot at rest, eqs. (30) and
/// (33), without the many terms that are then zero. `state` needs its position alone.
template <class Section, class S = typename Section::Scalar>
void potential_gradient(const Chain& chain, const ChainState<Section>& state, const S* q,
                        S* gradient) {
  const Payload& payload = chain.payload;
  const Vector3<S> g = chain.gravity.cast<S>();
  double mass = payload.mass;  // of all beyond this tip, and the moment of its weight about the tip
  Vector3<S> moment = state.tip.rotate(payload.mass * payload.position).cross(g);
  for (Index i = chain.num_sections() - 1; i >= 0; --i) {
    const Section& section = state.sections[i];
    const SectionParameters& fixed = chain.sections[i];
    const Index first = chain.first[i], size = chain.first[i + 1] - first;
    const Vector3<S> weight = (mass * chain.gravity).template cast<S>();
    Eigen::Map<typename Section::Vectorm>(gradient + first, size) =
        Section::elastic_force(fixed, q + first) -
        section.linear_coupling().transpose().lazyProduct(g) -
        section.J_omega.transpose().lazyProduct(moment) -
        section.J_v.transpose().lazyProduct(weight);
    moment += section.r.cross(weight) + section.first_moment().cross(g);
    mass += fixed.mass;
  }
}

}  // namespace cdcr::detail
