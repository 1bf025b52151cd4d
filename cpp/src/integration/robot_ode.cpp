#include "cdcr/robot_ode.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/sizes.hpp"
#include "cdcr/cable_friction.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/linearization.hpp"
#include "dynamics/bending.hpp"
#include "dynamics/parts.hpp"

namespace cdcr {
namespace {

using detail::require;

void require_fit(const Model& model, const CommandInput& input) {
  require(input.num_cables() == model.num_cables(), "tension must have one value for each of the ",
          model.num_cables(), " cables, got ", input.num_cables());
}

}  // namespace

RobotOde::RobotOde(const Model& model, const CommandInput* input, Controller* controller,
                   const WrenchInput& loads)
    : model_(&model),
      input_(input),
      controller_(controller),
      loads_(&loads),
      data_(model),
      command_(VectorXd::Zero(model.num_cables())),
      force_(VectorXd::Zero(model.num_coordinates())),
      wrenches_(loads.wrenches()) {
  require_inertia(model);
  validate(model, loads.wrenches());
  if (model.has_backlash()) {
    require(input == nullptr || !input->is_function(),
            "a drive with backlash takes tables and constants, whose turns are known, and no "
            "function of time");
    asked_ = felt_ = command_;
    rest_command(model, felt_);
  }
  if (model.num_deflections() > 0) moved_ = slope_ = slope_there_ = VectorXd::Zero(num_states());
  for (Index j = 0; j < model.num_cables(); ++j) {
    if (model.cables()[static_cast<std::size_t>(j)].length_driven()) length_driven_.push_back(j);
  }
}

RobotOde::RobotOde(const Model& model, const CommandInput& input, const WrenchInput& loads)
    : RobotOde(model, &input, nullptr, loads) {
  require_fit(model, input);
}

RobotOde::RobotOde(const Model& model, Controller& controller, const WrenchInput& loads)
    : RobotOde(model, nullptr, &controller, loads) {
  require_fit(controller, model);
  segment_ = -1;
}

Status RobotOde::start_segment(double t, const VectorXd& y) {
  assert(y.size() == num_states());
  const Index m = model_->num_coordinates();
  Status status = Status::ok;
  if (controller_ == nullptr) {
    segment_ = input_->segment(t);
    const auto& breaks = input_->break_points();
    command_end_ = segment_ < static_cast<Index>(breaks.size())
                       ? breaks[segment_]
                       : std::numeric_limits<double>::infinity();
    command_holds_ = input_->is_constant(segment_);
    if (model_->has_backlash()) {
      input_->evaluate(t, segment_, y.head(m), y.segment(m, m), command_);
      follow_with_play(*model_, command_, felt_);
    }
    if (command_holds_) update_command(t, y.head(m), y.segment(m, m));
  } else if (segment_ < 0 || t >= command_end_) {
    // A stretch that begins within a period goes on under the tensions held.
    if (segment_ < 0) start_ = t;
    ++segment_;
    command_end_ = start_ + static_cast<double>(segment_ + 1) * controller_->period();
    command_holds_ = true;
    status = controller_->update(t, y.head(m), y.segment(m, m), command_);
    if (model_->has_backlash()) {
      asked_ = command_;
      follow_with_play(*model_, command_, felt_);
      command_ = felt_;
    }
  }
  const auto& breaks = loads_->break_points();
  const auto next = std::upper_bound(breaks.begin(), breaks.end(), t);
  segment_start_ = t;
  segment_end_ = next == breaks.end() ? command_end_ : std::min(*next, command_end_);
  if (command_holds_ && force_is_constant(*model_, wrenches_)) {
    total_force(*model_, y.head(m), y.segment(m, m), command_, wrenches_, force_);
  }
  if (loads_->hold()) loads_->evaluate(t, t, wrenches_);
  return status;
}

void RobotOde::update_command(double t, const ConstVectorRef& q, const ConstVectorRef& qd) {
  input_->evaluate(t, segment_, q, qd, command_);
  if (model_->has_backlash()) {
    asked_ = command_;
    command_ = felt_;
    follow_with_play(*model_, asked_, command_);
  }
  if (!input_->is_function()) return;
  detail::require(
      check_tension(*model_, command_) == Status::ok,
      "the tension function must give finite values >= 0 N (a cable cannot push), got [",
      command_.transpose(), "] at t = ", t, " s");
}

void RobotOde::derivative(double t, const double* y, double* dydt) {
  if (command_holds_ && model_->has_closed_form() && force_is_constant(*model_, wrenches_)) {
    dydt[0] = y[2];
    dydt[1] = y[3];
    detail::closed_form::forward_dynamics(detail::single_of(*model_), y, y + 2, force_.data(),
                                          dydt + 2);
    return;
  }
  const Index m = model_->num_coordinates();
  const Eigen::Map<const VectorXd> q(y, m), qd(y + m, m);
  Eigen::Map<VectorXd> qdd(dydt + m, m);
  if (!command_holds_) {
    // A step that went astray is the integrator's business: no user's function sees such a state.
    if (input_->is_function() && check(y) != Status::ok) {
      std::fill(dydt, dydt + num_states(), std::numeric_limits<double>::quiet_NaN());
      return;
    }
    update_command(t, q, qd);
  }
  if (model_->num_deflections() > 0) {
    if (!loads_->hold()) loads_->evaluate(t, segment_start_, wrenches_);
    return memory_derivative(y, dydt);
  }
  for (Index i = 0; i < m; ++i) dydt[i] = y[m + i];
  if (!command_holds_ || !force_is_constant(*model_, wrenches_)) {
    if (!loads_->hold()) loads_->evaluate(t, segment_start_, wrenches_);
    total_force(*model_, q, qd, command_, wrenches_, force_);
  }
  forward_dynamics_force(*model_, data_, q, qd, force_, qdd);
}

void RobotOde::update_inputs(double t, const double* y) {
  const Index m = model_->num_coordinates();
  const Eigen::Map<const VectorXd> q(y, m), qd(y + m, m);
  if (!command_holds_) update_command(t, q, qd);
  if (!loads_->hold()) loads_->evaluate(t, segment_start_, wrenches_);
}

void RobotOde::jacobian(double t, const double* y, double* J) {
  const Index m = model_->num_coordinates();
  const Eigen::Map<const VectorXd> q(y, m), qd(y + m, m);
  update_inputs(t, y);
  if (model_->num_deflections() > 0) return memory_jacobian(y, J);
  Eigen::Map<MatrixXd> A(J, 2 * m, 2 * m);
  state_jacobian(*model_, data_, q, qd, command_, wrenches_, A);
}

void RobotOde::cables(double t, const VectorXd& y, VectorRef command, VectorRef tension) {
  assert(y.size() == num_states() && detail::of_cables(*model_, command, tension));
  const Index m = model_->num_coordinates();
  if (!command_holds_) update_command(t, y.head(m), y.segment(m, m));
  command = model_->has_backlash() ? asked_ : command_;
  cable_tensions(*model_, y.head(m), y.segment(m, m), command_, tension);
}

void RobotOde::pulls(double t, const double* y, double* pull) {
  const Index m = model_->num_coordinates();
  const Eigen::Map<const VectorXd> q(y, m), qd(y + m, m);
  if (!command_holds_) update_command(t, q, qd);
  for (std::size_t i = 0; i < length_driven_.size(); ++i) {
    pull[i] = cable_pull(*model_, length_driven_[i], q, qd, command_[length_driven_[i]]);
  }
}

void RobotOde::require_stretch(double t, const VectorXd& y, double t_stop) const {
  detail::require(y.size() == num_states() && t_stop > t, "restart takes ", num_states(),
                  " states and t_stop > t, got ", y.size(), " states, t = ", t,
                  " s and t_stop = ", t_stop, " s");
}

Status RobotOde::check(const double* y) const noexcept {
  const Index m = model_->num_coordinates();
  const Index w = model_->num_deflections();
  if (!Eigen::Map<const VectorXd>(y + 2 * m, w).allFinite()) return Status::non_finite_state;
  return check_state(*model_, Eigen::Map<const VectorXd>(y, 2 * m));
}

Status check_state(const Model& model, const ConstVectorRef& y) noexcept {
  if (y.size() != 2 * model.num_coordinates()) return Status::wrong_size;
  if (!y.allFinite()) return Status::non_finite_state;
  return check_shape(model, y.head(model.num_coordinates()));
}

Status check_shape(const Model& model, const ConstVectorRef& q) noexcept {
  if (!(detail::largest_bending(model, q) <= max_bending)) return Status::bending_limit;
  return detail::keeps_length(model, q) ? Status::ok : Status::compression_limit;
}

void require_shape(const char* item, const Model& model, const ConstVectorRef& q) {
  detail::require_bending(item, model, q);
}

Status check_tension(const Model& model, const ConstVectorRef& tension) noexcept {
  const bool sound = tension.size() == model.num_cables() && tension.allFinite();
  return sound && (tension.array() >= 0.0).all() ? Status::ok : Status::invalid_tension;
}

void require_command(const Model& model, const VectorXd& command) {
  detail::require(check_tension(model, command) == Status::ok, "tension must be ",
                  model.num_cables(), " finite values >= 0 N (a cable cannot push), got [",
                  command.transpose(), "]");
}

}  // namespace cdcr
