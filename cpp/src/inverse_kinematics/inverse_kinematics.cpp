#include "cdcr/inverse_kinematics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/arguments.hpp"
#include "base/constants.hpp"
#include "base/rotation.hpp"

namespace cdcr {
namespace {

using detail::full_circle, detail::pi, detail::require;

// A farther target is moved to this many lengths from the base: from there the nearest shape is
// the same to rounding, and squares do not overflow.
constexpr double farthest = 1e6;

/// Squared distance, in units of the length, between the tip at angle theta and the point
/// (rho, z) of the bending plane.
double squared_distance(double theta, double rho, double z) noexcept {
  const double half = std::sin(0.5 * theta);
  const double sideways = theta > 0.0 ? 2.0 * half * half / theta : 0.0;
  const double upwards = theta > 0.0 ? std::sin(theta) / theta : 1.0;
  return (sideways - rho) * (sideways - rho) + (upwards - z) * (upwards - z);
}

/// Angle of the nearest point of the tip curve up to `limit`: the best of a grid fine enough to
/// tell its valleys apart, then golden section search between the neighbours of that point.
double nearest_angle(double rho, double z, double limit) noexcept {
  constexpr int num_points = 256;
  const double spacing = limit / num_points;
  int best = 0;
  for (int i = 1; i <= num_points; ++i) {
    if (squared_distance(i * spacing, rho, z) < squared_distance(best * spacing, rho, z)) best = i;
  }
  double low = std::fmax(0.0, (best - 1) * spacing);
  double high = std::fmin(limit, (best + 1) * spacing);
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (high - low > 1e-9) {  // a minimum is located to the square root of rounding at best
    const double left = high - golden * (high - low);
    const double right = low + golden * (high - low);
    if (squared_distance(left, rho, z) < squared_distance(right, rho, z)) {
      high = right;
    } else {
      low = left;
    }
  }
  const double middle = 0.5 * (low + high);
  // The ends of the range are candidates of their own: the search never quite reaches them.
  double theta = middle;
  for (const double end : {0.0, limit}) {
    if (squared_distance(end, rho, z) < squared_distance(theta, rho, z)) theta = end;
  }
  return theta;
}

/// Eq. (7) for the point (rho, z), in units of the length; where that does not lead to it, the
/// nearest angle from 0 to `limit`.
double one_section_angle(double rho, double z, double limit) noexcept {
  // What counts as rounding error in a distance, in units of the length.
  constexpr double rounding = 1e-14;
  double theta = 2.0 * std::atan2(rho, z);  // the chord leaves at half the angle
  if (rho == 0.0 && z <= 0.0) theta = full_circle;
  theta = std::fmin(theta, limit);
  if (squared_distance(theta, rho, z) <= rounding * rounding) return theta;
  const double nearest = nearest_angle(rho, z, limit);
  return squared_distance(nearest, rho, z) < squared_distance(theta, rho, z) ? nearest : theta;
}

void check_max_theta(const VectorXd& max_theta, Index num_sections) {
  const Index size = max_theta.size();
  require(size == 1 || size == num_sections, "max_theta must be one angle or one for each of the ",
          num_sections, " sections, got ", size);
  for (Index i = 0; i < size; ++i) {
    require(max_theta[i] > 0.0 && max_theta[i] <= max_bending, "max_theta",
            size > 1 ? detail::sentence("[", i, "] (section ", i + 1, ")") : "",
            " must be > 0 and at most 3 pi rad, got ", max_theta[i]);
  }
}

void check_count(int value, const char* name) {
  constexpr int most = 100000;
  require(value >= 1 && value <= most, name, " must be 1 to ", most, ", got ", value);
}

/// The rotation nearest to R, which must be one to within what printed digits lose.
Matrix3d read_rotation(const Matrix3d& R) {
  const double skew = detail::skew_of(R);
  require(R.allFinite(), "R must be finite");
  require(skew <= detail::rotation_digits,
          "R must be a rotation matrix, but R^T R differs from the unit matrix by ", skew);
  require(R.determinant() > 0.0,
          "R must be a rotation matrix, but its determinant is -1: it mirrors");
  return detail::nearest_rotation(R);
}

}  // namespace

InverseSolver::InverseSolver(const Model& model, const InverseKinematicsOptions& options)
    : model_(&model), options_(options), llt_(model.num_coordinates()) {
  const Index n = model.num_sections(), m = model.num_coordinates();
  if (options.max_theta.size() > 0) check_max_theta(options.max_theta, n);
  if (options.orientation_weight) {
    detail::require_positive("orientation_weight", *options.orientation_weight, "m");
  }
  if (options.tolerance) detail::require_positive("tolerance", *options.tolerance, "m");
  check_count(options.seeds, "seeds");
  check_count(options.iterations, "iterations");
  for (const Section& section : model.robot().sections) length_ += section.length;
  tool_reach_ = model.robot().tool.topRightCorner<3, 1>().norm();
  weight_ = options.orientation_weight.value_or(length_ / pi) / length_;
  // Targets have as many digits as single precision or a printed one; a search goes on to rounding.
  tolerance_ = options.tolerance.value_or(1e-6 * length_);
  accepted_ = 0.5 * std::pow(tolerance_ / length_, 2);
  goal_ = options.tolerance ? accepted_ : 0.5 * std::pow(1e-9, 2);
  max_theta_ = VectorXd::Constant(n, full_circle);
  if (options.max_theta.size() == 1) max_theta_.setConstant(options.max_theta[0]);
  if (options.max_theta.size() == n) max_theta_ = options.max_theta;
  metric_ = VectorXd::Ones(m);
  if (model.has_rods()) {  // what is stiff moves little: stretch far less than bending
    metric_ = model.elastic_stiffness().diagonal() / model.stiffness().minCoeff();
  }
  q_ = best_ = trial_ = step_ = g_ = held_g_ = answer_.q = VectorXd::Zero(m);
  J_ = MatrixXd::Zero(6, m);
  H_ = held_H_ = MatrixXd::Zero(m, m);
}

const InverseKinematics& InverseSolver::solve(const Vector3d& p, const std::optional<Matrix3d>& R,
                                              const ConstVectorRef& q0) noexcept {
  answer_.seeds = answer_.iterations = 0;
  set_target(p, R);
  best_.setZero();
  const bool fits = q0.size() == 0 || q0.size() == q_.size();
  const bool finite = p.allFinite() && R_.allFinite() && q0.allFinite();
  asked_ = !fits ? IkStatus::wrong_size : finite ? IkStatus::reached : IkStatus::not_finite;
  const bool on_arc = model_->num_sections() == 1 && tool_reach_ == 0.0 && !model_->has_rods();
  if (asked_ == IkStatus::reached && on_arc && !with_rotation_) {
    best_ = one_section_angle(rho_, z_, max_theta_[0]) * towards_;
    keep_within_limits(best_);
  } else if (asked_ == IkStatus::reached) {
    search(q0);
  }
  conclude();
  return answer_;
}

void InverseSolver::set_target(const Vector3d& p, const std::optional<Matrix3d>& R) noexcept {
  p_ = p;
  with_rotation_ = R.has_value();
  R_ = R.value_or(Matrix3d::Identity());
  target_.setZero();
  const Vector3d from_base = p - model_->robot().base_position;
  target_.head<3>() = from_base / std::fmax(length_, (from_base / farthest).stableNorm());
  const Vector3d seen = model_->robot().base_orientation.transpose() * target_.head<3>();
  rho_ = std::hypot(seen[0], seen[1]);
  z_ = seen[2];
  const bool on_axis = rho_ < std::numeric_limits<double>::min();
  towards_ << (on_axis ? 1.0 : seen[0] / rho_), (on_axis ? 0.0 : seen[1] / rho_);
}

/// Says of best_ what it reaches, and why not more.
void InverseSolver::conclude() noexcept {
  const Pose at = tip(*model_, best_);
  answer_.q = best_;
  answer_.position = at.p;
  answer_.rotation = at.R;
  answer_.distance = (at.p - p_).stableNorm();
  answer_.angle = 0.0;
  if (with_rotation_) answer_.angle = Eigen::AngleAxisd(Matrix3d(at.R * R_.transpose())).angle();
  answer_.residual = std::hypot(answer_.distance, weight_ * length_ * answer_.angle);
  answer_.reachable = answer_.residual <= tolerance_;
  answer_.reach = why();
}

double InverseSolver::distance_from_base() const noexcept {
  return (p_ - model_->robot().base_position).stableNorm();
}

IkStatus InverseSolver::why() const noexcept {
  if (asked_ != IkStatus::reached) return asked_;
  if (answer_.reachable) return IkStatus::reached;
  const bool stretches =
      std::any_of(model_->robot().sections.begin(), model_->robot().sections.end(),
                  [](const Section& section) { return section.stretch_order >= 0; });
  if (!stretches && distance_from_base() > length_ + tool_reach_ + tolerance_) {
    return IkStatus::too_far;
  }
  for (Index i = 0; i < max_theta_.size(); ++i) {
    if (stands_at_limit(best_, i)) return IkStatus::at_limit;
  }
  if (with_rotation_ && model_->num_coordinates() < 6) return IkStatus::too_few_sections;
  return model_->num_coordinates() == 2 ? IkStatus::off_surface : IkStatus::not_found;
}

std::string InverseSolver::message() const {
  std::ostringstream text;
  const Index n = model_->num_sections();
  std::string limited;
  switch (answer_.reach) {
    case IkStatus::reached:
      return "";
    case IkStatus::not_finite:
      return "p, R and q0 must be finite";
    case IkStatus::wrong_size:
      return "q0 must have a value for each of the " + std::to_string(q_.size()) +
             " coordinates, or none at all";
    case IkStatus::too_far:
      text << "p is " << distance_from_base() << " m from the base, farther than the robot's "
           << length_ << " m";
      if (tool_reach_ > 0.0) text << " and its tool's " << tool_reach_ << " m";
      break;
    case IkStatus::at_limit:
      for (Index i = 0; i < n; ++i) {
        if (!stands_at_limit(best_, i)) continue;
        text << (limited.empty() ? "section " : " and section ") << i + 1
             << " stands at its max_theta of " << max_theta_[i] << " rad";
        limited = text.str();
      }
      break;
    case IkStatus::interrupted:
      text << "the search was stopped";
      break;
    case IkStatus::off_surface:
      text << "the tip of one section moves on a surface, and p is not on it";
      break;
    case IkStatus::too_few_sections:
      text << n << (n == 1 ? " section has " : " sections have ") << model_->num_coordinates()
           << " coordinates, too few for the 6 of a position and an orientation";
      break;
    case IkStatus::not_found:
      text << "none of " << answer_.seeds << " starts led there, more seeds may";
      break;
  }
  text.precision(3);
  text << "; the nearest found is " << answer_.distance << " m ";
  if (with_rotation_) text << "and " << answer_.angle << " rad ";
  text << "off";
  return text.str();
}

InverseKinematics inverse_kinematics(const Model& model, const Vector3d& p,
                                     const std::optional<Matrix3d>& R, const VectorXd& q0,
                                     const InverseKinematicsOptions& options) {
  require(p.allFinite(), "p must be finite, got [", p.transpose(), "]");
  require(q0.size() == 0 || (q0.size() == model.num_coordinates() && q0.allFinite()), "q0 must be ",
          model.num_coordinates(), " finite angles, got ", detail::Listed{q0});
  InverseSolver solver(model, options);
  InverseKinematics answer =
      solver.solve(p, R ? std::optional<Matrix3d>(read_rotation(*R)) : std::nullopt, q0);
  answer.message = solver.message();
  return answer;
}

}  // namespace cdcr
