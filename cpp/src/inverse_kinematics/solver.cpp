#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.hpp"
#include "cdcr/inverse_kinematics.hpp"
#include "cdcr/robot_ode.hpp"
#include "dynamics/bending.hpp"

namespace cdcr {
namespace {

using Bend = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2, 1>;

// The Jacobian is of the size of one, and so is what damping is added to.
constexpr double first_damping = 1e-2, least_damping = 1e-13, most_damping = 1e12;
// A slope this small beside the residual is rounding error: the descent has come to rest.
constexpr double level = 1e-13;
// A step that keeps more than this share of the cost is slow; three of them, and the target is
// taken for out of reach, where Gauss and Newton's curvature misses most of the true one.
constexpr double slow = 0.7;
constexpr int slow_steps = 6;
// Second-order steps are for starts that may still win: cost at most this times the best.
constexpr double worth_refining = 1.5;
// Step of the differences that give the true curvature [rad].
constexpr double difference = 1e-5;
// Steps by a tenth of the way back, after which a shape is at rest but for rounding.
constexpr int max_retreats = 400;
// Random starts bend a section by no more than the one, and in every other by the other [rad].
constexpr double usual_start = 2.5, widest_start = detail::full_circle;

/// Inverse of the left Jacobian of SO(3): the rate of the rotation vector u of a rotation that
/// turns with the angular velocity omega is this times omega.
Matrix3d inverse_left_jacobian(const Vector3d& u) noexcept {
  const double a2 = u.squaredNorm(), half = 0.5 * std::sqrt(a2);
  // (1 - half cot half)/a^2; the series is exact to rounding where the quotient cancels.
  const double factor = a2 < 1e-4 ? 1.0 / 12.0 + a2 / 720.0 : (1.0 - half / std::tan(half)) / a2;
  Matrix3d hat;
  hat << 0.0, -u[2], u[1], u[2], 0.0, -u[0], -u[1], u[0], 0.0;
  return Matrix3d::Identity() - 0.5 * hat + factor * hat * hat;
}

/// The bending vector of a section, of a rod the first one; empty where its bending is locked.
template <class Vector>
auto bend_of(const Model& model, Vector& q, Index section) noexcept {
  const bool bends = model.robot().sections[static_cast<std::size_t>(section)].bending_order >= 0;
  return q.segment(model.first_coordinate(section), bends ? 2 : 0);
}

}  // namespace

/// Where the tip is at q, in the units of the residual: position, and rotation vector from R_.
InverseSolver::Residual InverseSolver::reached(const VectorXd& q) const noexcept {
  const Pose at = tip(*model_, q);
  Residual x = Residual::Zero();
  x.head<3>() = (at.p - model_->robot().base_position) / length_;
  if (with_rotation_) {
    const Eigen::AngleAxisd turn(Matrix3d(at.R * R_.transpose()));
    x.tail<3>() = weight_ * turn.angle() * turn.axis();
  }
  return x;
}

/// J^T r at q, where x = reached(q).
void InverseSolver::gradient(const VectorXd& q, const Residual& x, VectorXd& g) noexcept {
  tip_jacobian(*model_, q, J_);
  const Matrix3d turn = with_rotation_
                            ? Matrix3d(weight_ * inverse_left_jacobian(x.tail<3>() / weight_))
                            : Matrix3d(Matrix3d::Zero());
  for (Index k = 0; k < J_.cols(); ++k) {
    const Vector3d omega = J_.col(k).tail<3>();
    J_.col(k).head<3>() /= length_;
    J_.col(k).tail<3>().noalias() = turn * omega;
  }
  const Residual r = x - target_;
  g.noalias() = J_.transpose() * r;
}

/// H_: J^T J, or the true second derivatives of the cost by differences of its gradient.
void InverseSolver::curvature() noexcept {
  if (!second_order_) {
    H_.noalias() = J_.transpose().lazyProduct(J_);
    return;
  }
  for (Index k = 0; k < q_.size(); ++k) {
    trial_ = q_;
    trial_[k] = q_[k] + difference;
    gradient(trial_, reached(trial_), step_);
    trial_[k] = q_[k] - difference;
    gradient(trial_, reached(trial_), held_g_);
    H_.col(k) = (step_ - held_g_) / (2.0 * difference);
  }
  for (Index k = 0; k < q_.size(); ++k) {
    for (Index i = 0; i < k; ++i) H_(i, k) = H_(k, i) = 0.5 * (H_(i, k) + H_(k, i));
  }
}

/// Shortens the bending vectors that are beyond their limits, and draws what else leaves the
/// shapes of rods back towards rest.
void InverseSolver::keep_within_limits(VectorXd& q) const noexcept {
  // A hair less than the limit, so that rounding cannot put the length above it.
  constexpr double inside = 1.0 - 4.0 * std::numeric_limits<double>::epsilon();
  for (Index i = 0; i < max_theta_.size(); ++i) {
    auto bend = bend_of(*model_, q, i);
    const double theta = bend.norm();
    if (theta > inside * max_theta_[i]) bend *= inside * max_theta_[i] / theta;
  }
  if (!model_->has_rods()) return;
  for (int i = 0; i < max_retreats && check_shape(*model_, q) != Status::ok; ++i) {
    q += 0.1 * (model_->rest() - q);
  }
}

bool InverseSolver::stands_at_limit(const VectorXd& q, Index section) const noexcept {
  constexpr double near = 1.0 - 1e-12;
  return bend_of(*model_, q, section).norm() >= near * max_theta_[section];
}

/// Takes the outward direction n from a section that stands at its limit and would go on, in the
/// copies of gradient and curvature. What is left moves it along a circle, whose own curvature
/// adds the outward pull over the radius.
void InverseSolver::hold_at_limits() noexcept {
  held_H_ = H_;
  held_g_ = g_;
  for (Index i = 0; i < max_theta_.size(); ++i) {
    if (!stands_at_limit(q_, i)) continue;
    Bend n = bend_of(*model_, q_, i);
    n.normalize();
    const double pull = -n.dot(bend_of(*model_, g_, i));
    if (!(pull > 0.0)) continue;
    bend_of(*model_, held_g_, i) += pull * n;
    const Index first = model_->first_coordinate(i), size = n.size();
    auto rows = held_H_.middleRows(first, size);
    for (Index k = 0; k < q_.size(); ++k) rows.col(k) -= n.dot(rows.col(k)) * n;
    auto columns = held_H_.middleCols(first, size);
    for (Index k = 0; k < q_.size(); ++k) {
      columns.row(k) -= columns.row(k).dot(n.transpose()) * n.transpose();
    }
    const double curvature = pull / max_theta_[i];
    auto own = held_H_.block(first, first, size, size);
    for (Index k = 0; k < size; ++k) own.col(k) += (1.0 - curvature) * n[k] * n;
    own.diagonal().array() += curvature;
  }
}

/// Tries one damped step; true when it lowers the cost, and is taken.
bool InverseSolver::step() noexcept {
  hold_at_limits();
  held_H_.diagonal() += damping_ * metric_;
  llt_.compute(held_H_);
  bool taken = false;
  double ratio = 0.0;
  if (llt_.info() == Eigen::Success) {
    step_ = -held_g_;
    llt_.solveInPlace(step_);
    trial_ = q_ + step_;
    keep_within_limits(trial_);
    step_ = trial_ - q_;
    held_g_.noalias() = H_ * step_;
    const double promised = -step_.dot(g_ + 0.5 * held_g_);
    const Residual x = reached(trial_);
    // |r|^2 - |r'|^2 as a product, which keeps its digits when the target is far away.
    const double gained = 0.5 * (x_ - x).dot(x_ + x - 2.0 * target_);
    ratio = gained / promised;
    taken = promised > 0.0 && gained > 0.0;
    if (taken) {
      q_ = trial_;
      x_ = x;
      cost_ = 0.5 * (x_ - target_).squaredNorm();
    }
  }
  if (!taken || ratio < 0.25) {
    damping_ *= growth_;
    growth_ *= 2.0;
  } else {
    growth_ = 2.0;
    if (ratio > 0.75) damping_ = std::fmax(0.1 * damping_, least_damping);
  }
  return taken;
}

/// From q_ down to where the tip is reached or no step leads further down.
void InverseSolver::levenberg_marquardt() noexcept {
  keep_within_limits(q_);
  x_ = reached(q_);
  cost_ = 0.5 * (x_ - target_).squaredNorm();
  damping_ = first_damping;
  growth_ = 2.0;
  second_order_ = false;
  bool moved = true;
  int slow_ones = 0;
  for (int i = 0; i < options_.iterations && cost_ > goal_ && !stopped(); ++i) {
    if (moved) {
      gradient(q_, x_, g_);
      curvature();
      hold_at_limits();
      if (!(held_g_.norm() > level * std::sqrt(2.0 * cost_))) return;
    }
    const double before = cost_;
    moved = step();
    ++answer_.iterations;
    if (damping_ > most_damping) return;
    if (second_order_ || !moved || cost_ < slow * before || ++slow_ones < slow_steps) continue;
    if (cost_ > worth_refining * best_cost_) return;
    second_order_ = true;
  }
}

/// Evenly between 0 and 1, the same numbers in every search: Lehmer's generator.
double InverseSolver::random() noexcept {
  constexpr std::uint64_t factor = 48271, modulus = 2147483647;
  random_state_ = factor * random_state_ % modulus;
  return static_cast<double>(random_state_ - 1) / static_cast<double>(modulus - 2);
}

/// Starts of the search, the same for the same target: an arc towards it, an S, then random ones.
void InverseSolver::place_start(int seed) noexcept {
  const Index n = model_->num_sections();
  // Eq. (7) for an arc of the whole robot, bent at least a little: straight, it would not see a
  // target on its axis.
  constexpr double least_bend = 0.2;
  const double arc = std::fmax(2.0 * std::atan2(rho_, z_), least_bend) / static_cast<double>(n);
  q_ = model_->rest();
  for (Index i = 0; i < n; ++i) {
    auto bend = bend_of(*model_, q_, i);
    if (bend.size() == 0) continue;
    if (seed == 0) {
      bend = arc * towards_;
    } else if (seed == 1) {
      bend = (2 * i < n ? 1.0 : -1.0) * towards_;
    } else {
      const double theta = std::fmin(max_theta_[i], seed % 2 == 0 ? usual_start : widest_start) *
                           std::sqrt(random());
      const double phi = detail::full_circle * random();
      bend << theta * std::cos(phi), theta * std::sin(phi);
    }
  }
}

/// Whether the caller has ended the search.
bool InverseSolver::stopped() noexcept {
  if (asked_ == IkStatus::reached && options_.stop && options_.stop()) {
    asked_ = IkStatus::interrupted;
  }
  return asked_ != IkStatus::reached;
}

void InverseSolver::search(const ConstVectorRef& q0) noexcept {
  best_cost_ = std::numeric_limits<double>::infinity();
  random_state_ = 1;
  const int given = q0.size() > 0 ? 1 : 0;
  while (answer_.seeds < options_.seeds && best_cost_ > accepted_ && !stopped()) {
    if (answer_.seeds < given) {
      q_ = q0;
    } else {
      place_start(answer_.seeds - given);
    }
    levenberg_marquardt();
    ++answer_.seeds;
    if (!(cost_ < best_cost_)) continue;
    best_ = q_;
    best_cost_ = cost_;
  }
}

}  // namespace cdcr
