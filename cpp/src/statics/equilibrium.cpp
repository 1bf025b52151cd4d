#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "base/eigenvalues.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/robot_ode.hpp"
#include "cdcr/statics.hpp"
#include "dynamics/bending.hpp"
#include "statics/static_problem.hpp"

namespace cdcr {
namespace {

using detail::StaticProblem;

constexpr int max_iterations = 200;
// A stiffness this small beside the largest is zero but for rounding.
constexpr double neutral = 1e-12;
// [rad], of one section: farther than this a linear model of the robot means little.
constexpr double longest_step = 1.0;
// Unbalanced moment over its rounding error that a stalled search may be left with.
constexpr double stalled = 1e3;
// What a step with the stiffness of the last one may leave of the unbalanced moment, and one with
// that of the backbone alone; how many of these are made at most.
constexpr double much_nearer = 1e-2, nearer = 0.3;
constexpr int backbone_steps = 2;
// Load steps: the first, and the one below which the robot may snap to another shape.
constexpr double first_load_step = 0.25, snap_load_step = 1e-3;
constexpr int max_load_steps = 400;
constexpr int max_searches = 64;

bool within_limit(const Model& model, const VectorXd& q) {
  return q.allFinite() && check_shape(model, q) == Status::ok;
}

/// Newton's method from one start.
class NewtonSolver {
 public:
  explicit NewtonSolver(StaticProblem& problem)
      : problem_(problem),
        K_(problem.model().num_coordinates(), problem.model().num_coordinates()),
        r_(K_.rows()),
        trial_(K_.rows()),
        trial_r_(K_.rows()),
        unit_(problem.model().elastic_stiffness().diagonal().cwiseSqrt().cwiseInverse()),
        llt_(K_.rows()),
        lu_(K_.rows()) {}

  /// Moves q to a point of rest; true when it got there.
  bool run(VectorXd& q) {
    problem_.residual(q, r_);
    double merit = merit_of(q, r_);
    step_by_backbone(q, merit);
    for (int i = 0; i < max_iterations && size(r_) > problem_.rounding_bound(q);
         ++i, ++iterations_) {
      problem_.stiffness(q, K_);
      VectorXd step = problem_.has_energy() ? modified_newton_step() : newton_step();
      const double longest = detail::largest_bending(problem_.model(), step);
      if (!(longest < HUGE_VAL)) break;
      if (longest > longest_step) {
        step *= longest_step / longest;
        serves_again_ = false;
      }
      if (!move(q, step, merit)) break;
      while (step_again(q, merit, much_nearer)) {
      }
    }
    // A search stalled by rounding has converged as far as the arithmetic allows; loads that
    // overflow when squared have no scale to tell.
    const double bound = problem_.rounding_bound(q);
    return std::isfinite(bound) && r_.allFinite() && size(r_) <= stalled * bound;
  }

  [[nodiscard]] int iterations() const { return iterations_; }
  /// Largest component of what is out of balance where the last search ended.
  [[nodiscard]] double residual() const { return size(r_); }

 private:
  static double size(const VectorXd& r) { return r.lpNorm<Eigen::Infinity>(); }

  /// What each step has to lower: the energy, or else the unbalanced moment.
  double merit_of(const VectorXd& q, const VectorXd& r) {
    return problem_.has_energy() ? problem_.energy(q) : 0.5 * r.squaredNorm();
  }

  /// Newton step with the eigenvalues of K made positive, so that it always points downhill.
  /// Coordinates are scaled to be alike in elastic energy, as stretch is far stiffer than bending.
  VectorXd modified_newton_step() {
    scaled_.noalias() = unit_.asDiagonal() * K_ * unit_.asDiagonal();
    const VectorXd scaled_r = unit_.cwiseProduct(r_);
    llt_.compute(scaled_);
    const auto pivots = llt_.matrixLLT().diagonal();
    serves_again_ = llt_.info() == Eigen::Success && pivots.minCoeff() > 1e-2 * pivots.maxCoeff();
    if (serves_again_) return -unit_.cwiseProduct(llt_.solve(scaled_r));
    const auto [values, vectors] = detail::symmetric_eigen(scaled_);
    const double floor = 1e-6 * values.cwiseAbs().maxCoeff();
    const VectorXd curvature = values.cwiseAbs().cwiseMax(floor);
    const VectorXd in_eigenbasis = vectors.transpose() * scaled_r;
    return -unit_.cwiseProduct(vectors * in_eigenbasis.cwiseQuotient(curvature));
  }

  /// Newton step, or where K is singular the gradient's way with the largest stiffness.
  VectorXd newton_step() {
    lu_.compute(K_);
    VectorXd step = -lu_.solve(r_);
    const double slope = r_.dot(K_ * step);
    serves_again_ = step.allFinite() && slope < -0.5 * r_.squaredNorm();
    if (serves_again_) return step;
    return -K_.transpose() * r_ / std::fmax(K_.squaredNorm(), 1e-300);
  }

  /// A step with the stiffness of the last one, since that of a rod costs more than the force out
  /// of balance; false, and no step, where it does not leave less than a share of that.
  bool step_again(VectorXd& q, double& merit, double share) {
    if (!serves_again_ || !problem_.model().has_rods()) return false;
    if (size(r_) <= problem_.rounding_bound(q)) return false;
    if (problem_.has_energy()) {
      trial_ = q - unit_.cwiseProduct(llt_.solve(unit_.cwiseProduct(r_)));
    } else {
      trial_ = q - lu_.solve(r_);
    }
    if (!within_limit(problem_.model(), trial_)) return false;
    problem_.residual(trial_, trial_r_);
    if (!(trial_r_.norm() < share * r_.norm())) return false;
    const double trial_merit = merit_of(trial_, trial_r_);
    if (!(trial_merit <= merit + 1e-12 * std::abs(merit))) return false;
    accept(q, merit, trial_merit);
    return true;
  }

  /// The first steps with the stiffness of the backbone alone, where they lead nearer.
  void step_by_backbone(VectorXd& q, double& merit) {
    if (!problem_.has_energy() || !problem_.model().has_rods()) return;
    scaled_.noalias() =
        unit_.asDiagonal() * problem_.model().elastic_stiffness() * unit_.asDiagonal();
    llt_.compute(scaled_);
    serves_again_ = llt_.info() == Eigen::Success;
    for (int i = 0; i < backbone_steps && step_again(q, merit, nearer); ++i) {
    }
  }

  void accept(VectorXd& q, double& merit, double trial_merit) {
    q.swap(trial_);
    r_.swap(trial_r_);
    merit = trial_merit;
  }

  /// Goes along the step as far as the merit falls, by Armijo's rule; near the end differences
  /// are rounding error, so there a smaller unbalanced moment counts as progress too.
  bool move(VectorXd& q, const VectorXd& step, double& merit) {
    const bool near = size(r_) <= stalled * problem_.rounding_bound(q);
    const double slope = problem_.has_energy() ? r_.dot(step) : r_.dot(K_ * step);
    const int last_halving = near ? 0 : 32;
    double factor = 1.0;
    for (int halving = 0; halving <= last_halving; ++halving, factor *= 0.5) {
      trial_ = q + factor * step;
      if (!within_limit(problem_.model(), trial_)) continue;
      problem_.residual(trial_, trial_r_);
      const double trial_merit = merit_of(trial_, trial_r_);
      const bool falls = !near && trial_merit <= merit + 1e-4 * factor * slope;
      const bool closer = halving == 0 && trial_r_.norm() < 0.9 * r_.norm() &&
                          trial_merit <= merit + 1e-12 * std::abs(merit);
      if (!falls && !closer) continue;
      accept(q, merit, trial_merit);
      serves_again_ = serves_again_ && halving == 0;
      return true;
    }
    return false;
  }

  StaticProblem& problem_;
  MatrixXd K_, scaled_;
  VectorXd r_, trial_, trial_r_;
  VectorXd unit_;                     // of each coordinate
  Eigen::LLT<MatrixXd> llt_;          // of what has an energy, scaled
  Eigen::PartialPivLU<MatrixXd> lu_;  // of anything else
  bool serves_again_ = false;         // whether the last step was a whole one of Newton's
  int iterations_ = 0;
};

/// Lets the load grow from nothing to all, each time from the rest before; true when all is on.
bool continuation(StaticProblem& problem, NewtonSolver& search, VectorXd& q, int& load_steps) {
  q = problem.model().rest();
  double load = 0.0, step = first_load_step;
  bool arrived = false;
  while (!arrived && load_steps < max_load_steps && step > 1e-6) {
    ++load_steps;
    const double next = std::fmin(1.0, load + step);
    problem.set_load_factor(next);
    VectorXd moved = q;
    const bool rests = search.run(moved);
    const bool near = detail::largest_bending(problem.model(), moved - q) <= longest_step ||
                      step <= snap_load_step;
    if (!rests || !near) {
      step *= 0.5;
      continue;
    }
    q = moved;
    load = next;
    step *= 2.0;
    arrived = load == 1.0;
  }
  problem.set_load_factor(1.0);
  return arrived;
}

VectorXd linear_guess(const Model& model, const VectorXd& command) {
  VectorXd q = VectorXd::Zero(model.num_coordinates());
  for (Index j = 0; j < model.num_cables(); ++j) {
    if (model.cables()[static_cast<std::size_t>(j)].length_driven()) continue;
    q += model.actuation_matrix().col(j) * command[j];
  }
  if (!model.has_rods()) return q.cwiseQuotient(model.elastic_stiffness().diagonal());
  return model.rest() + model.elastic_stiffness().llt().solve(q);
}

/// From other places, the same in every call.
bool multistart(const Model& model, NewtonSolver& search, VectorXd& q, int& searches) {
  // Its numbers are the same everywhere.
  std::mt19937 engine(1);  // NOLINT(bugprone-random-generator-seed): so must the answer be
  while (searches < max_searches) {
    ++searches;
    const double width = searches % 2 == 0 ? 3.0 : 8.0;  // [rad]
    for (double& component : q) {
      component = width * (static_cast<double>(engine()) / 4294967296.0 - 0.5);
    }
    if (model.has_rods()) {  // alike in energy: stretch far less than bending
      const VectorXd stiffness = model.elastic_stiffness().diagonal();
      q.array() *= (model.stiffness().minCoeff() / stiffness.array()).min(1.0).sqrt();
      q += model.rest();
    }
    if (search.run(q)) return true;
  }
  return false;
}

/// Direct, then by growing load, then from elsewhere. The first failure is what a failure shows.
void find(StaticProblem& problem, Equilibrium& result) {
  NewtonSolver search(problem);
  VectorXd& q = result.q;
  const Status started = check_shape(problem.model(), q);
  if (!within_limit(problem.model(), q)) q = problem.model().rest();
  result.searches = 1;
  bool found = search.run(q);
  result.residual = search.residual();
  VectorXd other = q;
  if (!found) {
    ++result.searches;
    found = continuation(problem, search, other, result.load_steps);
  }
  if (!found) found = multistart(problem.model(), search, other, result.searches);
  result.iterations = search.iterations();
  if (found) {
    q = other;
    result.residual = search.residual();
    result.status = Status::ok;
  } else if (const Status ended = check_shape(problem.model(), 1.001 * q); ended != Status::ok) {
    result.status = ended;
  } else if (started != Status::ok) {
    result.status = started;
  }
}

void classify_stability(StaticProblem& problem, Equilibrium& result) {
  MatrixXd K(result.q.size(), result.q.size());
  problem.stiffness(result.q, K);
  if (problem.has_energy()) {
    result.eigenvalues = detail::symmetric_eigenvalues(K);
  } else {
    result.eigenvalues = detail::eigenvalues(K).real();
    std::sort(result.eigenvalues.begin(), result.eigenvalues.end());
  }
  result.stable = result.eigenvalues.minCoeff() > neutral * result.eigenvalues.maxCoeff();
}

}  // namespace

Equilibrium equilibrium(const Model& model, const VectorXd& command, const VectorXd& q0,
                        const Wrenches& wrenches) {
  require_command(model, command);
  if (q0.size() != 0) detail::require_finite("q0", q0, model.num_coordinates());
  validate(model, wrenches);
  StaticProblem problem(model, command, wrenches);
  Equilibrium result;
  result.q = q0.size() == 0 ? linear_guess(model, command) : q0;
  result.friction_left_out = model.has_friction();
  find(problem, result);
  classify_stability(problem, result);
  const VectorXd rest = VectorXd::Zero(result.q.size());
  result.tension.resize(model.num_cables());
  cable_tensions(model, result.q, rest, command, result.tension);
  return result;
}

}  // namespace cdcr
