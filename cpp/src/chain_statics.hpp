#pragma once

#include "chain.hpp"

namespace cdcr::detail {

/// dU/dq by weights alone, from tip to base: the inverse dynamics of a robot at rest, eqs. (30) and
/// (33), without the many terms that are then zero.
template <class S>
void potential_gradient(const Chain& chain, const S* q, S* gradient) {
  const auto n = static_cast<Index>(chain.bodies.size());
  Link<S> links[max_sections];
  Mount<S> mount = root_of<S>(chain);
  for (Index i = 0; i < n; ++i) {
    links[i].place(chain.bodies[i], mount, q[2 * i], q[2 * i + 1]);
    mount = links[i].Arc<S>::tip();
  }
  const Payload& payload = chain.payload;
  const Vector3<S> g = chain.gravity.cast<S>();
  const Vector3<S> arm = mount.x * S(payload.mass * payload.position[0]) +
                         mount.y * S(payload.mass * payload.position[1]) +
                         mount.z * S(payload.mass * payload.position[2]);
  double mass = payload.mass;        // of all beyond this tip
  Vector3<S> moment = arm.cross(g);  // of its weight about the tip
  for (Index i = n - 1; i >= 0; --i) {
    const Link<S>& link = links[i];
    const Body& body = chain.bodies[i];
    const Vector3<S> weight = (mass * chain.gravity).template cast<S>();
    const Matrix32<S> H = link.linear_coupling();
    for (int k = 0; k < 2; ++k) {
      gradient[2 * i + k] = body.stiffness * q[2 * i + k] - H.col(k).dot(g) -
                            link.W.col(k).dot(moment) - link.D.col(k).dot(weight);
    }
    moment += link.r.cross(weight) + link.first_moment().cross(g);
    mass += body.mass;
  }
}

}  // namespace cdcr::detail
