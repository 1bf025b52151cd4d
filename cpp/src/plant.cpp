#include "cdcr/plant.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "cdcr/dynamics.hpp"
#include "cdcr/linearization.hpp"

namespace cdcr {

Plant::Plant(const Model& model, const TensionInput& input)
    : model_(&model),
      input_(&input),
      data_(model),
      tension_(VectorXd::Zero(model.num_cables())),
      force_(VectorXd::Zero(model.num_coordinates())) {
  require_inertia(model);
  if (input.num_cables() != model.num_cables()) {
    throw std::invalid_argument("tension must have one value for each of the " +
                                std::to_string(model.num_cables()) + " cables, got " +
                                std::to_string(input.num_cables()));
  }
  set_segment(0);
}

void Plant::set_segment(Index segment) {
  segment_ = segment;
  force_holds_ = false;
  if (input_->holds(segment)) {
    update_force(0.0, force_, force_);  // neither time nor state matters
    force_holds_ = true;
  }
}

void Plant::update_force(double t, const ConstVectorRef& q, const ConstVectorRef& qd) {
  evaluate_input(t, segment_, q, qd);
  actuation_force(*model_, tension_, force_);
}

void Plant::derivative(double t, const double* y, double* dydt) {
  const Index m = model_->num_coordinates();
  const Eigen::Map<const VectorXd> q(y, m), qd(y + m, m);
  if (!force_holds_) update_force(t, q, qd);
  Eigen::Map<VectorXd> qdd(dydt + m, m);
  for (Index i = 0; i < m; ++i) dydt[i] = y[m + i];
  forward_dynamics_force(*model_, data_, q, qd, force_, qdd);
}

void Plant::jacobian(double t, const double* y, double* J) {
  const Index m = model_->num_coordinates();
  const Eigen::Map<const VectorXd> q(y, m), qd(y + m, m);
  if (!force_holds_) update_force(t, q, qd);
  Eigen::Map<MatrixXd> A(J, 2 * m, 2 * m);
  state_jacobian(*model_, data_, q, qd, force_, A);
}

void Plant::tension(double t, Index segment, const VectorXd& y, VectorRef tension) {
  const Index m = model_->num_coordinates();
  evaluate_input(t, segment, y.head(m), y.tail(m));
  tension = tension_;
}

void Plant::evaluate_input(double t, Index segment, const ConstVectorRef& q,
                           const ConstVectorRef& qd) {
  input_->evaluate(t, segment, q, qd, tension_);
  if (input_->is_function() && check_tension(*model_, tension_) != Status::ok) {
    std::ostringstream text;
    text << "the tension function must give finite values >= 0 N (a cable cannot push), got ["
         << tension_.transpose() << "] at t = " << t << " s";
    throw std::invalid_argument(text.str());
  }
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
