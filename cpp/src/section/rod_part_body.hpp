#pragma once

#include "section/rod_frames_body.hpp"
#include "section/rod_part.hpp"

// Bodies of RodPart.

// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result): counts of rows and coordinates,
// all small

namespace cdcr::detail {

template <class S>
void RodPart<S>::update_position(const SectionParameters& section, const FrameState<S>& at,
                                 const S* q, double fraction) {
  if (fraction == 1.0) {
    RodFrames<S> frames;
    frames.update_position(section, at, q);
    r = frames.r;
    J_omega = frames.J_omega;
    J_v = frames.J_v;
    axes_ = frames.axes;
    return;
  }
  const RodParameters& rod = *section.rod;
  axes_ = at.rotation();
  r.setZero();
  J_omega.setZero(3, rod.size());
  J_v.setZero(3, rod.size());
  const double h = fraction / num_steps;
  Derivatives from(*this, rod, 0.0, q), to;
  for (int k = 1; k <= num_steps; ++k) {
    const double x = k * h;
    turn(*section.arcs, rod, step_of(x - h, x), q);
    to = Derivatives(*this, rod, x, q);
    // The polynomial of degree five that has dr/dx and its two next derivatives at both ends.
    r += (h / 2.0) * (from.d[0] + to.d[0]) + (h * h / 10.0) * (from.d[1] - to.d[1]) +
         (h * h * h / 120.0) * (from.d[2] + to.d[2]);
    J_v += (h / 2.0) * (from.J[0] + to.J[0]) + (h * h / 10.0) * (from.J[1] - to.J[1]) +
           (h * h * h / 120.0) * (from.J[2] + to.J[2]);
    from = to;
  }
}

template <class S>
RodPart<S>::Derivatives::Derivatives(const RodPart& part, const RodParameters& rod, double x,
                                     const S* q) {
  const auto P = legendre(x), P1 = legendre_slope(x), P2 = legendre_curve(x);
  S q_x(rod.locked_turning[1]), q_y(-rod.locked_turning[0]), t(rod.locked_turning[2]);
  S q_x1(0.0), q_y1(0.0), L(rod.length), L1(0.0), L2(0.0);
  for (int i = 0; i < rod.num_bending; ++i) {
    q_x += P[i] * q[2 * i];
    q_y += P[i] * q[2 * i + 1];
    q_x1 += P1[i] * q[2 * i];
    q_y1 += P1[i] * q[2 * i + 1];
  }
  for (int i = 0; i < rod.num_twist; ++i) t += P[i] * q[rod.first_twist + i];
  for (int i = 0; i < rod.num_stretch; ++i) {
    const S& e = q[rod.first_stretch + i];
    L += P[i] * e;
    L1 += P1[i] * e;
    L2 += P2[i] * e;
  }
  const Matrix3<S>& R = part.axes_;
  const S zero(0.0);
  d[0] = L * R.col(2);
  d[1] = R * Vector3<S>(L * q_x, L * q_y, L1);
  d[2] = R * Vector3<S>(2.0 * L1 * q_x + L * (q_x1 - t * q_y),
                        2.0 * L1 * q_y + L * (q_y1 + t * q_x), L2 - L * (q_x * q_x + q_y * q_y));
  for (std::size_t k = 0; k < 3; ++k) {
    J[k].setZero(3, rod.size());
    for (int i = 0; i < rod.first_stretch; ++i) {
      J[k].col(i) = Vector3<S>(part.J_omega.col(i)).cross(d[k]);
    }
  }
  for (int i = 0; i < rod.num_bending; ++i) {
    J[1].col(2 * i) += (P[i] * L) * R.col(0);
    J[1].col(2 * i + 1) += (P[i] * L) * R.col(1);
    const S along = 2.0 * P[i] * L1 + P1[i] * L, across = P[i] * t * L;
    J[2].col(2 * i) += R * Vector3<S>(along, across, -2.0 * P[i] * L * q_x);
    J[2].col(2 * i + 1) += R * Vector3<S>(-across, along, -2.0 * P[i] * L * q_y);
  }
  for (int i = 0; i < rod.num_twist; ++i) {
    J[2].col(rod.first_twist + i) += R * Vector3<S>(-P[i] * L * q_y, P[i] * L * q_x, zero);
  }
  for (int i = 0; i < rod.num_stretch; ++i) {
    const int column = rod.first_stretch + i;
    J[0].col(column) = P[i] * R.col(2);
    J[1].col(column) = R * Vector3<S>(P[i] * q_x, P[i] * q_y, S(P1[i]));
    J[2].col(column) = R * Vector3<S>(2.0 * P1[i] * q_x + P[i] * (q_x1 - t * q_y),
                                      2.0 * P1[i] * q_y + P[i] * (q_y1 + t * q_x),
                                      P2[i] - P[i] * (q_x * q_x + q_y * q_y));
  }
}

template <class S>
void RodPart<S>::turn(const ArcTable& arcs, const RodParameters& rod, const Step& step,
                      const S* q) {
  std::array<Vector3<S>, 3> alpha;
  for (std::size_t i = 0; i < 3; ++i) {
    alpha[i] = step[i][0] * rod.locked_turning.template cast<S>();
    for (int j = 0; j < rod.num_bending; ++j) {
      alpha[i][0] -= step[i][j] * q[2 * j + 1];
      alpha[i][1] += step[i][j] * q[2 * j];
    }
    for (int j = 0; j < rod.num_twist; ++j) alpha[i][2] += step[i][j] * q[rod.first_twist + j];
  }
  const Magnus<S> magnus(alpha[0], alpha[1], alpha[2]);
  const Vector3<S>& Omega = magnus.Omega;
  ArcValues<S> f;
  read_arcs(arcs, S(Omega.squaredNorm()), f);
  Matrix3<S> cross;
  cross << S(0.0), -Omega[2], Omega[1], Omega[2], S(0.0), -Omega[0], -Omega[1], Omega[0], S(0.0);
  const Matrix3<S> once = axes_ * cross, twice = once * cross;
  const Matrix3<S> tangent = axes_ + f[arc_a] * once + f[arc_g] * twice;
  std::array<Matrix3<S>, 3> slope;
  magnus.slopes(slope);
  for (std::size_t i = 0; i < 3; ++i) {
    const Matrix3<S> turning = tangent * slope[i];
    for (int j = 0; j < rod.num_bending; ++j) {
      J_omega.col(2 * j) += step[i][j] * turning.col(1);
      J_omega.col(2 * j + 1) -= step[i][j] * turning.col(0);
    }
    for (int j = 0; j < rod.num_twist; ++j) {
      J_omega.col(rod.first_twist + j) += step[i][j] * turning.col(2);
    }
  }
  axes_ += f[arc_s] * once + f[arc_a] * twice;
}

}  // namespace cdcr::detail

// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)
