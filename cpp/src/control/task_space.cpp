#include "cdcr/task_space.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>

#include "base/arguments.hpp"
#include "base/rotation.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/robot_ode.hpp"

namespace cdcr {
namespace {

// Step of the difference that gives J' qd, as a motion of the fastest coordinate [rad]: its error
// and that of rounding are about 1e-10 of the tip's acceleration.
constexpr double difference = 1e-5;

/// Angular velocity and acceleration of the rotation of a vector u that changes: J_l u' and its
/// rate, cpp/control.md eq. (91).
struct Turning {
  Vector3d velocity, acceleration;
};

Turning turning_of(const Vector3d& u, const Vector3d& rate, const Vector3d& second) noexcept {
  const double s = u.squaredNorm();
  double a = 0.0, b = 0.0, da = 0.0, db = 0.0;  // J_l = 1 + a u^ + b u^ u^, and d/ds
  if (s < 1e-2) {                               // where closed forms lose digits
    a = 1.0 / 2 - s * (1.0 / 24 - s * (1.0 / 720 - s / 40320));
    b = 1.0 / 6 - s * (1.0 / 120 - s * (1.0 / 5040 - s / 362880));
    da = -1.0 / 24 + s * (1.0 / 360 - s * (1.0 / 13440 - s / 907200));
    db = -1.0 / 120 + s * (1.0 / 2520 - s * (1.0 / 120960 - s / 9979200));
  } else {
    const double angle = std::sqrt(s), cosine = std::cos(angle), c = std::sin(angle) / angle;
    a = (1.0 - cosine) / s;
    b = (1.0 - c) / s;
    da = (c / 2.0 - a) / s;
    db = ((c - cosine) / (2.0 * s) - b) / s;
  }
  const double ds = 2.0 * u.dot(rate);
  const Vector3d turn = u.cross(rate), twice = u.cross(turn), on = u.cross(second);
  return {rate + a * turn + b * twice, second + a * on + b * u.cross(on) + da * ds * turn +
                                           db * ds * twice + b * rate.cross(turn)};
}

/// The inverse of J J^T, its eigenvalues not below `least`, eq. (91).
template <int size>
void set_inverse(const MatrixXd& J, double least, MatrixXd& inverse) noexcept {
  using Square = Eigen::Matrix<double, size, size>;
  const Square normal = J.topRows<size>() * J.topRows<size>().transpose();
  const Eigen::SelfAdjointEigenSolver<Square> solver(normal);
  const Eigen::Matrix<double, size, 1> values = solver.eigenvalues().cwiseMax(least);
  inverse = solver.eigenvectors() * values.cwiseInverse().asDiagonal() *
            solver.eigenvectors().transpose();
}

}  // namespace

TaskSpace::TaskSpace(const Model& model, TaskSpaceOptions options)
    : TrackingController(
          model, options.period, options.limits,
          options.orientation_weight.size() == 0 ? Follows::position : Follows::pose),
      data_(model),
      options_(std::move(options)),
      lead_(options_.lead.value_or(options_.period / 2.0)),
      ahead_at_(path().size()),
      posture_(options_.posture.size() == 0 ? model.rest() : options_.posture) {
  const Index d = model.num_coordinates(), size = path().size();
  require_inertia(model);
  options_.kp.require("kp", size, "1/s^2");
  options_.kd.require("kd", size, "1/s");
  const VectorXd& weight = options_.orientation_weight;
  detail::require(weight.size() <= 1 || weight.size() == 3,
                  "orientation_weight must be one number or three [m/rad], got ", weight.size());
  for (const double one : weight) detail::require_not_negative("orientation_weight", one, "m/rad");
  if (weight.size() == 1) options_.orientation_weight = VectorXd::Constant(3, weight[0]);
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
  error_ = rate_error_ = task_ = bias_ = solved_ = VectorXd::Zero(size);
  J_ = MatrixXd::Zero(size, d);
  tip_J_ = MatrixXd::Zero(6, d);
  M_ = MatrixXd::Zero(d, d);
  inverse_ = MatrixXd::Zero(size, size);
}

/// bias_: J' qd, the tip's acceleration that velocities make.
void TaskSpace::set_velocity_terms(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept {
  const double fastest = qd.lpNorm<Eigen::Infinity>();
  bias_.setZero();
  if (fastest == 0.0) return;
  const double step = difference / fastest;
  for (const double side : {1.0, -1.0}) {
    near_ = q + side * step * qd;
    tip_jacobian(model(), near_, tip_J_);
    bias_.noalias() += (side / (2.0 * step)) * (tip_J_.topRows(bias_.size()) * qd);
  }
}

/// error_, rate_error_, and task_: the acceleration wanted less what velocities make; J_ is the
/// tip's Jacobian. All of orientation are vectors in the base frame.
void TaskSpace::set_errors(const Setpoint& wanted, const ConstVectorRef& q,
                           const ConstVectorRef& qd) noexcept {
  const Pose at = tip(model(), q);
  error_.head<3>() = wanted.value.head<3>() - at.p;
  rate_error_ = wanted.rate;
  task_ = wanted.acceleration - bias_;
  if (turns()) {
    const Vector3d u = wanted.value.tail<3>();
    const Turning turning = turning_of(u, wanted.rate.tail<3>(), wanted.acceleration.tail<3>());
    error_.tail<3>() = detail::rotation_vector(detail::rotation_of(u) * at.R.transpose());
    rate_error_.tail<3>() = turning.velocity;
    task_.tail<3>() = turning.acceleration - bias_.tail<3>();
  }
  rate_error_.noalias() -= J_ * qd;
  options_.kd.add(rate_error_, task_);
  options_.kp.add(error_, task_);
  if (!turns()) return;
  const Matrix3d weighed = options_.orientation_weight.asDiagonal() * at.R.transpose();
  error_.tail<3>() = (weighed * error_.tail<3>()).eval();
  task_.tail<3>() = (weighed * task_.tail<3>()).eval();
  for (Index i = 0; i < J_.cols(); ++i) {
    J_.col(i).tail<3>() = (weighed * J_.col(i).tail<3>()).eval();
  }
}

/// qdd_: what brings the tip to what is wanted, and the posture where the tip leaves it free.
void TaskSpace::set_acceleration(const Setpoint& wanted, const ConstVectorRef& q,
                                 const ConstVectorRef& qd) noexcept {
  set_velocity_terms(q, qd);
  tip_jacobian(model(), q, tip_J_);
  J_ = tip_J_.topRows(J_.rows());
  set_errors(wanted, q, qd);
  const double least = damping_ * damping_;
  if (turns()) {
    set_inverse<6>(J_, least, inverse_);
  } else {
    set_inverse<3>(J_, least, inverse_);
  }

  // Beside the tip: free - J^+ J free, which the tip does not see.
  free_ = options_.posture_kp * (posture_ - q) - options_.posture_kd * qd;
  task_.noalias() -= J_ * free_;
  qdd_ = free_;
  solved_.noalias() = inverse_ * task_;
  qdd_.noalias() += J_.transpose() * solved_;
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
  if (horizon > 0.0) {  // as in computed torque, eq. (89)
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
