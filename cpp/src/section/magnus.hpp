#pragma once

#include <array>

#include "section/section_state.hpp"

// NOLINTBEGIN(readability-identifier-naming): letters of the equations

namespace cdcr::detail {

/// Rotation vector Omega of one step of dR/dx = R [u(x)], R(x + h) = R(x) exp [Omega], by the
/// Magnus series to sixth order (Blanes, Casas, Ros 2000), and its derivatives, cpp/rods.md eq.
/// (54). The step knows u by alpha_1, alpha_2, alpha_3, there a, b and c: its Taylor coefficients
/// about the middle times h, h^2, h^3.
template <class S>
class Magnus {
 public:
  Vector3<S> Omega;

  Magnus() = default;
  Magnus(const Vector3<S>& alpha_1, const Vector3<S>& alpha_2, const Vector3<S>& alpha_3)
      : a(alpha_1), b(alpha_2) {
    const Vector3<S>& c = alpha_3;
    const Vector3<S> ab = -a.cross(b);
    w = 2.0 * c + ab;
    P = ab - 20.0 * a - c;
    Q = b + a.cross(w) / 60.0;
    Omega = a + c / 12.0 - P.cross(Q) / 240.0;
  }

  /// dOmega/dalpha_i, i = 1, 2, 3.
  void slopes(std::array<Matrix3<S>, 3>& slope) const {
    // Products of two or three cross products are [x][y] = y x^T - (x.y) 1 and
    // [x][y][z] = (x x z) y^T - (y.z) [x], so each slope is made of a few outer products.
    const S aa = a.dot(a), ab = a.dot(b), aP = a.dot(P), aQ = a.dot(Q), bQ = b.dot(Q),
            wP = w.dot(P);
    const Vector3<S> Pb = P.cross(b), Pa = P.cross(a);
    Matrix3<S>& on_a = slope[0];
    on_a.noalias() = b * Q.transpose() + (w * P.transpose() - Pb * a.transpose()) / 60.0;
    on_a.diagonal().array() -= bQ + wP / 60.0;
    add_cross(on_a, Vector3<S>(P * (ab / 60.0) - 20.0 * Q));
    Matrix3<S>& on_b = slope[1];
    on_b.noalias() = Pa * a.transpose() / 60.0 - a * Q.transpose();
    on_b.diagonal().array() += aQ;
    add_cross(on_b, Vector3<S>(-(1.0 + aa / 60.0) * P));
    Matrix3<S>& on_c = slope[2];
    on_c.noalias() = a * P.transpose() * (-1.0 / 30.0);
    on_c.diagonal().array() += aP / 30.0 + 20.0;
    add_cross(on_c, Vector3<S>(-Q));
    for (Matrix3<S>& one : slope) one *= 1.0 / 240.0;
    on_a.diagonal().array() += 1.0;
  }

  /// Second derivatives of along.Omega with respect to alpha_1, alpha_2, alpha_3; its body is in
  /// derivatives/rod_curvature.cpp.
  [[nodiscard]] Eigen::Matrix<S, 9, 9> curvature(const Vector3<S>& along) const;

  /// First and second derivatives of Omega in time while the alphas change at these rates.
  void rates(const Vector3<S>& a1, const Vector3<S>& b1, const Vector3<S>& c1, Vector3<S>& first,
             Vector3<S>& second) const {
    const Vector3<S> ab1 = -(a1.cross(b) + a.cross(b1)), ab2 = -2.0 * a1.cross(b1);
    const Vector3<S> w1 = 2.0 * c1 + ab1, P1 = ab1 - 20.0 * a1 - c1;
    const Vector3<S> Q1 = b1 + (a1.cross(w) + a.cross(w1)) / 60.0;
    const Vector3<S> Q2 = (2.0 * a1.cross(w1) + a.cross(ab2)) / 60.0;
    first = a1 + c1 / 12.0 - (P1.cross(Q) + P.cross(Q1)) / 240.0;
    second = (ab2.cross(Q) + 2.0 * P1.cross(Q1) + P.cross(Q2)) / -240.0;
  }

 private:
  /// M += [v].
  static void add_cross(Matrix3<S>& M, const Vector3<S>& v) {
    M(0, 1) -= v[2];
    M(0, 2) += v[1];
    M(1, 0) += v[2];
    M(1, 2) -= v[0];
    M(2, 0) -= v[1];
    M(2, 1) += v[0];
  }

  Vector3<S> a, b, w, P, Q;
};

}  // namespace cdcr::detail

// NOLINTEND(readability-identifier-naming)
