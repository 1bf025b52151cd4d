#include "estimation/augmented_motion.hpp"

#include <limits>

#include "cdcr/base_wrench.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/linearization.hpp"
#include "cdcr/total_force.hpp"
#include "loads/base_wrench.hpp"

namespace cdcr::detail {

AugmentedMotion::AugmentedMotion(const Model& model, const std::vector<Model>& variants,
                                 const std::optional<Place>& force_at, double period, int substeps)
    : d_(model.num_coordinates()),
      step_(period / substeps),
      substeps_(substeps),
      stages_(2 * d_ + (force_at ? 3 : 0) + static_cast<Index>(variants.size())),
      llt_(d_) {
  models_.push_back(model);
  models_.insert(models_.end(), variants.begin(), variants.end());
  for (const Model& one : models_) data_.emplace_back(one);
  if (force_at) {
    force_.resize(1);
    force_[0].section = force_at->section;
    force_[0].fraction = force_at->fraction;
  }
  between_ = slope_ = VectorXd::Zero(size());
  qdd_ = bias_ = unbalanced_ = added_ = VectorXd::Zero(d_);
  M_ = own_ = MatrixXd::Zero(d_, d_);
  llt_.compute(MatrixXd::Identity(d_, d_));  // its status is copied before the first update
  A_ = MatrixXd::Zero(2 * d_, 2 * d_);
  on_base_ = VectorXd::Zero(6);
}

void AugmentedMotion::make_room_for_base_wrench() {
  if (!base_slopes_.empty()) return;
  for (const Model& one : models_) base_slopes_.emplace_back(one);
  felt_.x = VectorXd::Zero(size());
  felt_.wrench = VectorXd::Zero(6);
  felt_.slopes = MatrixXd::Zero(6, size());
  base_change_ = MatrixXd::Zero(6, 3 * d_);
  change_ = MatrixXd::Zero(d_, size());
}

/// Of a model among all: forces and inertia are sums of theirs with weights that add up to one.
double AugmentedMotion::weight(std::size_t k, const ConstVectorRef& shares) const noexcept {
  return k > 0 ? shares[static_cast<Index>(k) - 1] : 1.0 - shares.sum();
}

/// unbalanced_: cables and force less bias of one model.
void AugmentedMotion::set_unbalanced(std::size_t k, const ConstVectorRef& q,
                                     const ConstVectorRef& qd, const VectorXd& command) noexcept {
  total_force(models_[k], q, qd, command, force_, unbalanced_);
  bias(models_[k], data_[k], q, qd, bias_);
  unbalanced_ -= bias_;
}

/// M_ and its factors.
void AugmentedMotion::set_mass(const ConstVectorRef& q, const ConstVectorRef& shares) noexcept {
  M_.setZero();
  for (std::size_t k = 0; k < models_.size(); ++k) {
    mass_matrix(models_[k], data_[k], q, own_);
    M_ += weight(k, shares) * own_;
  }
  llt_.compute(M_);
}

void AugmentedMotion::accelerate(const ConstVectorRef& x, const VectorXd& command,
                                 VectorRef qdd) noexcept {
  const auto q = x.head(d_), qd = x.segment(d_, d_);
  if (!x.allFinite()) {  // of a filter that diverges
    qdd.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  if (!force_.empty()) force_[0].force = x.segment<3>(2 * d_);
  if (models_.size() == 1) {
    return forward_dynamics(models_[0], data_[0], q, qd, command, force_, qdd);
  }
  const auto shares = x.tail(num_shares());
  set_mass(q, shares);
  added_.setZero();
  for (std::size_t k = 0; k < models_.size(); ++k) {
    set_unbalanced(k, q, qd, command);
    added_ += weight(k, shares) * unbalanced_;
  }
  llt_.solveInPlace(added_);
  qdd = added_;
}

void AugmentedMotion::advance(const VectorXd& x, const VectorXd& command, VectorXd& next) noexcept {
  const auto f = [&](double /*t*/, const double* y, double* dydt) {
    const Eigen::Map<const VectorXd> at(y, size());
    Eigen::Map<VectorXd> rate(dydt, size());
    rate.setZero();
    rate.head(d_) = at.segment(d_, d_);
    accelerate(at, command, rate.segment(d_, d_));
  };
  between_ = x;
  for (int i = 0; i < substeps_; ++i) {
    f(0.0, between_.data(), slope_.data());
    stages_.step(f, 0.0, step_, between_, slope_, next);
    between_ = next;
  }
}

void AugmentedMotion::slopes(const VectorXd& x, const VectorXd& command, MatrixXd& out) noexcept {
  const auto q = x.head(d_), qd = x.segment(d_, d_);
  const bool alone = models_.size() == 1;
  if (alone && force_.empty()) {
    state_jacobian(models_[0], data_[0], q, qd, command, force_, A_);
    out = A_.bottomRows(d_);
    return;
  }
  // Forces of all models at the acceleration that they have together, eq. (95).
  accelerate(x, command, qdd_);
  const auto shares = x.tail(num_shares());
  if (alone) set_mass(q, shares);
  out.setZero();
  for (std::size_t k = 0; k < models_.size(); ++k) {
    mass_matrix(models_[k], data_[k], q, own_);
    set_unbalanced(k, q, qd, command);
    added_ = -unbalanced_;
    added_.noalias() += own_ * qdd_;
    state_jacobian_force(models_[k], data_[k], q, qd, command, force_, added_, A_);
    own_ *= weight(k, shares);
    out.leftCols(2 * d_).noalias() += own_ * A_.bottomRows(d_);
    if (k == 0) {
      out.rightCols(num_shares()).colwise() = added_;
    } else {
      out.col(out.cols() - num_shares() + static_cast<Index>(k) - 1) -= added_;
    }
  }
  if (!force_.empty()) {
    for (Index axis = 0; axis < 3; ++axis) {
      force_[0].force = Vector3d::Unit(axis);
      unbalanced_.setZero();
      add_wrench_force(model(), q, force_, unbalanced_);
      out.col(2 * d_ + axis) = unbalanced_;
    }
  }
  llt_.solveInPlace(out);
}

/// on_base_: what the base feels of one model, which is added with its weight.
void AugmentedMotion::add_base_wrench(std::size_t k, const ConstVectorRef& x,
                                      VectorRef out) noexcept {
  cdcr::base_wrench(models_[k], x.head(d_), x.segment(d_, d_), qdd_, force_, on_base_);
  out += weight(k, x.tail(num_shares())) * on_base_;
}

void AugmentedMotion::base_wrench(const VectorXd& x, const VectorXd& command,
                                  VectorRef out) noexcept {
  accelerate(x, command, qdd_);
  out.setZero();
  for (std::size_t k = 0; k < models_.size(); ++k) add_base_wrench(k, x, out);
}

const FeltBase& AugmentedMotion::felt_base(const VectorXd& x, const VectorXd& command) noexcept {
  if (felt_.known) return felt_;
  const auto q = x.head(d_), qd = x.segment(d_, d_);
  MatrixXd& H = felt_.slopes;
  felt_.known = true;
  felt_.x = x;
  slopes(x, command, change_);
  accelerate(x, command, qdd_);
  felt_.wrench.setZero();
  H.setZero();
  for (std::size_t k = 0; k < models_.size(); ++k) {
    base_slopes_[k].update(models_[k], q, qd, qdd_, base_change_);
    add_wrench_slopes(models_[k], q, force_, base_change_.leftCols(d_));
    base_change_ *= weight(k, x.tail(num_shares()));
    H.leftCols(2 * d_) += base_change_.leftCols(2 * d_);
    H.noalias() += base_change_.rightCols(d_) * change_;
    add_base_wrench(k, x, felt_.wrench);
    if (k == 0) {
      H.rightCols(num_shares()).colwise() -= on_base_;
    } else {
      H.col(H.cols() - num_shares() + static_cast<Index>(k) - 1) += on_base_;
    }
  }
  if (force_.empty()) return felt_;
  const Vector3d arm =
      pose(model(), q, force_[0].section, force_[0].fraction).p - model().robot().base_position;
  for (Index axis = 0; axis < 3; ++axis) {
    H(axis, 2 * d_ + axis) += 1.0;
    H.col(2 * d_ + axis).tail<3>() += arm.cross(Vector3d::Unit(axis));
  }
  return felt_;
}

}  // namespace cdcr::detail
