#include "cdcr/state_feedback.hpp"

#include <utility>

#include "base/arguments.hpp"
#include "cdcr/cables.hpp"

namespace cdcr {

StateFeedback::StateFeedback(const Model& model, StateFeedbackOptions options)
    : TrackingController(model, options.period, options.limits),
      data_(model),
      options_(std::move(options)),
      holding_(model, options_.limits.tension) {
  const Index d = model.num_coordinates(), c = model.num_cables();
  const MatrixXd& K = options_.gain;
  detail::require(K.rows() == c && K.cols() == 2 * d && K.allFinite(), "gain must be ", c, " by ",
                  2 * d, " finite values, got ", K.rows(), " by ", K.cols(),
                  K.allFinite() ? "" : ", not finite");
  if (options_.command.size() != 0) detail::require_finite("command", options_.command, c);
  error_ = VectorXd::Zero(2 * d);
  hold_ = command_ = tension_ = VectorXd::Zero(c);
  force_ = VectorXd::Zero(d);
  B_ = model.actuation_matrix();
}

void StateFeedback::accept(const ReferencePath& path) {
  TrackingController::accept(path);
  holds_ = false;
}

/// hold_: the commands given, or those that hold the reference still.
void StateFeedback::hold_reference(const VectorXd& reference) noexcept {
  if (holds_) return;
  holds_ = path().is_constant();
  if (options_.command.size() != 0) {
    hold_ = options_.command;
    return;
  }
  potential_gradient(model(), data_, reference, force_);
  drive().project(reference, force_);
  holding_.set_shape(reference);
  (void)holding_.solve(force_);
  cable_commands(model(), reference, holding_.tension(), hold_);
}

Status StateFeedback::control(double /*t*/, const ConstVectorRef& q, const ConstVectorRef& qd,
                              const Setpoint& wanted) noexcept {
  hold_reference(wanted.value);
  const Index d = q.size();
  error_.head(d) = q - wanted.value;
  error_.tail(d) = qd - wanted.rate;
  note_error(error_.head(d).norm());
  command_ = hold_;
  command_.noalias() -= options_.gain * error_;
  if (!command_.allFinite()) return Status::non_finite_state;
  drive().tensions_of(q, qd, command_, tension_);
  if (!model().has_constant_actuation()) actuation_matrix(model(), q, B_);
  force_.noalias() = B_ * tension_;
  (void)give(q, qd, force_, tension_);
  return Status::ok;
}

}  // namespace cdcr
