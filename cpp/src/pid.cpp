#include "cdcr/pid.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "cdcr/dynamics.hpp"
#include "cdcr/plant.hpp"

namespace cdcr {
namespace {

void require(bool sound, const char* item, double value, const char* allowed) {
  if (sound) return;
  std::ostringstream text;
  text << item << " must be " << allowed << " and finite, got " << value;
  throw std::invalid_argument(text.str());
}

void check(const PidOptions& o) {
  require(o.kp >= 0.0 && std::isfinite(o.kp), "kp", o.kp, ">= 0 N m/rad");
  require(o.ki >= 0.0 && std::isfinite(o.ki), "ki", o.ki, ">= 0 N m/(rad s)");
  require(o.kd >= 0.0 && std::isfinite(o.kd), "kd", o.kd, ">= 0 N m s/rad");
  require(o.period > 0.0 && std::isfinite(o.period), "period", o.period, "> 0 s");
}

void require_tension_drive(const Model& model) {
  for (std::size_t j = 0; j < model.cables().size(); ++j) {
    if (!model.cables()[j].length_driven()) continue;
    throw std::invalid_argument("a Pid drives cables by tension, but cable " + std::to_string(j) +
                                " of the robot is driven by length (its stiffness is not 0)");
  }
}

}  // namespace

Pid::Pid(const Model& model, PidOptions options)
    : model_(model),
      data_(model),
      options_(std::move(options)),
      allocator_(model, options_.limits),
      reference_(VectorXd::Zero(model.num_coordinates())) {
  check(options_);
  require_tension_drive(model_);
  hold_ = integral_ = force_ = reference_;
  set_reference(reference_);
}

void Pid::set_reference(const VectorXd& q) {
  bool sound = q.size() == model_.num_coordinates() && q.allFinite();
  for (Index i = 0; sound && i < q.size(); i += 2) {
    sound = q.segment<2>(i).norm() <= max_bending;
  }
  if (!sound) {
    std::ostringstream text;
    text << "reference must be " << model_.num_coordinates()
         << " finite values that bend each section by at most 3 pi rad, got [" << q.transpose()
         << "]";
    throw std::invalid_argument(text.str());
  }
  reference_ = q;
  if (options_.feed_forward) potential_gradient(model_, data_, reference_, hold_);
}

Status Pid::update(double /*t*/, const ConstVectorRef& q, const ConstVectorRef& qd,
                   VectorRef tension) noexcept {
  if (!q.allFinite() || !qd.allFinite()) return Status::non_finite_state;
  force_ = hold_ + options_.kp * (reference_ - q) + options_.ki * integral_ - options_.kd * qd;
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
