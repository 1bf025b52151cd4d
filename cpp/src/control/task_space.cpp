#include "cdcr/task_space.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>

#include "base/arguments.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/robot_ode.hpp"

namespace cdcr {
namespace {

// Step of the difference that gives J' qd, as a motion of the fastest coordinate [rad]: its error
// and that of rounding are about 1e-10 of the tip's acceleration.
constexpr double difference = 1e-5;

}  // namespace

TaskSpace::TaskSpace(const Model& model, TaskSpaceOptions options)
    : TrackingController(model, options.period, options.limits, true),
      data_(model),
      options_(std::move(options)),
      lead_(options_.lead.value_or(options_.period / 2.0)),
      ahead_at_(3),
      posture_(options_.posture.size() == 0 ? model.rest() : options_.posture) {
  const Index d = model.num_coordinates();
  require_inertia(model);
  options_.kp.require("kp", 3, "1/s^2");
  options_.kd.require("kd", 3, "1/s");
  detail::require_not_negative("posture_kp", options_.posture_kp, "1/s^2");
  detail::require_not_negative("posture_kd", options_.posture_kd, "1/s");
  detail::require_not_negative("lead", lead_, "s");
  detail::require_not_negative("delay", options_.delay, "s");
  detail::require_positive("damping", options_.damping, "1/rad");
  detail::require_finite("posture", posture_, d);
  require_shape("posture", model, posture_);
  for (const Section& section : model.robot().sections) damping_ += section.length;
  damping_ *= options_.damping;
  q_ = qd_ = near_ = qdd_ = free_ = force_ = VectorXd::Zero(d);
  error_ = task_ = bias_ = solved_ = VectorXd::Zero(3);
  J_ = near_J_ = MatrixXd::Zero(6, d);
  M_ = MatrixXd::Zero(d, d);
}

/// bias_: J' qd, the tip's acceleration that velocities make.
void TaskSpace::set_velocity_terms(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept {
  const double fastest = qd.lpNorm<Eigen::Infinity>();
  bias_.setZero();
  if (fastest == 0.0) return;
  const double step = difference / fastest;
  for (const double side : {1.0, -1.0}) {
    near_ = q + side * step * qd;
    tip_jacobian(model(), near_, near_J_);
    bias_.noalias() += (side / (2.0 * step)) * (near_J_.topRows<3>() * qd);
  }
}

/// inverse_: of J J^T, its eigenvalues not below the squared damping, eq. (108).
void TaskSpace::set_inverse() noexcept {
  const Matrix3d normal = J_.topRows<3>() * J_.topRows<3>().transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(normal);
  const Vector3d values = solver.eigenvalues().cwiseMax(damping_ * damping_);
  inverse_ = solver.eigenvectors() * values.cwiseInverse().asDiagonal() *
             solver.eigenvectors().transpose();
}

/// qdd_: what brings the tip to what is wanted, and the posture where the tip leaves it free.
void TaskSpace::set_acceleration(const Setpoint& wanted, const ConstVectorRef& q,
                                 const ConstVectorRef& qd) noexcept {
  tip_jacobian(model(), q, J_);
  set_velocity_terms(q, qd);
  const auto J = J_.topRows<3>();
  set_inverse();

  task_ = wanted.acceleration - bias_;
  error_ = wanted.rate;
  error_.noalias() -= J * qd;
  options_.kd.add(error_, task_);
  error_ = wanted.value - tip(model(), q).p;
  options_.kp.add(error_, task_);

  // Beside the tip: free - J^+ J free, which the tip does not see.
  free_ = options_.posture_kp * (posture_ - q) - options_.posture_kd * qd;
  task_.noalias() -= J * free_;
  qdd_ = free_;
  solved_.noalias() = inverse_ * task_;
  qdd_.noalias() += J.transpose() * solved_;
}

/// force_: what makes the acceleration qdd_ at (q, qd), as far as the cables can.
void TaskSpace::set_force(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept {
  inverse_dynamics(model(), data_, q, qd, qdd_, force_);
  if (drive().is_fully_actuated() || !force_.allFinite()) return;
  mass_matrix(model(), data_, q, M_);
  drive().project(q, M_, force_);
}

Status TaskSpace::control(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                          const Setpoint& wanted) noexcept {
  const double delay = options_.delay, horizon = delay + lead_;
  if (delay > 0.0) {
    path().evaluate(t - delay, ahead_at_);
    set_acceleration(ahead_at_, q, qd);
  } else {
    set_acceleration(wanted, q, qd);
  }
  note_error(error_.norm());
  q_ = q;
  qd_ = qd;
  if (horizon > 0.0) {  // as in computed torque, eq. (106)
    if (!drive().is_fully_actuated()) {
      set_force(q, qd);
      forward_dynamics_force(model(), data_, q, qd, force_, qdd_);
    }
    q_ += horizon * qd + (horizon * horizon / 2.0) * qdd_;
    qd_ += horizon * qdd_;
    path().evaluate(t + lead_, ahead_at_);
    set_acceleration(ahead_at_, q_, qd_);
  }
  set_force(q_, qd_);
  if (!force_.allFinite()) return Status::non_finite_state;
  (void)give(q_, qd_, force_);
  return Status::ok;
}

}  // namespace cdcr
