#include "cdcr/pid.hpp"

#include <utility>

#include "base/sizes.hpp"

namespace cdcr {

Pid::Pid(const Model& model, PidOptions options)
    : TrackingController(model, options.period, {options.limits, options.max_rate}),
      data_(model),
      options_(std::move(options)) {
  const Index d = model.num_coordinates();
  options_.kp.require("kp", d, "N m/rad");
  options_.ki.require("ki", d, "N m/(rad s)");
  options_.kd.require("kd", d, "N m s/rad");
  detail::require_not_negative("filter", options_.filter, "s");
  hold_ = integral_ = force_ = error_ = rate_error_ = last_q_ = rate_ = VectorXd::Zero(d);
}

void Pid::accept(const ReferencePath& path) {
  TrackingController::accept(path);
  holds_ = false;
}

void Pid::set_integral(const VectorXd& integral) {
  detail::require_finite("integral", integral, model().num_coordinates());
  integral_ = integral;
}

void Pid::reset() noexcept {
  TrackingController::reset();
  integral_.setZero();
  filters_ = false;
}

/// rate_: the measured one, or the filtered derivative of the measured coordinates.
void Pid::filter(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept {
  if (options_.filter == 0.0) {
    rate_ = qd;
    return;
  }
  if (filters_) {
    // Backward Euler of filter rate' + rate = q', eq. (104).
    rate_ = (options_.filter * rate_ + (q - last_q_)) / (options_.filter + period());
  } else {
    rate_.setZero();
  }
  last_q_ = q;
  filters_ = true;
}

Status Pid::control(double /*t*/, const ConstVectorRef& q, const ConstVectorRef& qd,
                    const Setpoint& wanted) noexcept {
  if (options_.feed_forward && !holds_) {
    potential_gradient(model(), data_, wanted.value, hold_);
    holds_ = path().is_constant();
  }
  filter(q, qd);
  error_ = wanted.value - q;
  rate_error_ = wanted.rate - rate_;
  force_ = hold_;
  options_.kp.add(error_, force_);
  options_.ki.add(integral_, force_);
  options_.kd.add(rate_error_, force_);
  if (!force_.allFinite()) return Status::non_finite_state;
  drive().project(q, force_);
  const bool met = give(q, qd, force_);
  note_error(error_.norm());
  for (Index i = 0; i < q.size(); ++i) {
    const double missing = met ? 0.0 : force_[i] - drive().force()[i];
    // Integrating further in a direction that the limits already withhold only builds up overshoot.
    if (options_.anti_windup && missing * error_[i] > 0.0) continue;
    integral_[i] += options_.period * error_[i];
  }
  return Status::ok;
}

}  // namespace cdcr
