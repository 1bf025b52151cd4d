#include "cdcr/momentum_observer.hpp"

#include <Eigen/Eigenvalues>
#include <chrono>
#include <utility>

#include "base/sizes.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/kinematics.hpp"
#include "control/same_robot.hpp"
#include "estimation/memory.hpp"

namespace cdcr {
namespace {

// Step of the difference that gives M' qd, as a motion of the fastest coordinate [rad].
constexpr double difference = 1e-5;

}  // namespace

MomentumObserver::MomentumObserver(const Model& model, MomentumObserverOptions options,
                                   Estimator* states)
    : model_(model),
      data_(model),
      options_(std::move(options)),
      states_(states),
      num_others_(states == nullptr ? 0 : static_cast<Index>(states->value_names().size())),
      actuators_(model, options_.actuators, options_.period) {
  require_inertia(model);
  detail::require_positive("bandwidth", options_.bandwidth, "rad/s");
  detail::require_positive("period", options_.period, "s");
  detail::require_positive("damping", options_.damping, "1/rad");
  if (options_.force_at) {
    const Place& at = *options_.force_at;
    detail::require(detail::is_section(model, at.section) && detail::is_fraction(at.fraction),
                    "force_at must be a section 0 to ", model.num_sections() - 1,
                    " and a fraction 0 to 1, got section ", at.section, " and fraction ",
                    at.fraction);
  }
  if (states != nullptr) states->require_robot(model);
  detail::require(states == nullptr || states->period() == options_.period,
                  "the observer's period must be that of the estimator it asks, ",
                  states == nullptr ? 0.0 : states->period(), " s, got ", options_.period, " s");
  for (const Section& section : model.robot().sections) damping_ += section.length;
  damping_ *= options_.damping;
  const Index d = model.num_coordinates();
  q_ = qd_ = momentum_ = drift_ = residual_ = next_momentum_ = next_drift_ = cables_ = near_ =
      VectorXd::Zero(d);
  tension_ = VectorXd::Zero(model.num_cables());
  M_ = MatrixXd::Zero(d, d);
  J_ = MatrixXd::Zero(6, d);
}

void MomentumObserver::require_robot(const Model& model) const {
  detail::require_sizes("the observer", q_.size(), tension_.size(), model);
  detail::require_drives("the observer expects cables driven by ", model_, model);
  if (states_ != nullptr) states_->require_robot(model);
}

void MomentumObserver::require_fit(const Model& model, const std::vector<Sensor>& sensors) const {
  require_robot(model);
  if (states_ != nullptr) states_->require_fit(model, sensors);
}

void MomentumObserver::reset(const ConstVectorRef& q, const ConstVectorRef& qd,
                             const ConstVectorRef& command) noexcept {
  if (states_ != nullptr) states_->reset(q, qd, command);
  actuators_.reset(command);
  residual_.setZero();
  force_.setZero();
  set_ = true;
  started_ = false;
  diagnostics_ = {};
}

/// drift: M' qd - h, what momentum changes by without cables and what is unknown, eq. (102).
/// next_momentum_ is M qd.
void MomentumObserver::set_drift(const ConstVectorRef& q, const ConstVectorRef& qd,
                                 VectorRef drift) noexcept {
  bias(model_, data_, q, qd, drift);
  drift = -drift;
  const double fastest = qd.lpNorm<Eigen::Infinity>();
  if (fastest > 0.0) {
    const double step = difference / fastest;
    for (const double side : {1.0, -1.0}) {
      near_ = q + side * step * qd;
      mass_matrix(model_, data_, near_, M_);
      drift.noalias() += (side / (2.0 * step)) * (M_ * qd);
    }
  }
  mass_matrix(model_, data_, q, M_);
  next_momentum_.noalias() = M_ * qd;
}

/// residual_ after a period, by the trapezoidal rule, eq. (103).
void MomentumObserver::observe(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept {
  set_drift(q, qd, next_drift_);
  if (started_) {
    const double T = options_.period, half = 0.5 * options_.bandwidth * T;
    residual_ *= 1.0 - half;
    residual_ += options_.bandwidth * (next_momentum_ - momentum_);
    residual_ -= half * (next_drift_ + drift_);
    cable_force(model_, q_, qd_, actuators_.given(), cables_);
    residual_ -= half * cables_;
    cable_force(model_, q, qd, actuators_.given(), cables_);
    residual_ -= half * cables_;
    residual_ /= 1.0 + half;
  }
  q_ = q;
  qd_ = qd;
  momentum_.swap(next_momentum_);
  drift_.swap(next_drift_);
  started_ = true;
}

/// force_: J^T force nearest to the residual, no eigenvalue of J J^T below the squared damping, eq.
/// (104).
void MomentumObserver::set_force(const Place& at, const ConstVectorRef& q) noexcept {
  jacobian(model_, q, at.section, at.fraction, J_);
  const auto J = J_.topRows<3>();
  const Matrix3d normal = J * J.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(normal);
  const Vector3d values = solver.eigenvalues().cwiseMax(damping_ * damping_);
  const Vector3d pushed = solver.eigenvectors().transpose() * (J * residual_);
  force_ = solver.eigenvectors() * pushed.cwiseQuotient(values);
}

Status MomentumObserver::update(double t, const std::vector<Measurement>& told,
                                const ConstVectorRef& command, VectorRef q, VectorRef qd) noexcept {
  if (!set_) return Status::not_started;
  if (!detail::of_coordinates(model_, q, qd) || !detail::of_cables(model_, command)) {
    return Status::wrong_size;
  }
  const auto begin = std::chrono::steady_clock::now();
  ++diagnostics_.updates;
  if (states_ != nullptr) {
    const Status status = states_->update(t, told, command, q, qd);
    if (status != Status::ok) return status;
    diagnostics_.innovation = states_->diagnostics().innovation;
    diagnostics_.measured = states_->diagnostics().measured;
  }
  if (!q.allFinite() || !qd.allFinite()) return Status::non_finite_state;
  if (started_) {
    cable_tensions(model_, q_, qd_, actuators_.given(), tension_);
    actuators_.step(command, tension_);
  }
  observe(q, qd);
  if (options_.force_at) set_force(*options_.force_at, q);
  diagnostics_.duration =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return residual_.allFinite() ? Status::ok : Status::non_finite_state;
}

template <class Self, class Visit>
void MomentumObserver::visit_memory(Self& self, Visit& visit) {
  Actuators::visit_memory(self.actuators_, visit);
  visit(self.set_);
  visit(self.started_);
  visit(self.q_);
  visit(self.qd_);
  visit(self.momentum_);
  visit(self.drift_);
  visit(self.residual_);
  visit(self.force_);
}

VectorXd MomentumObserver::memory() const {
  detail::MemoryWriter writer;
  visit_memory(*this, writer);
  return writer.memory();
}

void MomentumObserver::set_memory(const VectorXd& memory) {
  detail::MemoryReader reader(memory, this->memory().size());
  visit_memory(*this, reader);
}

std::vector<std::string> MomentumObserver::value_names() const {
  std::vector<std::string> names;
  for (const std::string& name : model_.coordinate_names()) names.push_back("Q_" + name);
  if (options_.force_at) names.insert(names.end(), {"force_x", "force_y", "force_z"});
  if (states_ == nullptr) return names;
  for (const std::string& name : states_->value_names()) names.push_back(name);
  return names;
}

void MomentumObserver::write_values(VectorRef values, VectorRef deviations) const noexcept {
  values.head(residual_.size()) = residual_;
  if (options_.force_at) values.segment<3>(residual_.size()) = force_;
  deviations.head(num_own()).setZero();
  if (states_ == nullptr) return;
  states_->write_values(values.tail(num_others_), deviations.tail(num_others_));
}

}  // namespace cdcr
