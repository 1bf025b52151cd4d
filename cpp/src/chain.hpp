#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "body_table.hpp"

// The robot of n sections as a chain of flexible bodies, each carried by the tip of the one before
// (cpp/several-sections.md eqs. (23) to (32)). Vectors are told in the base frame; the twist of a
// section is that of its base. Templates on the scalar: double for motion, a dual number for
// derivatives.

namespace cdcr::detail {

template <class S>
using Vector3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Matrix3 = Eigen::Matrix<S, 3, 3>;
template <class S>
using Matrix32 = Eigen::Matrix<S, 3, 2>;

/// One section of a chain.
struct Body {
  std::shared_ptr<const BodyTable> table;  // shared by sections that are equal
  const ArcTable* arcs;
  double length, mass, stiffness, damping;
};

/// What the chain ends in: a rigid body at the tip, told in the tip frame.
struct Payload {
  double mass = 0.0;
  Vector3d position = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();  // about the tip

  [[nodiscard]] bool has_inertia() const noexcept { return mass != 0.0 || !inertia.isZero(0.0); }
};

/// A robot made ready for the recursions.
struct Chain {
  explicit Chain(const Robot& robot);

  std::vector<Body> bodies;
  Payload payload;
  Matrix3d root;     // orientation of the first section
  Vector3d gravity;  // in the base frame
};

/// A frame in the base frame, by its axes, and how fast it turns.
template <class S>
struct Mount {
  Vector3<S> x, y, z;
  Vector3<S> omega = Vector3<S>::Zero();
};

template <class S>
[[nodiscard]] Mount<S> root_of(const Chain& chain) {
  return {chain.root.col(0).cast<S>(), chain.root.col(1).cast<S>(), chain.root.col(2).cast<S>()};
}

template <int N>
void read(const PolynomialTable<N>& table, double sigma, Eigen::Array<double, N, 1>& f) {
  table(sigma, f);
}

/// A section's arc from its base to a fraction of its length, eqs. (23) to (25).
template <class S>
struct Arc {
  Mount<S> base;
  S q_x, q_y;
  ArcValues<S> arc;
  Vector3<S> q;      // the bending vector in space
  Vector3<S> r;      // from the base to the end
  Matrix32<S> W, D;  // omega_end = omega + W qd, v_end = v + omega x r + D qd

  void place(const Body& body, const Mount<S>& mount, const S& x, const S& y,
             double fraction = 1.0) {
    base = mount;
    q_x = fraction * x;
    q_y = fraction * y;
    read(*body.arcs, S(q_x * q_x + q_y * q_y), arc);
    const double l = fraction * body.length;
    q = base.x * q_x + base.y * q_y;
    r = l * (arc[arc_a] * q + arc[arc_s] * base.z);
    const Vector3<S> g = arc[arc_a] * base.z + arc[arc_g] * q;
    const Vector3<S> dr = (2.0 * l) * (arc[arc_da] * q + arc[arc_ds] * base.z);
    W.col(0) = base.y - g * q_y;
    W.col(1) = g * q_x - base.x;
    const S alpha = l * arc[arc_a];
    D.col(0) = alpha * base.x + dr * q_x;
    D.col(1) = alpha * base.y + dr * q_y;
    if (fraction != 1.0) {
      W *= S(fraction);
      D *= S(fraction);
    }
  }

  /// Frame at the end, eq. (24); it turns as the base does.
  [[nodiscard]] Mount<S> tip() const {
    const S along = 1.0 - (q_x * q_x + q_y * q_y) * arc[arc_a];
    const Vector3<S> pull = arc[arc_s] * base.z + arc[arc_a] * q;
    return {base.x - pull * q_x, base.y - pull * q_y, along * base.z + arc[arc_s] * q, base.omega};
  }
};

/// One section in one state: its inertia, what its tip does, and its inertia forces at qdd = 0.
template <class S>
struct Link : Arc<S> {
  using Arc<S>::base, Arc<S>::q_x, Arc<S>::q_y, Arc<S>::arc, Arc<S>::q, Arc<S>::r, Arc<S>::W,
      Arc<S>::D;
  S qd_x, qd_y;
  ShapeValues<S> f;
  Vector3<S> n;                    // z x q
  Vector3<S> tip_omega, tip_v;     // accelerations of the tip that come from velocities alone
  Vector3<S> moment, force;        // inertia forces that come from velocities alone
  Eigen::Matrix<S, 2, 1> bending;  // the same on q, elastic and damping forces among them

  /// What does not depend on qd.
  void place(const Body& body, const Mount<S>& mount, const S& x, const S& y) {
    Arc<S>::place(body, mount, x, y);
    read(*body.table, S(x * x + y * y), f);
    n = base.y * x - base.x * y;
    qd_x = qd_y = S(0.0);
  }

  /// Frame at the tip and how fast it turns.
  [[nodiscard]] Mount<S> tip() const {
    Mount<S> mount = Arc<S>::tip();
    mount.omega += W.col(0) * qd_x + W.col(1) * qd_y;
    return mount;
  }

  /// Terms that come from velocities alone, eqs. (28) to (30). A base that does not turn leaves
  /// moment and force out: the root passes nothing on.
  template <bool turns = true>
  void move(const Body& body, const S& xd, const S& yd) {
    qd_x = xd;
    qd_y = yd;
    const Vector3<S>& omega = base.omega;
    const Vector3<S>& z = base.z;
    const Vector3<S> qd = base.x * xd + base.y * yd;
    const S p = q_x * xd + q_y * yd, w = xd * xd + yd * yd, c = q_x * yd - q_y * xd;
    const S pp4 = 4.0 * p * p;

    // Tip: rates of its turning and moving relative to the base.
    const S l = body.length;
    const Vector3<S> turning_rate =
        c * ((2.0 * p) * (arc[arc_da] * z + arc[arc_dg] * q) + arc[arc_g] * qd);
    const Vector3<S> moving_rate =
        l * ((4.0 * p * arc[arc_da]) * qd + (2.0 * w * arc[arc_da] + pp4 * arc[arc_dda]) * q +
             (2.0 * w * arc[arc_ds] + pp4 * arc[arc_dds]) * z);
    // On q: the section's own bias of eq. (16).
    const S on_qd = 2.0 * p * f[d_a] + body.damping;
    const S on_q = f[d_b] * p * p + (f[in_b] - f[d_a]) * w + body.stiffness;
    if constexpr (!turns) {
      tip_omega = turning_rate;
      tip_v = moving_rate;
      bending[0] = on_qd * xd + on_q * q_x;
      bending[1] = on_qd * yd + on_q * q_y;
      return;
    }
    const Vector3<S> turning = W.col(0) * xd + W.col(1) * yd;
    const Vector3<S> moving = D.col(0) * xd + D.col(1) * yd;
    tip_omega = omega.cross(turning) + turning_rate;
    tip_v = omega.cross(Vector3<S>(omega.cross(r) + 2.0 * moving)) + moving_rate;

    // Linear momentum m v + omega x h + dh/dt.
    const Vector3<S> h = f[h1] * q + f[h0] * z;
    const Vector3<S> dh = 2.0 * (f[dh1] * q + f[dh0] * z);
    const Vector3<S> h_rate = f[h1] * qd + p * dh;
    const Vector3<S> n_rate = base.y * xd - base.x * yd;
    force = omega.cross(Vector3<S>(omega.cross(h) + 2.0 * h_rate)) + (4.0 * p * f[dh1]) * qd +
            w * dh + pp4 * (f[ddh1] * q + f[ddh0] * z);

    // Angular momentum J omega + L + h x v.
    const S o_q = omega.dot(q), o_z = omega.dot(z), o_qd = omega.dot(qd), oo = omega.dot(omega);
    const S j_q = f[c1] * o_q + f[c2] * o_z, j_z = f[c2] * o_q + f[c3] * o_z;
    const S p2 = 2.0 * p;
    const Vector3<S> momentum = f[c0] * omega + (j_q + c * f[k1]) * q + (j_z + c * f[k2]) * z +
                                f[k0] * n_rate - (p * f[k3]) * n;
    moment = omega.cross(momentum) + (p2 * f[dc0]) * omega +
             (p2 * (f[dc1] * o_q + f[dc2] * o_z + c * f[dk1]) + f[c1] * o_qd) * q +
             (p2 * (f[dc2] * o_q + f[dc3] * o_z + c * f[dk2]) + f[c2] * o_qd) * z +
             (j_q + c * f[k1]) * qd + (p2 * f[dk0] - p * f[k3]) * n_rate -
             (p * p2 * f[dk3] + w * f[k3]) * n;

    // On q: gyroscopic and centrifugal.
    const S gyro = f[spin_q] * o_q + f[spin_z] * o_z;
    const S along_q =
        on_q - (f[dc0] * oo + f[dc1] * o_q * o_q + 2.0 * f[dc2] * o_q * o_z + f[dc3] * o_z * o_z);
    bending[0] = on_qd * xd + along_q * q_x - gyro * yd - j_q * omega.dot(base.x);
    bending[1] = on_qd * yd + along_q * q_y + gyro * xd - j_q * omega.dot(base.y);
  }

  /// First moment of mass about the base.
  [[nodiscard]] Vector3<S> first_moment() const { return f[h1] * q + f[h0] * base.z; }
  /// Second moment J of angular momentum J omega.
  [[nodiscard]] Matrix3<S> second_moment() const {
    const Vector3<S> with_q = f[c1] * q + f[c2] * base.z, with_z = f[c2] * q + f[c3] * base.z;
    Matrix3<S> J = q * with_q.transpose() + base.z * with_z.transpose();
    J.diagonal().array() += f[c0];
    return J;
  }
  /// Linear momentum of qd: the columns of dh/dq.
  [[nodiscard]] Matrix32<S> linear_coupling() const {
    const Vector3<S> dh = 2.0 * (f[dh1] * q + f[dh0] * base.z);
    Matrix32<S> H;
    H.col(0) = f[h1] * base.x + dh * q_x;
    H.col(1) = f[h1] * base.y + dh * q_y;
    return H;
  }
  /// Angular momentum of qd about the base, eq. (28).
  [[nodiscard]] Matrix32<S> angular_coupling() const {
    const Vector3<S> spin = f[k1] * q + f[k2] * base.z, across = f[k3] * n;
    Matrix32<S> N;
    N.col(0) = f[k0] * base.y - spin * q_y - across * q_x;
    N.col(1) = spin * q_x - f[k0] * base.x - across * q_y;
    return N;
  }
  /// Symmetric 2x2 mass of the section's own bending, eq. (11), as xx, xy, yy.
  [[nodiscard]] Vector3<S> own_mass() const {
    return {f[in_a] + f[in_b] * q_x * q_x, f[in_b] * q_x * q_y, f[in_a] + f[in_b] * q_y * q_y};
  }
};

}  // namespace cdcr::detail
