#pragma once

#include <type_traits>

#include "chain.hpp"
#include "chain_inertia.hpp"

namespace cdcr::detail {

/// Accelerations under a generalised force, by one pass from base to tip for velocities, one back
/// for articulated inertia and one out again for accelerations, eqs. (31), (32): O(n).
template <class S>
void forward_dynamics(const Chain& chain, const S* q, const S* qd, const S* force, S* qdd) {
  struct Solved {
    Matrix32<S> U_omega, U_v;  // force on the base that a bending acceleration needs
    S xx, xy, yy;              // inverse of the section's articulated mass D
    S u_x, u_y;                // D^-1 of the bending force at rest
  };
  const auto n = static_cast<Index>(chain.bodies.size());
  Link<S> links[max_sections];
  Solved solved[max_sections];
  Mount<S> mount = root_of<S>(chain);
  links[0].place(chain.bodies[0], mount, q[0], q[1]);
  links[0].template move<false>(chain.bodies[0], qd[0], qd[1]);
  mount = links[0].tip();
  for (Index i = 1; i < n; ++i) {
    links[i].place(chain.bodies[i], mount, q[2 * i], q[2 * i + 1]);
    links[i].move(chain.bodies[i], qd[2 * i], qd[2 * i + 1]);
    mount = links[i].tip();
  }

  Articulated<S> rest = articulated_payload(chain.payload, mount);
  // Eliminates q of section i; `carries` is false where no mass lies beyond it.
  const auto eliminate = [&](Index i, auto carries) {
    const Link<S>& link = links[i];
    Solved& s = solved[i];
    Vector3<S> mass = link.own_mass();  // xx, xy, yy
    S b_x = link.bending[0] - force[2 * i], b_y = link.bending[1] - force[2 * i + 1];
    Vector3<S> f_tip, m_tip;
    Matrix32<S> F, T;
    if constexpr (carries) {
      // What the rest of the chain asks of this tip: its own share, and through W and D that of q.
      f_tip = rest.force + rest.G.transpose() * link.tip_omega + rest.M * link.tip_v;
      m_tip = rest.moment + rest.J * link.tip_omega + rest.G * link.tip_v;
      F = rest.G.transpose() * link.W + rest.M * link.D;
      T = rest.J * link.W + rest.G * link.D;
      mass[0] += link.W.col(0).dot(T.col(0)) + link.D.col(0).dot(F.col(0));
      mass[1] += link.W.col(0).dot(T.col(1)) + link.D.col(0).dot(F.col(1));
      mass[2] += link.W.col(1).dot(T.col(1)) + link.D.col(1).dot(F.col(1));
      b_x += link.W.col(0).dot(m_tip) + link.D.col(0).dot(f_tip);
      b_y += link.W.col(1).dot(m_tip) + link.D.col(1).dot(f_tip);
      s.U_v = F + link.linear_coupling();
    } else {
      s.U_v = link.linear_coupling();
    }
    const S inverse = 1.0 / (mass[0] * mass[2] - mass[1] * mass[1]);
    s.xx = mass[2] * inverse;
    s.xy = -mass[1] * inverse;
    s.yy = mass[0] * inverse;
    s.u_x = s.xx * b_x + s.xy * b_y;
    s.u_y = s.xy * b_x + s.yy * b_y;
    if (i == 0) return;  // its base neither turns nor passes anything on

    if constexpr (carries) {
      s.U_omega = T + link.angular_coupling();
      for (int k = 0; k < 2; ++k) s.U_omega.col(k) += link.r.cross(F.col(k));
      shift(rest, link.r);
    } else {
      s.U_omega = link.angular_coupling();
    }
    add_link(rest, chain.bodies[i].mass, link);
    const Matrix32<S>& U = s.U_omega;
    const Matrix32<S>& V = s.U_v;
    Matrix32<S> UD, VD;
    UD.col(0) = U.col(0) * s.xx + U.col(1) * s.xy;
    UD.col(1) = U.col(0) * s.xy + U.col(1) * s.yy;
    VD.col(0) = V.col(0) * s.xx + V.col(1) * s.xy;
    VD.col(1) = V.col(0) * s.xy + V.col(1) * s.yy;
    rest.J -= UD * U.transpose();
    rest.G -= UD * V.transpose();
    rest.M -= VD * V.transpose();
    if constexpr (carries) {
      rest.force = f_tip + link.force - (V.col(0) * s.u_x + V.col(1) * s.u_y);
      rest.moment =
          m_tip + link.r.cross(f_tip) + link.moment - (U.col(0) * s.u_x + U.col(1) * s.u_y);
    } else {
      rest.force = link.force - (V.col(0) * s.u_x + V.col(1) * s.u_y);
      rest.moment = link.moment - (U.col(0) * s.u_x + U.col(1) * s.u_y);
    }
  };
  Index last = n - 1;
  if (!chain.payload.has_inertia()) eliminate(last--, std::false_type());
  for (Index i = last; i >= 0; --i) eliminate(i, std::true_type());

  // At a base at rest weight is an acceleration upwards.
  Vector3<S> omega = Vector3<S>::Zero(), v = -chain.gravity.template cast<S>();
  for (Index i = 0; i < n; ++i) {
    const Link<S>& link = links[i];
    const Solved& s = solved[i];
    S w_x = s.U_v.col(0).dot(v), w_y = s.U_v.col(1).dot(v);
    if (i > 0) {
      w_x += s.U_omega.col(0).dot(omega);
      w_y += s.U_omega.col(1).dot(omega);
    }
    const S a_x = -(s.u_x + s.xx * w_x + s.xy * w_y);
    const S a_y = -(s.u_y + s.xy * w_x + s.yy * w_y);
    qdd[2 * i] = a_x;
    qdd[2 * i + 1] = a_y;
    if (i + 1 == n) break;
    v += omega.cross(link.r) + link.D.col(0) * a_x + link.D.col(1) * a_y + link.tip_v;
    omega += link.W.col(0) * a_x + link.W.col(1) * a_y + link.tip_omega;
  }
}

}  // namespace cdcr::detail
