#include "cdcr/plant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include "cdcr/dynamics.hpp"
#include "cdcr/linearization.hpp"

namespace cdcr {

Plant::Plant(const Model& model, const TensionInput* input, Controller* controller,
             Index num_cables)
    : model_(&model),
      input_(input),
      controller_(controller),
      data_(model),
      tension_(VectorXd::Zero(model.num_cables())),
      force_(VectorXd::Zero(model.num_coordinates())) {
  require_inertia(model);
  if (num_cables != model.num_cables()) {
    throw std::invalid_argument("tension must have one value for each of the " +
                                std::to_string(model.num_cables()) + " cables, got " +
                                std::to_string(num_cables));
  }
}

Plant::Plant(const Model& model, const TensionInput& input)
    : Plant(model, &input, nullptr, input.num_cables()) {}

Plant::Plant(const Model& model, Controller& controller)
    : Plant(model, nullptr, &controller, controller.num_cables()) {
  segment_ = -1;
}

Status Plant::start_segment(double t, const VectorXd& y) {
  const Index m = model_->num_coordinates();
  if (controller_ != nullptr) {
    // A run that ends within a period ends under the tensions held.
    if (segment_ >= 0 && t < segment_end_) return Status::ok;
    if (segment_ < 0) start_ = t;
    ++segment_;
    segment_end_ = start_ + static_cast<double>(segment_ + 1) * controller_->period();
    force_holds_ = true;
    const Status status = controller_->update(t, y.head(m), y.tail(m), tension_);
    actuation_force(*model_, tension_, force_);
    return status;
  }
  segment_ = input_->segment(t);
  const auto& breaks = input_->break_points();
  segment_end_ = segment_ < static_cast<Index>(breaks.size())
                     ? breaks[segment_]
                     : std::numeric_limits<double>::infinity();
  force_holds_ = input_->holds(segment_);
  if (force_holds_) update_force(t, y.head(m), y.tail(m));
  return Status::ok;
}

void Plant::update_force(double t, const ConstVectorRef& q, const ConstVectorRef& qd) {
  input_->evaluate(t, segment_, q, qd, tension_);
  if (input_->is_function() && check_tension(*model_, tension_) != Status::ok) {
    std::ostringstream text;
    text << "the tension function must give finite values >= 0 N (a cable cannot push), got ["
         << tension_.transpose() << "] at t = " << t << " s";
    throw std::invalid_argument(text.str());
  }
  actuation_force(*model_, tension_, force_);
}

void Plant::derivative(double t, const double* y, double* dydt) {
  const Index m = model_->num_coordinates();
  const Eigen::Map<const VectorXd> q(y, m), qd(y + m, m);
  Eigen::Map<VectorXd> qdd(dydt + m, m);
  if (!force_holds_) {
    // A step that went astray is the integrator's business: no user's function sees such a state.
    if (input_->is_function() && check(y) != Status::ok) {
      std::fill(dydt, dydt + 2 * m, std::numeric_limits<double>::quiet_NaN());
      return;
    }
    update_force(t, q, qd);
  }
  for (Index i = 0; i < m; ++i) dydt[i] = y[m + i];
  forward_dynamics_force(*model_, data_, q, qd, force_, qdd);
}

void Plant::jacobian(double t, const double* y, double* J) {
  const Index m = model_->num_coordinates();
  const Eigen::Map<const VectorXd> q(y, m), qd(y + m, m);
  if (!force_holds_) update_force(t, q, qd);
  Eigen::Map<MatrixXd> A(J, 2 * m, 2 * m);
  state_jacobian(*model_, data_, q, qd, tension_, no_wrenches(), A);
}

void Plant::tension(double t, const VectorXd& y, VectorRef tension) {
  const Index m = model_->num_coordinates();
  if (!force_holds_) update_force(t, y.head(m), y.tail(m));
  tension = tension_;
}

Status Plant::check(const double* y) const noexcept {
  return check_state(*model_, Eigen::Map<const VectorXd>(y, num_states()));
}

Status check_state(const Model& model, const ConstVectorRef& y) noexcept {
  if (!y.allFinite()) return Status::non_finite_state;
  for (Index i = 0; i < model.num_coordinates(); i += 2) {
    if (y.segment<2>(i).squaredNorm() > max_bending * max_bending) return Status::bending_limit;
  }
  return Status::ok;
}

Status check_tension(const Model& model, const ConstVectorRef& tension) noexcept {
  if (tension.size() != model.num_cables()) return Status::invalid_tension;
  for (Index j = 0; j < tension.size(); ++j) {
    if (!(tension[j] >= 0.0) || !std::isfinite(tension[j])) return Status::invalid_tension;
  }
  return Status::ok;
}

}  // namespace cdcr
