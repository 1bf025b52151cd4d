#include "chain/single_section.hpp"

namespace cdcr::detail::closed_form {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Group = ShapeTable::Group;
using Values = ShapeTable::Values;

/// M^-1 X for M = a I + b q q^T.
Matrix2d solve_mass(double a, double b, const Vector2d& q, const Matrix2d& X) noexcept {
  const double factor = b / (a + b * q.squaredNorm());
  return (X - factor * q * (q.transpose() * X)) / a;
}

}  // namespace

void mass_matrix(const SingleSection& section, const ConstVectorRef& q, MatrixRef M) noexcept {
  const double x = q[0], y = q[1];
  const Values v = section.table(Group::inertia, x * x + y * y);
  M(0, 0) = v[0] + v[1] * x * x;
  M(0, 1) = M(1, 0) = v[1] * x * y;
  M(1, 1) = v[0] + v[1] * y * y;
}

void bias(const SingleSection& section, const ConstVectorRef& q, const ConstVectorRef& qd,
          VectorRef h) noexcept {
  const double x = q[0], y = q[1];
  const Values v = section.table(Group::inertia, x * x + y * y);
  section_bias(section, v, x, y, qd[0], qd[1], h[0], h[1]);
}

void inverse_dynamics(const SingleSection& section, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& qdd,
                      VectorRef force) noexcept {
  const double x = q[0], y = q[1];
  const Values v = section.table(Group::inertia, x * x + y * y);
  double h_x = 0.0, h_y = 0.0;
  section_bias(section, v, x, y, qd[0], qd[1], h_x, h_y);
  const double q_a = v[1] * (x * qdd[0] + y * qdd[1]);
  force[0] = v[0] * qdd[0] + q_a * x + h_x;
  force[1] = v[0] * qdd[1] + q_a * y + h_y;
}

double kinetic_energy(const SingleSection& section, const ConstVectorRef& q,
                      const ConstVectorRef& qd) noexcept {
  const Values v = section.table(Group::inertia, q.squaredNorm());
  const double p = q.dot(qd);
  return 0.5 * (v[0] * qd.squaredNorm() + v[1] * p * p);
}

double potential_energy(const SingleSection& section, const ConstVectorRef& q) noexcept {
  const double sigma = q.squaredNorm();
  const Values v = section.table(Group::gravity, sigma);
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
  const auto [G_A, G_S, dG_A, dG_S] = section.table(Group::gravity, sigma);
  const auto second = section.table(Group::second, sigma);
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

void acceleration_jacobians(const SingleSection& section, const ConstVectorRef& q_in,
                            const ConstVectorRef& qd_in, const ConstVectorRef& force,
                            MatrixRef on_q, MatrixRef on_qd) noexcept {
  const Vector2d q = q_in, qd = qd_in;
  Eigen::Vector2d qdd;
  forward_dynamics(section, q_in.data(), qd_in.data(), force.data(), qdd.data());

  const double sigma = q.squaredNorm();
  const auto [a, b, da, db] = section.table(Group::inertia, sigma);
  const auto second = section.table(Group::second, sigma);
  const double dda = second[0], ddb = second[1];
  const double p = q.dot(qd), w = qd.squaredNorm(), q_qdd = q.dot(qdd);
  const Matrix2d identity = Matrix2d::Identity();

  // With N(q, qd) = M(q) qdd + h(q, qd) at fixed qdd:  d qdd = -M^-1 dN.
  Matrix2d stiffness;
  potential_hessian(section, q_in, stiffness);
  const Matrix2d dN_q = stiffness + 2.0 * da * qdd * q.transpose()  // a qdd
                        + b * q_qdd * identity +
                        q * (b * qdd + 2.0 * db * q_qdd * q).transpose()        // b q (q.qdd)
                        + 2.0 * qd * (da * qd + 2.0 * dda * p * q).transpose()  // 2 a' p qd
                        + (db * p * p + (b - da) * w) * identity +
                        2.0 * q * (db * p * qd + (ddb * p * p + (db - dda) * w) * q).transpose();
  const Matrix2d dN_qd = (2.0 * da * p + section.damping) * identity +
                         2.0 * da * qd * q.transpose() +
                         2.0 * q * (db * p * q + (b - da) * qd).transpose();

  on_q = -solve_mass(a, b, q, dN_q);
  on_qd = -solve_mass(a, b, q, dN_qd);
}

void solve_mass(const SingleSection& section, const ConstVectorRef& q, const MatrixXd& rows,
                MatrixRef solution) noexcept {
  const Vector2d bending = q;
  const auto inertia = section.table(Group::inertia, bending.squaredNorm());
  const Matrix2d inverse = solve_mass(inertia[0], inertia[1], bending, Matrix2d::Identity());
  for (Index j = 0; j < rows.cols(); ++j) {
    solution.col(j).noalias() = inverse * rows.col(j).head<2>();
  }
}

}  // namespace cdcr::detail::closed_form
