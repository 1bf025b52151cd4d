#include "cdcr/cable_drive.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/sizes.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/kinematics.hpp"

namespace cdcr {
namespace {

// Of B^T B or B^T M^-1 B, relative to its largest diagonal entry: what is added to it, so that
// cables that pull alike share.
constexpr double regular = 1e-12;

double checked_step(double max_rate, double period) {
  detail::require_positive("period", period, "s");
  detail::require(max_rate > 0.0, "max_rate must be > 0 N/s (m/s of lengths), got ", max_rate);
  return max_rate * period;
}

}  // namespace

CableDrive::CableDrive(const Model& model, const TensionLimits& limits, double max_rate,
                       double period)
    : model_(model),
      allocator_(model, limits),
      max_step_(checked_step(max_rate, period)),
      period_(period),
      least_(allocator_.lower()),
      most_(allocator_.upper()),
      lower_(least_),
      upper_(most_),
      B_(model.actuation_matrix()),
      ldlt_(model.num_cables()),
      llt_(model.num_coordinates()) {
  const Index d = model.num_coordinates(), c = model.num_cables();
  none_ = command_ = tension_ = lengths_ = rates_ = row_ = VectorXd::Zero(c);
  force_ = wanted_ = VectorXd::Zero(d);
  moved_ = B_;
  normal_ = MatrixXd::Identity(c, c);
  ldlt_.compute(normal_);  // before, Eigen leaves a status without a value, which copies would read
  llt_.compute(MatrixXd::Identity(d, d));
  for (const Cable& cable : model.cables()) has_lengths_ = has_lengths_ || cable.length_driven();
  detail::require(limits.min_tension >= 0.0 || !has_lengths_,
                  "min_tension must be >= 0 N where cables are driven by length, got ",
                  limits.min_tension);
  fully_actuated_ = c >= d && Eigen::ColPivHouseholderQR<MatrixXd>(B_).rank() == d;
}

void CableDrive::set_lengths(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept {
  if (!model_.has_constant_actuation()) actuation_matrix(model_, q, B_);
  if (!has_lengths_) return;
  cable_lengths(model_, q, lengths_);
  rates_.noalias() = B_.transpose() * qd;  // dl/dq = -B^T, eq. (6)
  rates_ = -rates_;
}

double CableDrive::command_of(Index cable, double tension) const noexcept {
  const Cable& c = model_.cables()[static_cast<std::size_t>(cable)];
  if (!c.length_driven()) return tension;
  const double pulled = (tension - c.damping * rates_[cable]) / c.stiffness;
  return std::fmax(0.0, lengths_[cable] - pulled - model_.slack_offset()[cable]);
}

double CableDrive::tension_of(Index cable, double command) const noexcept {
  const Cable& c = model_.cables()[static_cast<std::size_t>(cable)];
  if (!c.length_driven()) return command;
  return c.stiffness * (lengths_[cable] - command - model_.slack_offset()[cable]) +
         c.damping * rates_[cable];
}

void CableDrive::set_limits(const ConstVectorRef& preferred) noexcept {
  for (Index j = 0; j < command_.size(); ++j) {
    double lower = least_[j], upper = most_[j];
    if (started_ && std::isfinite(max_step_)) {
      const double one = tension_of(j, command_[j] - max_step_);
      const double other = tension_of(j, command_[j] + max_step_);
      lower = std::clamp(std::fmin(one, other), least_[j], most_[j]);
      upper = std::clamp(std::fmax(one, other), least_[j], most_[j]);
    }
    lower_[j] = lower - preferred[j];
    upper_[j] = upper - preferred[j];
  }
  allocator_.set_limits(lower_, upper_);
}

bool CableDrive::solve(const ConstVectorRef& q, const ConstVectorRef& qd,
                       const ConstVectorRef& force) noexcept {
  return solve(q, qd, force, none_);
}

bool CableDrive::solve(const ConstVectorRef& q, const ConstVectorRef& qd,
                       const ConstVectorRef& force, const ConstVectorRef& preferred) noexcept {
  set_lengths(q, qd);
  set_limits(preferred);
  allocator_.set_shape(q);
  const bool plain = preferred.isZero(0.0);
  wanted_ = force;
  if (!plain) wanted_.noalias() -= B_ * preferred;
  const bool met = allocator_.solve(wanted_);
  tension_ = allocator_.tension();
  force_ = allocator_.force();
  if (!plain) {
    tension_ += preferred;
    force_.noalias() += B_ * preferred;
  }
  for (Index j = 0; j < command_.size(); ++j) {
    const double command = command_of(j, tension_[j]);
    command_[j] =
        started_ ? std::clamp(command, command_[j] - max_step_, command_[j] + max_step_) : command;
  }
  started_ = true;
  return met;
}

void CableDrive::tensions_of(const ConstVectorRef& q, const ConstVectorRef& qd,
                             const ConstVectorRef& command, VectorRef tension) noexcept {
  set_lengths(q, qd);
  for (Index j = 0; j < tension.size(); ++j) tension[j] = tension_of(j, command[j]);
}

void CableDrive::project(const ConstVectorRef& q, VectorRef force) noexcept {
  if (fully_actuated_ || B_.cols() == 0) return;
  if (!model_.has_constant_actuation()) actuation_matrix(model_, q, B_);
  normal_.noalias() = B_.transpose() * B_;
  normal_.diagonal().array() += regular * normal_.diagonal().maxCoeff();
  ldlt_.compute(normal_);
  row_.noalias() = B_.transpose() * force;
  ldlt_.solveInPlace(row_);
  force.noalias() = B_ * row_;
}

void CableDrive::project(const ConstVectorRef& q, const MatrixXd& M, VectorRef force) noexcept {
  if (fully_actuated_ || B_.cols() == 0) return;
  if (!model_.has_constant_actuation()) actuation_matrix(model_, q, B_);
  llt_.compute(M);
  moved_ = B_;
  llt_.solveInPlace(moved_);
  normal_.noalias() = B_.transpose() * moved_;
  normal_.diagonal().array() += regular * normal_.diagonal().maxCoeff();
  ldlt_.compute(normal_);
  row_.noalias() = moved_.transpose() * force;
  ldlt_.solveInPlace(row_);
  force.noalias() = B_ * row_;
}

Index CableDrive::num_limited() const noexcept {
  Index count = 0;
  for (Index j = 0; j < command_.size(); ++j) count += allocator_.at_limit(j) ? 1 : 0;
  return count;
}

}  // namespace cdcr
