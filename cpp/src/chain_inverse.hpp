#pragma once

#include "chain.hpp"
#include "chain_inertia.hpp"

namespace cdcr::detail {

/// Generalised force that produces the accelerations: twists and accelerations from base to tip,
/// inertia forces back, eqs. (30), (33): O(n). Without `qdd` the bias, without `qd` too dU/dq.
template <class S>
void inverse_dynamics(const Chain& chain, const S* q, const S* qd, const S* qdd, S* force) {
  const auto n = static_cast<Index>(chain.bodies.size());
  Link<S> links[max_sections];
  const S zero(0.0);
  Mount<S> mount = root_of<S>(chain);
  Vector3<S> alpha = Vector3<S>::Zero(), v = -chain.gravity.template cast<S>();
  for (Index i = 0; i < n; ++i) {
    const Body& body = chain.bodies[i];
    Link<S>& link = links[i];
    link.place(body, mount, q[2 * i], q[2 * i + 1]);
    const S xd = qd ? qd[2 * i] : zero, yd = qd ? qd[2 * i + 1] : zero;
    const S a_x = qdd ? qdd[2 * i] : zero, a_y = qdd ? qdd[2 * i + 1] : zero;

    // Inertia forces of the accelerations, on top of those of the velocities.
    const Matrix32<S> H = link.linear_coupling();
    const Vector3<S> own = link.own_mass();
    if (i == 0) {  // its base neither turns nor asks what acts on it
      link.template move<false>(body, xd, yd);
    } else {
      link.move(body, xd, yd);
      const Vector3<S> h = link.first_moment();
      const Matrix32<S> N = link.angular_coupling();
      link.force += body.mass * v + alpha.cross(h) + H.col(0) * a_x + H.col(1) * a_y;
      link.moment += link.second_moment() * alpha + h.cross(v) + N.col(0) * a_x + N.col(1) * a_y;
      link.bending[0] += N.col(0).dot(alpha);
      link.bending[1] += N.col(1).dot(alpha);
    }
    link.bending[0] += own[0] * a_x + own[1] * a_y + H.col(0).dot(v);
    link.bending[1] += own[1] * a_x + own[2] * a_y + H.col(1).dot(v);

    v += alpha.cross(link.r) + link.D.col(0) * a_x + link.D.col(1) * a_y + link.tip_v;
    alpha += link.W.col(0) * a_x + link.W.col(1) * a_y + link.tip_omega;
    mount = link.tip();
  }

  const Articulated<S> payload = articulated_payload(chain.payload, mount);
  Vector3<S> moment = payload.moment + payload.J * alpha + payload.G * v;
  Vector3<S> pull = payload.force + payload.G.transpose() * alpha + payload.M * v;
  for (Index i = n - 1; i >= 0; --i) {
    const Link<S>& link = links[i];
    for (int k = 0; k < 2; ++k) {
      force[2 * i + k] = link.bending[k] + link.W.col(k).dot(moment) + link.D.col(k).dot(pull);
    }
    if (i == 0) break;
    moment += link.r.cross(pull) + link.moment;
    pull += link.force;
  }
}

}  // namespace cdcr::detail
