#include "chain/single_section.hpp"

namespace cdcr::detail::closed_form {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Values = ShapeTable::Values;

/// M^-1 for M = a I + b q q^T, with one division.
Matrix2d inverse_mass(double a, double b, const Vector2d& q) noexcept {
  const double along = a + b * q.squaredNorm();
  const double inverse = 1.0 / (a * along);
  Matrix2d result = (-b * inverse * q).lazyProduct(q.transpose());
  result.diagonal().array() += along * inverse;
  return result;
}

}  // namespace

void mass_matrix(const SingleSection& section, const ConstVectorRef& q, MatrixRef M) noexcept {
  const double x = q[0], y = q[1];
  const Values v = ShapeTable::read(section.table.inertia, x * x + y * y);
  M(0, 0) = v[0] + v[1] * x * x;
  M(0, 1) = M(1, 0) = v[1] * x * y;
  M(1, 1) = v[0] + v[1] * y * y;
}

void bias(const SingleSection& section, const ConstVectorRef& q, const ConstVectorRef& qd,
          VectorRef h) noexcept {
  const double x = q[0], y = q[1];
  const Values v = ShapeTable::read(section.table.inertia, x * x + y * y);
  section_bias(section, v, x, y, qd[0], qd[1], h[0], h[1]);
}

double kinetic_energy(const SingleSection& section, const ConstVectorRef& q,
                      const ConstVectorRef& qd) noexcept {
  const Values v = ShapeTable::read(section.table.inertia, q.squaredNorm());
  const double p = q.dot(qd);
  return 0.5 * (v[0] * qd.squaredNorm() + v[1] * p * p);
}

double potential_energy(const SingleSection& section, const ConstVectorRef& q) noexcept {
  const double sigma = q.squaredNorm();
  const Values v = ShapeTable::read(section.table.gravity, sigma);
  const Vector3d& g = section.gravity;
  const double l = section.length;
  return 0.5 * section.stiffness * sigma - l * (g.head<2>().dot(q) * v[0] + g[2] * v[1]);
}

void potential_gradient(const SingleSection& section, const ConstVectorRef& q,
                        VectorRef gradient) noexcept {
  const double x = q[0], y = q[1];
  gradient = section.stiffness * q;
  // Without gravity too, for the NaN beyond the bending limit.
  add_weight(section, x, y, x * x + y * y, gradient[0], gradient[1]);
}

void potential_hessian(const SingleSection& section, const ConstVectorRef& q,
                       MatrixRef H) noexcept {
  const double x = q[0], y = q[1], sigma = x * x + y * y;
  const auto [G_A, G_S, dG_A, dG_S] = ShapeTable::read(section.table.gravity, sigma);
  const auto second = ShapeTable::read(section.table.second, sigma);
  const Vector3d& g = section.gravity;
  const double l = section.length;
  const double g_q = g[0] * x + g[1] * y;
  const double on_identity = section.stiffness - 2.0 * l * (g_q * dG_A + g[2] * dG_S);
  const double on_q_q = -4.0 * l * (g_q * second[2] + g[2] * second[3]);
  const double cross = -2.0 * l * dG_A;  // (g_xy q^T + q g_xy^T) G_A'
  H(0, 0) = on_identity + on_q_q * x * x + 2.0 * cross * g[0] * x;
  H(1, 1) = on_identity + on_q_q * y * y + 2.0 * cross * g[1] * y;
  H(0, 1) = H(1, 0) = on_q_q * x * y + cross * (g[0] * y + g[1] * x);
}

Matrix2d acceleration_jacobians(const SingleSection& section, const ConstVectorRef& q_in,
                                const ConstVectorRef& qd_in, const double* force, MatrixRef on_q,
                                MatrixRef on_qd) noexcept {
  const Vector2d q = q_in, qd = qd_in;
  Vector2d qdd;
  forward_dynamics(section, q_in.data(), qd_in.data(), force, qdd.data());

  const double sigma = q.squaredNorm();
  const auto [a, b, da, db] = ShapeTable::read(section.table.inertia, sigma);
  const auto [dda, ddb, ddG_A, ddG_S] = ShapeTable::read(section.table.second, sigma);
  const double p = q.dot(qd), w = qd.squaredNorm(), q_qdd = q.dot(qdd);

  // With N(q, qd) = M(q) qdd + h(q, qd) at fixed qdd:  d qdd = -M^-1 dN.
  const double on_identity = b * q_qdd + db * p * p + (b - da) * w;
  const double on_q_q = 2.0 * (db * q_qdd + ddb * p * p + (db - dda) * w);
  Matrix2d dN_q;
  potential_hessian(section, q_in, dN_q);
  dN_q.diagonal().array() += on_identity;
  dN_q += (2.0 * da * qdd + 4.0 * dda * p * qd + on_q_q * q) * q.transpose() +
          q * (b * qdd + 2.0 * db * p * qd).transpose() + 2.0 * da * qd * qd.transpose();
  Matrix2d dN_qd =
      2.0 * da * qd * q.transpose() + 2.0 * q * (db * p * q + (b - da) * qd).transpose();
  dN_qd.diagonal().array() += 2.0 * da * p + section.damping;

  const Matrix2d inverse = inverse_mass(a, b, q);
  on_q = -inverse.lazyProduct(dN_q);
  on_qd = -inverse.lazyProduct(dN_qd);
  return inverse;
}

}  // namespace cdcr::detail::closed_form
