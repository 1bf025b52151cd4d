#pragma once

#include "chain/inertia.hpp"
#include "derivatives/quad.hpp"

namespace cdcr::detail {

/// Variation of the motion that carries what lies beyond a tip, material: of the tip's acceleration
/// b, its turning rate w and, with what w adds to it, its turning acceleration e, eq. (74).
struct Motion {
  Vector3<Quad> b, e, w;
};

/// All that moves beyond a tip, about that tip, cpp/derivatives.md eqs. (72), (73): first moment h
/// and second moment J of its mass and their rates P and J_rate, angular momentum L of the motion
/// beside the tip, and the force F and moment T that move it.
struct Outboard {
  double mass;
  Vector3d h, P, L, F, T;
  Matrix3d J, J_rate;

  Outboard(const Payload& payload, const FrameState<double>& tip, const Vector3d& alpha,
           const Vector3d& a)
      : mass(payload.mass) {
    const Articulated<double> body = articulated_payload(payload, tip);
    h = payload.mass * tip.rotate(payload.position);
    J = body.J;
    J_rate = turned(J, tip.omega);
    P = tip.omega.cross(h);
    L = J.lazyProduct(tip.omega);
    F = body.force + mass * a + alpha.cross(h);
    T = body.moment + J.lazyProduct(alpha) + h.cross(a);
  }

  /// Moves the reference from the tip of r to its foot, beside which the tip moves at V.
  void shift(const Vector3d& r, const Vector3d& V) {
    const Vector3d at = h + mass * r, moving = P + mass * V;  // with all mass at the tip
    // Of 1 (r.x) - x r^T and of its rate, both halves.
    const auto add = [](Matrix3d& to, const Vector3d& a, const Vector3d& b) {
      to.noalias() -= a.lazyProduct(b.transpose());
      to.diagonal().array() += a.dot(b);
    };
    add(J, at, r);
    add(J, r, h);
    add(J_rate, moving, r);
    add(J_rate, at, V);
    add(J_rate, V, h);
    add(J_rate, r, P);
    L += r.cross(moving) + h.cross(V);
    h = at;
    P = moving;
    T += r.cross(F);
  }

  /// Adds a section, whose base accelerates at alpha and a. J_own is the rate at which its second
  /// moment changes with its own coordinates.
  template <class Section, class Vectorm>
  void add(double mass_of_section, const Section& section, const Vectorm& qd, const Vectorm& qdd,
           const Vector3d& alpha, const Vector3d& a, const Matrix3d& J_own) {
    const Vector3d& omega = section.base.omega;
    const Vector3d first = section.first_moment();
    const Matrix3d second = section.second_moment();
    const typename Section::Matrix3m H = section.linear_coupling(), N = section.angular_coupling();
    mass += mass_of_section;
    h += first;
    P += omega.cross(first) + H.lazyProduct(qd);
    J += second;
    J_rate += J_own + turned(second, omega);
    L += second.lazyProduct(omega) + N.lazyProduct(qd);
    F += section.force + mass_of_section * a + alpha.cross(first) + H.lazyProduct(qdd);
    T += section.moment + second.lazyProduct(alpha) + first.cross(a) + N.lazyProduct(qdd);
  }

  /// Force and moment of a variation of the motion that carries it, eq. (75).
  [[nodiscard]] Vector3<Quad> force_of(const Motion& x) const {
    return mass * x.b + x.e.cross(h.cast<Quad>()) + x.w.cross((2.0 * P).cast<Quad>());
  }
  [[nodiscard]] Vector3<Quad> moment_of(const Motion& x) const {
    return h.cast<Quad>().cross(x.b) + J.lazyProduct(x.e) + J_rate.lazyProduct(x.w) +
           x.w.cross(L.cast<Quad>());
  }

 private:
  /// Rate of a second moment that turns as it is.
  static Matrix3d turned(const Matrix3d& J, const Vector3d& omega) {
    Matrix3d left;
    for (int k = 0; k < 3; ++k) left.col(k) = omega.cross(J.col(k));
    return left + left.transpose();
  }
};

}  // namespace cdcr::detail
