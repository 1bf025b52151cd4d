#include "cdcr/pid.hpp"

#include <cmath>
#include <utility>

#include "base/sizes.hpp"

namespace cdcr {
namespace {

// Force that counts as missing, over what was asked: above the rounding of an allocation.
constexpr double least_missing = 1e-10;

}  // namespace

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

VectorXd Pid::memory() const {
  const VectorXd of_drive = TrackingController::memory();
  VectorXd memory(of_drive.size() + 3 * integral_.size() + 1);
  memory << of_drive, integral_, last_q_, rate_, (filters_ ? 1.0 : 0.0);
  return memory;
}

void Pid::set_memory(const VectorXd& memory) {
  const Index d = integral_.size(), of_drive = memory.size() - 3 * d - 1;
  detail::require_finite("memory", memory, TrackingController::memory().size() + 3 * d + 1);
  TrackingController::set_memory(memory.head(of_drive));
  integral_ = memory.segment(of_drive, d);
  last_q_ = memory.segment(of_drive + d, d);
  rate_ = memory.segment(of_drive + 2 * d, d);
  filters_ = memory[of_drive + 3 * d] != 0.0;
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
    // Backward Euler of filter rate' + rate = q', eq. (87).
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
  const double rounding = least_missing * force_.lpNorm<Eigen::Infinity>();
  for (Index i = 0; i < q.size(); ++i) {
    const double missing = met ? 0.0 : force_[i] - drive().force()[i];
    // Integrating further in a direction that the limits already withhold only builds up overshoot.
    const bool withheld = std::abs(missing) > rounding && missing * error_[i] > 0.0;
    if (options_.anti_windup && withheld) continue;
    integral_[i] += options_.period * error_[i];
  }
  return Status::ok;
}

}  // namespace cdcr
