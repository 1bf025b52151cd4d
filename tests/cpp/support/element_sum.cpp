#include "element_sum.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace cdcr::test {
namespace {

constexpr Real pi = 3.141592653589793238462643383279502884L;

/// Legendre polynomial of degree num_gauss and its derivative.
void legendre(Real x, Real& value, Real& slope) {
  Real before = 1.0L;
  value = x;
  for (int n = 2; n <= num_gauss; ++n) {
    const Real next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
    before = value;
    value = next;
  }
  slope = num_gauss * (x * value - before) / (x * x - 1.0L);
}

Quadrature make_gauss() {
  Quadrature rule;
  for (int i = 0; i < num_gauss; ++i) {
    Real x = std::cos(pi * (i + 0.75L) / (num_gauss + 0.5L));
    Real value = 0.0L, slope = 1.0L;
    for (int iteration = 0; iteration < 20; ++iteration) {
      legendre(x, value, slope);
      x -= value / slope;
    }
    legendre(x, value, slope);
    rule.node[i] = 0.5L * (1.0L + x);
    rule.weight[i] = 1.0L / ((1.0L - x * x) * slope * slope);
  }
  return rule;
}

Real sinc(Real y) {
  return y == 0.0L ? 1.0L : std::sin(y) / y;
}

Real33 hat(const Real3& v) {
  Real33 m;
  m << 0.0L, -v[2], v[1], v[2], 0.0L, -v[0], -v[1], v[0], 0.0L;
  return m;
}

}  // namespace

const Quadrature& gauss() {
  static const Quadrature rule = make_gauss();
  return rule;
}

Frame frame_at(Real length, Real x, const Real2& q) {
  const Real theta = std::hypot(q[0], q[1]);
  const Real y = x * theta;
  const Real half = sinc(0.5L * y);
  const Real A = 0.5L * half * half;  // (1 - cos y)/y^2 without its cancellation
  Frame frame;
  frame.r << length * x * x * A * q[0], length * x * x * A * q[1], length * x * sinc(y);
  // rot(Z, phi) rot(Y, y) rot(Z, -phi) turns by y about (-sin phi, cos phi, 0).
  const Real33 turn = x * hat(Real3(-q[1], q[0], 0.0L));
  frame.R = Real33::Identity() + sinc(y) * turn + A * turn * turn;
  return frame;
}

ElementSum::ElementSum(const Robot& robot) {
  const Section& s = robot.sections.at(0);
  length_ = s.length;
  const Real d = s.backbone_diameter;
  stiffness_ = static_cast<Real>(s.youngs_modulus) * pi * d * d * d * d / 64.0L / length_;
  damping_ = s.damping;
  gravity_ = robot.gravity.cast<Real>();
  const auto add = [this](Real x, Real mass, Real diameter) {
    const Real inertia = mass * diameter * diameter;
    elements_.push_back({x, mass, inertia / 16.0L, inertia / 8.0L});
  };
  for (int i = 0; i < num_gauss; ++i) {
    add(gauss().node[i], gauss().weight[i] * s.backbone_mass, s.backbone_diameter);
  }
  for (int k = 1; k <= s.num_disks; ++k) {
    add(static_cast<Real>(k) / s.num_disks, s.disk_mass, s.disk_diameter);
  }
  add(1.0L, robot.payload, 0.0L);
}

Real22 ElementSum::mass_matrix(const Real2& q) const {
  Real22 M = Real22::Zero();
  for (const Element& e : elements_) {
    if (e.mass == 0.0L) continue;
    const Real33 R = frame_at(length_, e.x, q).R;
    Eigen::Matrix<Real, 3, 2> v, omega;  // columns: velocity and body turning rate for qd = e_k
    for (int k = 0; k < 2; ++k) {
      const auto moved = [&](Real step) {
        return frame_at(length_, e.x, q + step * Real2::Unit(k));
      };
      v.col(k) = derivative<Real3>([&](Real step) -> Real3 { return moved(step).r; });
      const Real33 dR = derivative<Real33>([&](Real step) -> Real33 { return moved(step).R; });
      const Real33 rate = R.transpose() * dR;  // hat(omega)
      omega.col(k) =
          0.5L * Real3(rate(2, 1) - rate(1, 2), rate(0, 2) - rate(2, 0), rate(1, 0) - rate(0, 1));
    }
    const Real3 inertia(e.transverse, e.transverse, e.axial);
    M += e.mass * v.transpose() * v + omega.transpose() * inertia.asDiagonal() * omega;
  }
  return M;
}

Real ElementSum::kinetic_energy(const Real2& q, const Real2& qd) const {
  return 0.5L * qd.dot(mass_matrix(q) * qd);
}

Real ElementSum::potential_energy(const Real2& q) const {
  Real U = 0.5L * stiffness_ * q.squaredNorm();
  for (const Element& e : elements_) U -= e.mass * gravity_.dot(frame_at(length_, e.x, q).r);
  return U;
}

Real2 ElementSum::potential_gradient(const Real2& q) const {
  Real2 gradient;
  for (int k = 0; k < 2; ++k) {
    gradient[k] =
        derivative<Real>([&](Real step) { return potential_energy(q + step * Real2::Unit(k)); });
  }
  return gradient;
}

Real22 ElementSum::potential_hessian(const Real2& q) const {
  Real22 H;
  for (int k = 0; k < 2; ++k) {
    // A wider step: differences of differences feel rounding twice.
    H.col(k) = derivative<Real2>(
        [&](Real step) -> Real2 { return potential_gradient(q + step * Real2::Unit(k)); }, 0.02L);
  }
  return H;
}

Real2 ElementSum::bias(const Real2& q, const Real2& qd) const {
  // d/dt (M qd) at qdd = 0 is the derivative of M along qd; scaled to a step of unit length.
  const Real speed = qd.norm();
  Real2 momentum_rate = Real2::Zero();
  if (speed > 0.0L) {
    const Real2 direction = qd / speed;
    const Real22 M_rate =
        derivative<Real22>([&](Real step) -> Real22 { return mass_matrix(q + step * direction); });
    momentum_rate = speed * (M_rate * qd);
  }
  Real2 dT;
  for (int k = 0; k < 2; ++k) {
    dT[k] =
        derivative<Real>([&](Real step) { return kinetic_energy(q + step * Real2::Unit(k), qd); });
  }
  return momentum_rate - dT + potential_gradient(q) + damping_ * qd;
}

Real ElementSum::G_A(Real theta) const {
  Real sum = 0.0L;
  for (const Element& e : elements_) {
    const Real half = sinc(0.5L * e.x * theta);
    sum += e.mass * e.x * e.x * 0.5L * half * half;
  }
  return sum;
}

Real ElementSum::G_S(Real theta) const {
  Real sum = 0.0L;
  for (const Element& e : elements_) sum += e.mass * e.x * sinc(e.x * theta);
  return sum;
}

Real ElementSum::total_mass() const {
  Real sum = 0.0L;
  for (const Element& e : elements_) sum += e.mass;
  return sum;
}

Real ElementSum::weight_scale() const {
  return total_mass() * gravity_.norm() * length_;
}

}  // namespace cdcr::test
