#pragma once

#include "cdcr/types.hpp"
#include "section/shape_table.hpp"

// One section with nothing but a point on its tip: equations of motion in closed form,
// cpp/README.md eqs. (8) to (19). What a time step calls is in this header, since a call would cost
// a third of it.

namespace cdcr::detail {

/// What the closed form needs to know of its robot.
struct SingleSection {
  ShapeTable table;
  double length, stiffness, damping;
  Vector3d gravity;  // as the section sees it
  bool has_gravity;
};

namespace closed_form {

/// Adds the weight's part of dU/dq = -l [g_xy G_A + 2 (g_xy.q) G_A' q + 2 g_z G_S' q], eq. (15).
template <class S>
[[gnu::always_inline]] inline void add_weight(const SingleSection& section, const S& x, const S& y,
                                              const S& sigma, S& out_x, S& out_y) noexcept {
  const auto [G_A, G_S, dG_A, dG_S] = ShapeTable::read(section.table.gravity, sigma);
  const Vector3d& g = section.gravity;
  const double l = section.length;
  const S along_q = 2.0 * ((g[0] * x + g[1] * y) * dG_A + g[2] * dG_S);
  out_x -= l * (g[0] * G_A + along_q * x);
  out_y -= l * (g[1] * G_A + along_q * y);
}

/// h = (2 a' p + c) qd + (b' p^2 + (b - a') w) q + dU/dq, eq. (16).
template <class S>
[[gnu::always_inline]] inline void section_bias(const SingleSection& section,
                                                const ShapeTable::ValuesOf<S>& inertia, const S& x,
                                                const S& y, const S& xd, const S& yd, S& h_x,
                                                S& h_y) noexcept {
  const auto& [a, b, da, db] = inertia;
  const S p = x * xd + y * yd;
  const S w = xd * xd + yd * yd;
  const S on_qd = 2.0 * da * p + section.damping;
  const S on_q = (db * (p * p) + section.stiffness) + (b - da) * w;
  h_x = on_qd * xd + on_q * x;
  h_y = on_qd * yd + on_q * y;
  if (section.has_gravity) add_weight<S>(section, x, y, x * x + y * y, h_x, h_y);
}

/// Accelerations (2) under a generalised force (2).
template <class S>
[[gnu::always_inline]] inline void forward_dynamics(const SingleSection& section, const S* q,
                                                    const S* qd, const S* force, S* qdd) noexcept {
  const S x = q[0], y = q[1];
  const S sigma = x * x + y * y;
  const auto v = ShapeTable::read(section.table.inertia, sigma);
  S h_x(0.0), h_y(0.0);
  section_bias<S>(section, v, x, y, qd[0], qd[1], h_x, h_y);
  const S r_x = force[0] - h_x, r_y = force[1] - h_y;
  // M^-1 r = (r - b/(a + b sigma) (q.r) q)/a, eq. (12), with one division for both quotients.
  const S &a = v[0], &b = v[1];
  const S along = a + b * sigma;
  const S inverse = 1.0 / (a * along);
  const S q_r = b * (x * r_x + y * r_y);
  qdd[0] = (along * r_x - q_r * x) * inverse;
  qdd[1] = (along * r_y - q_r * y) * inverse;
}

/// The generalised force (2) of an acceleration.
inline void inverse_dynamics(const SingleSection& section, const double* q, const double* qd,
                             const double* qdd, double* force) noexcept {
  const double x = q[0], y = q[1];
  const auto v = ShapeTable::read(section.table.inertia, x * x + y * y);
  double h_x = 0.0, h_y = 0.0;
  section_bias(section, v, x, y, qd[0], qd[1], h_x, h_y);
  const double q_a = v[1] * (x * qdd[0] + y * qdd[1]);
  force[0] = v[0] * qdd[0] + q_a * x + h_x;
  force[1] = v[0] * qdd[1] + q_a * y + h_y;
}

void mass_matrix(const SingleSection& section, const ConstVectorRef& q, MatrixRef M) noexcept;
void bias(const SingleSection& section, const ConstVectorRef& q, const ConstVectorRef& qd,
          VectorRef h) noexcept;
[[nodiscard]] double kinetic_energy(const SingleSection& section, const ConstVectorRef& q,
                                    const ConstVectorRef& qd) noexcept;
[[nodiscard]] double potential_energy(const SingleSection& section,
                                      const ConstVectorRef& q) noexcept;
void potential_gradient(const SingleSection& section, const ConstVectorRef& q,
                        VectorRef gradient) noexcept;
void potential_hessian(const SingleSection& section, const ConstVectorRef& q, MatrixRef H) noexcept;
/// d(qdd)/dq and d(qdd)/dqd (2, 2) at a constant force (2); gives M^-1.
Eigen::Matrix2d acceleration_jacobians(const SingleSection& section, const ConstVectorRef& q,
                                       const ConstVectorRef& qd, const double* force,
                                       MatrixRef on_q, MatrixRef on_qd) noexcept;

}  // namespace closed_form
}  // namespace cdcr::detail
