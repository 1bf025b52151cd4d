#include "cdcr/pid.hpp"

#include "base/sizes.hpp"
#include "cdcr/dynamics.hpp"
#include "dynamics/bending.hpp"

namespace cdcr {
namespace {

void check(const PidOptions& o) {
  detail::require_not_negative("kp", o.kp, "N m/rad");
  detail::require_not_negative("ki", o.ki, "N m/(rad s)");
  detail::require_not_negative("kd", o.kd, "N m s/rad");
  detail::require_positive("period", o.period, "s");
}

}  // namespace

Pid::Pid(const Model& model, PidOptions options)
    : model_(model),
      data_(model),
      options_(std::move(options)),
      allocator_(model, options_.limits),
      reference_(VectorXd::Zero(model.num_coordinates())) {
  check(options_);
  detail::require_tension_drive("a Pid", model_);
  hold_ = integral_ = force_ = reference_;
  set_reference(reference_);
}

void Pid::set_reference(const VectorXd& q) {
  const bool sound = q.size() == model_.num_coordinates() && q.allFinite() &&
                     detail::largest_bending(model_, q) <= max_bending;
  detail::require(sound, "reference must be ", model_.num_coordinates(),
                  " finite values that bend each section by at most 3 pi rad, got [", q.transpose(),
                  "]");
  reference_ = q;
  if (options_.feed_forward) potential_gradient(model_, data_, reference_, hold_);
}

void Pid::set_integral(const VectorXd& integral) {
  detail::require_finite("integral", integral, model_.num_coordinates());
  integral_ = integral;
}

Status Pid::update(double /*t*/, const ConstVectorRef& q, const ConstVectorRef& qd,
                   VectorRef tension) noexcept {
  const bool fits = detail::of_coordinates(model_, q, qd) && detail::of_cables(model_, tension);
  if (!fits) return Status::wrong_size;
  if (!q.allFinite() || !qd.allFinite()) return Status::non_finite_state;
  force_ = hold_ + options_.kp * (reference_ - q) + options_.ki * integral_ - options_.kd * qd;
  if (!force_.allFinite()) return Status::non_finite_state;
  allocator_.set_shape(q);
  const bool met = allocator_.solve(force_);
  tension = allocator_.tension();
  for (Index i = 0; i < q.size(); ++i) {
    const double error = reference_[i] - q[i];
    const double missing = met ? 0.0 : force_[i] - allocator_.force()[i];
    // Integrating further in a direction that the limits already withhold only builds up overshoot.
    if (options_.anti_windup && missing * error > 0.0) continue;
    integral_[i] += options_.period * error;
  }
  return Status::ok;
}

}  // namespace cdcr
