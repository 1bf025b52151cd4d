#include "cdcr/kinematics.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace cdcr {
namespace {

/// A(y), S(y) and their derivatives with respect to y^2, for s = y^2.
struct Arc {
  double A, S, dA, dS;
};

// Below this y^2 the quotients cancel and their power series are exact to rounding.
constexpr double series_limit = 0.5;

/// sum over k of (-s)^k / (2k + offset)! and its derivative with respect to s: the series of
/// S (offset 1), A (offset 2) and G (offset 3).
void power_series(double s, int offset, double& value, double& derivative) noexcept {
  constexpr int last = 10;
  double coefficient[last + 1];
  coefficient[0] = offset == 1 ? 1.0 : offset == 2 ? 1.0 / 2.0 : 1.0 / 6.0;
  for (int k = 1; k <= last; ++k) {
    const double n = 2.0 * k + offset;
    coefficient[k] = -coefficient[k - 1] / (n * (n - 1.0));
  }
  value = coefficient[last];
  derivative = 0.0;
  for (int k = last - 1; k >= 0; --k) {
    derivative = derivative * s + value;
    value = value * s + coefficient[k];
  }
}

Arc arc(double s) noexcept {
  Arc f{};
  if (s < series_limit) {
    power_series(s, 2, f.A, f.dA);
    power_series(s, 1, f.S, f.dS);
    return f;
  }
  const double y = std::sqrt(s);
  const double half = std::sin(0.5 * y);
  f.A = 2.0 * half * half / s;
  f.S = std::sin(y) / y;
  f.dA = (0.5 * f.S - f.A) / s;
  f.dS = 0.5 * (std::cos(y) - f.S) / s;
  return f;
}

/// Frame and Jacobian of one section at fraction x, in the frame of its base.
struct SectionFrame {
  Pose at;
  Eigen::Matrix<double, 6, 2> J;
};

Pose section_pose(double length, double x, const Vector3d& q3, const Arc& f) noexcept {
  Pose at;
  at.p = length * x * (x * f.A * q3 + f.S * Vector3d::UnitZ());  // eq. (2)
  // Rotation by y = x theta about z x q / theta, eq. (3), by Rodrigues' formula in A and S.
  const Vector3d turn = x * Vector3d(-q3[1], q3[0], 0.0);
  Matrix3d hat;
  hat << 0.0, 0.0, turn[1], 0.0, 0.0, -turn[0], -turn[1], turn[0], 0.0;
  at.R = Matrix3d::Identity() + f.S * hat + f.A * hat * hat;
  return at;
}

SectionFrame section_frame(double length, double x, const Vector3d& q3) noexcept {
  const double s = x * x * q3.squaredNorm();
  const Arc f = arc(s);
  SectionFrame out;
  out.at = section_pose(length, x, q3, f);

  // dr/dq = alpha E + 2 (alpha' q3 + beta' z) q^T with alpha = l x^2 A, beta = l x S, eq. (4).
  const Vector3d along = 2.0 * length * x * x * x * (x * f.dA * q3 + f.dS * Vector3d::UnitZ());
  // omega = left Jacobian of SO(3) at x (z x q) times x (z x qd), eq. (5):
  // J_l = I + A [phi]^ + G [phi]^2 with G = (y - sin y)/y^3 = (1 - S)/y^2.
  const Vector3d turn = x * Vector3d(-q3[1], q3[0], 0.0);
  double series = 0.0, unused = 0.0;
  if (s < series_limit) power_series(s, 3, series, unused);
  const double G = s < series_limit ? series : (1.0 - f.S) / s;
  for (int k = 0; k < 2; ++k) {
    const Vector3d e = Vector3d::Unit(k);
    const Vector3d rate = x * Vector3d(-e[1], e[0], 0.0);
    out.J.col(k).head<3>() = length * x * x * f.A * e + along * q3[k];
    out.J.col(k).tail<3>() = rate + f.A * turn.cross(rate) + G * turn.cross(turn.cross(rate));
  }
  return out;
}

Vector3d bending3(const ConstVectorRef& q, Index section) noexcept {
  return {q[2 * section], q[2 * section + 1], 0.0};
}

}  // namespace

Pose pose(const Model& model, const ConstVectorRef& q, Index section, double fraction) noexcept {
  Pose base{model.robot().base_orientation, Vector3d::Zero()};
  for (Index i = 0; i <= section; ++i) {
    const double x = i == section ? fraction : 1.0;
    const Vector3d q3 = bending3(q, i);
    const Pose local =
        section_pose(model.robot().sections[i].length, x, q3, arc(x * x * q3.squaredNorm()));
    base.p += base.R * local.p;
    base.R = (base.R * local.R).eval();
  }
  return base;
}

Pose tip(const Model& model, const ConstVectorRef& q) noexcept {
  return pose(model, q, model.num_sections() - 1, 1.0);
}

void jacobian(const Model& model, const ConstVectorRef& q, Index section, double fraction,
              MatrixRef J) noexcept {
  J.setZero();
  Pose base{model.robot().base_orientation, Vector3d::Zero()};
  for (Index i = 0; i <= section; ++i) {
    const double x = i == section ? fraction : 1.0;
    const SectionFrame frame = section_frame(model.robot().sections[i].length, x, bending3(q, i));
    const Vector3d arm = base.R * frame.at.p;
    // Sections before this one carry its end along: v += omega x arm.
    for (Index k = 0; k < 2 * i; ++k) {
      J.col(k).head<3>() -= arm.cross(J.col(k).tail<3>()).eval();
    }
    J.block<3, 2>(0, 2 * i).noalias() = base.R * frame.J.topRows<3>();
    J.block<3, 2>(3, 2 * i).noalias() = base.R * frame.J.bottomRows<3>();
    base.p += arm;
    base.R = (base.R * frame.at.R).eval();
  }
}

void cable_lengths(const Model& model, const ConstVectorRef& q, VectorRef lengths) noexcept {
  lengths = model.straight_lengths();
  lengths.noalias() -= model.actuation_matrix().transpose() * q;
}

}  // namespace cdcr
