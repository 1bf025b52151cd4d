#include "cdcr/computed_torque.hpp"

#include <utility>

#include "base/arguments.hpp"

namespace cdcr {

ComputedTorque::ComputedTorque(const Model& model, ComputedTorqueOptions options)
    : TrackingController(model, options.period, options.limits),
      data_(model),
      options_(std::move(options)),
      lead_(options_.lead.value_or(options_.period / 2.0)),
      ahead_(model.num_coordinates()) {
  const Index d = model.num_coordinates();
  require_inertia(model);
  options_.kp.require("kp", d, "1/s^2");
  options_.kd.require("kd", d, "1/s");
  detail::require_not_negative("lead", lead_, "s");
  detail::require_not_negative("delay", options_.delay, "s");
  q_ = qd_ = qdd_ = error_ = force_ = VectorXd::Zero(d);
  M_ = MatrixXd::Zero(d, d);
}

void ComputedTorque::set_acceleration(const Setpoint& wanted, const ConstVectorRef& q,
                                      const ConstVectorRef& qd) noexcept {
  qdd_ = wanted.acceleration;
  error_ = wanted.rate - qd;
  options_.kd.add(error_, qdd_);
  error_ = wanted.value - q;
  options_.kp.add(error_, qdd_);
}

/// force_: what makes the acceleration qdd_ at (q, qd), as far as the cables can.
void ComputedTorque::set_force(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept {
  inverse_dynamics(model(), data_, q, qd, qdd_, force_);
  if (drive().is_fully_actuated() || !force_.allFinite()) return;
  mass_matrix(model(), data_, q, M_);
  drive().project(q, M_, force_);
}

Status ComputedTorque::control(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                               const Setpoint& wanted) noexcept {
  const double delay = options_.delay, horizon = delay + lead_;
  if (delay > 0.0) {
    path().evaluate(t - delay, ahead_);
    set_acceleration(ahead_, q, qd);
  } else {
    set_acceleration(wanted, q, qd);
  }
  note_error(error_.norm());
  q_ = q;
  qd_ = qd;
  if (horizon > 0.0) {  // where the robot is in the middle of the period, eq. (106)
    if (!drive().is_fully_actuated()) {
      set_force(q, qd);
      forward_dynamics_force(model(), data_, q, qd, force_, qdd_);
    }
    q_ += horizon * qd + (horizon * horizon / 2.0) * qdd_;
    qd_ += horizon * qdd_;
    path().evaluate(t + lead_, ahead_);
    set_acceleration(ahead_, q_, qd_);
  }
  set_force(q_, qd_);
  if (!force_.allFinite()) return Status::non_finite_state;
  (void)give(q_, qd_, force_);
  return Status::ok;
}

}  // namespace cdcr
