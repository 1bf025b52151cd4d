#pragma once

#include "chain/single_section.hpp"

// Functions of one section in closed form on packs, as those of chain/single_section.cpp on
// doubles.

namespace cdcr::detail::closed_form {

template <class S>
[[gnu::always_inline]] inline void bias(const SingleSection& section, const S* q, const S* qd,
                                        S* h) noexcept {
  const S x = q[0], y = q[1];
  const auto v = ShapeTable::read(section.table.inertia, S(x * x + y * y));
  S h_x(0.0), h_y(0.0);
  section_bias<S>(section, v, x, y, qd[0], qd[1], h_x, h_y);
  h[0] = h_x;
  h[1] = h_y;
}

/// M = a I + b q q^T, eq. (11), of which M(0, 0), M(0, 1) and M(1, 1).
template <class S>
[[gnu::always_inline]] inline void mass_matrix(const SingleSection& section, const S* q, S& M_xx,
                                               S& M_xy, S& M_yy) noexcept {
  const S x = q[0], y = q[1];
  const auto v = ShapeTable::read(section.table.inertia, S(x * x + y * y));
  M_xx = v[0] + v[1] * x * x;
  M_xy = v[1] * x * y;
  M_yy = v[0] + v[1] * y * y;
}

template <class S>
[[gnu::always_inline]] inline void kinetic_energy(const SingleSection& section, const S* q,
                                                  const S* qd, S& T) noexcept {
  const auto v = ShapeTable::read(section.table.inertia, S(q[0] * q[0] + q[1] * q[1]));
  const S p = q[0] * qd[0] + q[1] * qd[1];
  T = 0.5 * (v[0] * (qd[0] * qd[0] + qd[1] * qd[1]) + v[1] * p * p);
}

template <class S>
[[gnu::always_inline]] inline void potential_energy(const SingleSection& section, const S* q,
                                                    S& U) noexcept {
  const S sigma = q[0] * q[0] + q[1] * q[1];
  const auto v = ShapeTable::read(section.table.gravity, sigma);
  const Vector3d& g = section.gravity;
  U = (0.5 * section.stiffness) * sigma -
      section.length * ((g[0] * q[0] + g[1] * q[1]) * v[0] + g[2] * v[1]);
}

template <class S>
[[gnu::always_inline]] inline void potential_gradient(const SingleSection& section, const S* q,
                                                      S* gradient) noexcept {
  const S x = q[0], y = q[1];
  S dU_x = section.stiffness * x, dU_y = section.stiffness * y;
  // Without gravity too, for the NaN beyond the bending limit.
  add_weight<S>(section, x, y, S(x * x + y * y), dU_x, dU_y);
  gradient[0] = dU_x;
  gradient[1] = dU_y;
}

}  // namespace cdcr::detail::closed_form
