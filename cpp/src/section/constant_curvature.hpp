#pragma once

#include <cmath>

#include "section/arc.hpp"

namespace cdcr::detail {

/// The constant-curvature kind of section (section_state.hpp): its inertia, what its tip does, and
/// its inertia forces at qdd = 0, eqs. (26) to (30).
template <class S>
struct ConstantCurvature : Arc<S> {
  using Scalar = S;
  static constexpr int m = 2;
  static constexpr const char* component_names[] = {"x", "y"};  // of the coordinates
  using Matrix3m = typename Arc<S>::Matrix3m;
  using Matrixm = Eigen::Matrix<S, m, m>;
  using Vectorm = Eigen::Matrix<S, m, 1>;
  using Arc<S>::max_m, Arc<S>::base, Arc<S>::q_x, Arc<S>::q_y, Arc<S>::arc, Arc<S>::q, Arc<S>::r,
      Arc<S>::J_omega, Arc<S>::J_v;
  S qd_x, qd_y;
  ShapeValues<S> f;
  Vector3<S> n;  // z x q
  // Accelerations of the tip, and inertia forces, that come from velocities alone; bias is that on
  // q, elastic and damping forces among it.
  Vector3<S> tip_angular_bias, tip_linear_bias;
  Vector3<S> moment, force;
  Vectorm bias;

  void update_position(const SectionParameters& section, const FrameState<S>& at,
                       const S* bending) {
    Arc<S>::update_position(section, at, bending);
    read(*section.table, S(q_x * q_x + q_y * q_y), f);
    n = base.y * q_x - base.x * q_y;
  }

  /// omega of the tip.
  [[nodiscard]] Vector3<S> turning_rate() const {
    return base.omega + J_omega.col(0) * qd_x + J_omega.col(1) * qd_y;
  }

  /// Terms that come from velocities alone, eqs. (28) to (30). A base that does not turn leaves
  /// moment and force out: the root passes nothing on.
  template <bool turns>
  void update_velocity(const SectionParameters& section, const Vector3<S>& omega, const S* rate) {
    const S xd = rate[0], yd = rate[1];
    qd_x = xd;
    qd_y = yd;
    base.omega = omega;
    const Vector3<S>& z = base.z;
    const Vector3<S> qd = base.x * xd + base.y * yd;
    const S p = q_x * xd + q_y * yd, w = xd * xd + yd * yd, c = q_x * yd - q_y * xd;
    const S pp4 = 4.0 * p * p;

    // Tip: rates of its turning and moving relative to the base.
    const S l = section.length;
    const Vector3<S> turning_rate =
        c * ((2.0 * p) * (arc[arc_da] * z + arc[arc_dg] * q) + arc[arc_g] * qd);
    const Vector3<S> moving_rate =
        l * ((4.0 * p * arc[arc_da]) * qd + (2.0 * w * arc[arc_da] + pp4 * arc[arc_dda]) * q +
             (2.0 * w * arc[arc_ds] + pp4 * arc[arc_dds]) * z);
    // On q: the section's own bias of eq. (16).
    const S on_qd = 2.0 * p * f[d_a] + section.damping;
    const S on_q = f[d_b] * p * p + (f[in_b] - f[d_a]) * w + section.stiffness;
    if constexpr (!turns) {
      tip_angular_bias = turning_rate;
      tip_linear_bias = moving_rate;
      bias[0] = on_qd * xd + on_q * q_x;
      bias[1] = on_qd * yd + on_q * q_y;
      return;
    }
    const Vector3<S> turning = J_omega.col(0) * xd + J_omega.col(1) * yd;
    const Vector3<S> moving = J_v.col(0) * xd + J_v.col(1) * yd;
    tip_angular_bias = omega.cross(turning) + turning_rate;
    tip_linear_bias = omega.cross(Vector3<S>(omega.cross(r) + 2.0 * moving)) + moving_rate;

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
    bias[0] = on_qd * xd + along_q * q_x - gyro * yd - j_q * omega.dot(base.x);
    bias[1] = on_qd * yd + along_q * q_y + gyro * xd - j_q * omega.dot(base.y);
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
  [[nodiscard]] Matrix3m linear_coupling() const {
    const Vector3<S> dh = 2.0 * (f[dh1] * q + f[dh0] * base.z);
    Matrix3m H;
    H.col(0) = f[h1] * base.x + dh * q_x;
    H.col(1) = f[h1] * base.y + dh * q_y;
    return H;
  }
  /// Angular momentum of qd about the base, eq. (28).
  [[nodiscard]] Matrix3m angular_coupling() const {
    const Vector3<S> spin = f[k1] * q + f[k2] * base.z, across = f[k3] * n;
    Matrix3m N;
    N.col(0) = f[k0] * base.y - spin * q_y - across * q_x;
    N.col(1) = spin * q_x - f[k0] * base.x - across * q_y;
    return N;
  }
  /// Mass of the section's own bending, eq. (11).
  [[nodiscard]] Matrixm own_mass() const {
    const S across = f[in_b] * q_x * q_y;
    Matrixm M;
    M << f[in_a] + f[in_b] * q_x * q_x, across, across, f[in_a] + f[in_b] * q_y * q_y;
    return M;
  }

  /// -dl/dq of a straight cable at this radius and angle, eq. (6): constant.
  [[nodiscard]] static Vectorm actuation(double radius, double angle) {
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }
  /// Square of the angle by which the section bends, and a cable in it with it.
  [[nodiscard]] static S squared_angle(const S* q) { return q[0] * q[0] + q[1] * q[1]; }

  [[nodiscard]] static Vectorm elastic_force(const SectionParameters& section, const S* q) {
    return {section.stiffness * q[0], section.stiffness * q[1]};
  }
  [[nodiscard]] static S elastic_energy(const SectionParameters& section, const S* q) {
    return 0.5 * section.stiffness * (q[0] * q[0] + q[1] * q[1]);
  }
};

}  // namespace cdcr::detail
