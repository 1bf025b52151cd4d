#pragma once

#include "chain/chain.hpp"

// Small products are lazyProducts: Eigen's operator* stores each in a temporary of its own.

namespace cdcr::detail {

/// Force and moment on a frame as it accelerates:
/// moment = J omega_dot + G v_dot + moment0, force = G^T omega_dot + M v_dot + force0.
template <class S>
struct Articulated {
  Matrix3<S> J, G, M;
  Vector3<S> moment, force;
};

template <class S>
[[nodiscard]] Matrix3<S> cross_matrix(const Vector3<S>& v) {
  Matrix3<S> m;
  m << S(0.0), -v[2], v[1], v[2], S(0.0), -v[0], -v[1], v[0], S(0.0);
  return m;
}

/// The payload as a rigid body on the tip.
template <class S>
[[nodiscard]] Articulated<S> articulated_payload(const Payload& payload, const FrameState<S>& tip) {
  const Matrix3<S> R = tip.rotation();
  const Vector3<S> h = payload.mass * (R * payload.position.cast<S>());
  const Matrix3<S> J = R * payload.inertia.cast<S>() * R.transpose();
  const Vector3<S> spin = J * tip.omega;
  return {J, cross_matrix(h), S(payload.mass) * Matrix3<S>::Identity(), tip.omega.cross(spin),
          tip.omega.cross(Vector3<S>(tip.omega.cross(h)))};
}

/// Moves the reference of the inertia from the tip of r to its foot.
template <class S>
void shift(Articulated<S>& a, const Vector3<S>& r) {
  // J' = J + [r] G^T - G' [r] with G' = G + [r] M; a row of G' [r] is that row of G' times r.
  for (int k = 0; k < 3; ++k) a.J.col(k) += r.cross(Vector3<S>(a.G.row(k).transpose()));
  for (int k = 0; k < 3; ++k) a.G.col(k) += r.cross(a.M.col(k));
  for (int k = 0; k < 3; ++k) {
    a.J.row(k) -= Vector3<S>(a.G.row(k).transpose()).cross(r).transpose();
  }
}

/// Adds a section's own inertia; forces are left alone.
template <class Section, class S = typename Section::Scalar>
void add_section(Articulated<S>& a, double mass, const Section& section) {
  a.J += section.second_moment();
  a.G += cross_matrix(section.first_moment());
  a.M.diagonal().array() += S(mass);
}

}  // namespace cdcr::detail
