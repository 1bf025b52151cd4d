#include "cdcr/linearization.hpp"

#include "cdcr/dynamics.hpp"

namespace cdcr {
namespace {

using Group = detail::ShapeTable::Group;
using Eigen::Matrix2d;
using Eigen::Vector2d;

/// M^-1 X for M = a I + b q q^T.
Matrix2d solve_mass(double a, double b, const Vector2d& q, const Matrix2d& X) noexcept {
  const double factor = b / (a + b * q.squaredNorm());
  return (X - factor * q * (q.transpose() * X)) / a;
}

}  // namespace

void state_jacobian(const Model& model, Data& data, const ConstVectorRef& q_in,
                    const ConstVectorRef& qd_in, const ConstVectorRef& force,
                    MatrixRef A) noexcept {
  const Vector2d q = q_in, qd = qd_in;
  forward_dynamics_force(model, data, q_in, qd_in, force, data.acceleration);
  const Vector2d qdd = data.acceleration;

  const double sigma = q.squaredNorm();
  const auto [a, b, da, db] = model.table(0)(Group::inertia, sigma);
  const auto second = model.table(0)(Group::second, sigma);
  const double dda = second[0], ddb = second[1];
  const double p = q.dot(qd), w = qd.squaredNorm(), q_qdd = q.dot(qdd);
  const Matrix2d identity = Matrix2d::Identity();

  // With N(q, qd) = M(q) qdd + h(q, qd) at fixed qdd:  d qdd = -M^-1 dN.
  Matrix2d stiffness;
  potential_hessian(model, data, q_in, stiffness);
  const Matrix2d dN_q = stiffness + 2.0 * da * qdd * q.transpose()  // a qdd
                        + b * q_qdd * identity +
                        q * (b * qdd + 2.0 * db * q_qdd * q).transpose()        // b q (q.qdd)
                        + 2.0 * qd * (da * qd + 2.0 * dda * p * q).transpose()  // 2 a' p qd
                        + (db * p * p + (b - da) * w) * identity +
                        2.0 * q * (db * p * qd + (ddb * p * p + (db - dda) * w) * q).transpose();
  const Matrix2d dN_qd = (2.0 * da * p + model.damping()[0]) * identity +
                         2.0 * da * qd * q.transpose() +
                         2.0 * q * (db * p * q + (b - da) * qd).transpose();

  A.topLeftCorner<2, 2>().setZero();
  A.topRightCorner<2, 2>().setIdentity();
  A.bottomLeftCorner<2, 2>() = -solve_mass(a, b, q, dN_q);
  A.bottomRightCorner<2, 2>() = -solve_mass(a, b, q, dN_qd);
}

void linearize(const Model& model, Data& data, const ConstVectorRef& q, const ConstVectorRef& qd,
               const ConstVectorRef& tension, MatrixRef A, MatrixRef B) noexcept {
  actuation_force(model, tension, data.force);
  state_jacobian(model, data, q, qd, data.force, A);

  const Vector2d bending = q;
  const auto inertia = model.table(0)(Group::inertia, bending.squaredNorm());
  const Matrix2d inverse_mass = solve_mass(inertia[0], inertia[1], bending, Matrix2d::Identity());
  B.topRows<2>().setZero();
  for (Index j = 0; j < model.num_cables(); ++j) {
    B.col(j).tail<2>().noalias() = inverse_mass * model.actuation_matrix().col(j).head<2>();
  }
}

}  // namespace cdcr
