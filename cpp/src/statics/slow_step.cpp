#include "statics/slow_step.hpp"

#include <algorithm>
#include <cmath>

#include "cdcr/dynamics.hpp"
#include "cdcr/robot_ode.hpp"
#include "cdcr/statics.hpp"
#include "dynamics/bending.hpp"
#include "loads/force_derivatives.hpp"
#include "loads/wrench_force.hpp"

namespace cdcr::detail {
namespace {

constexpr int max_iterations = 40;
// Steps after which the curvature of the energy is computed anew.
constexpr int keep_curvature = 3;
// Out of balance over its size, from where one more step most likely ends the search.
constexpr double nearly = 1e-7;
// How much of a change of commands may differ from the last for the robot to go on as before.
constexpr double smooth_way = 0.2;
// Places looked at along a step, and the share of the slope that may remain.
constexpr int max_searches = 6;
constexpr double kept_slope = 0.8;
// Out of balance over its rounding that a search may be left with.
constexpr double stalled_by = 1e3;
// [rad], of one section.
constexpr double longest_step = 0.5;
// Stiffness of a cable that sticks, over that of the robot which it bends, where none is given.
constexpr double sticks_by = 2e2;
// Out of balance over the size of the forces in it: rounding, with a margin.
constexpr double smooth = 1e-14, sticky = 2e-15;
// [N m]; below, numbers lose digits.
constexpr double least = 1e-290;

}  // namespace

SlowStep::SlowStep(const Model& model, const Wrenches& wrenches)
    : model_(model), wrenches_(wrenches), data_(model), stick_(model.robot().presliding_stiffness) {
  const Index d = model.num_coordinates(), m = model.num_cables();
  if (!(stick_ > 0.0)) {
    double nearest = HUGE_VAL;
    for (Index j = 0; j < m; ++j) {
      nearest = std::fmin(nearest, model.actuation_matrix().col(j).lpNorm<Eigen::Infinity>());
    }
    if (m > 0) stick_ = sticks_by * model.stiffness().maxCoeff() / (nearest * nearest);
  }
  q_ = trial_ = moved_ = moved_from_ = r_ = step_ = size_ = strain_ = change_ = VectorXd::Zero(d);
  command_ = command_at_rest_ = command_change_ = deflection_ = tension_ = friction_ =
      end_tension_ = new_deflection_ = VectorXd::Zero(m);
  sliding_.assign(static_cast<std::size_t>(m), Sliding::sticks);
  before_ = sliding_;
  H_ = K_ = MatrixXd::Zero(d, d);
  slopes_ = MatrixXd::Zero(model.num_sections() + 2, model.num_sections());
  turned_.resize(static_cast<std::size_t>(model.num_sections()));
  lu_ = Eigen::PartialPivLU<MatrixXd>(d);
}

void SlowStep::reset(const VectorXd& q, const VectorXd& deflection) {
  q_ = q;
  deflection_ = deflection;
  change_.setZero();
  command_change_.setZero();
}

/// Of the backbone, its weight and wrenches; of rods that of cables that slide freely too.
void SlowStep::set_curvature(const VectorXd& q) noexcept {
  if (model_.has_rods()) return static_stiffness(model_, data_, q, command_, wrenches_, H_);
  potential_hessian(model_, data_, q, H_);
  subtract_wrench_stiffness(model_, q, wrenches_, H_);
}

void SlowStep::balance(const VectorXd& q, Wanted wanted) noexcept {
  potential_gradient(model_, data_, q, r_);
  strain_ = q - model_.rest();
  size_ = r_.cwiseAbs();  // and of what in it is in balance with weight
  size_ += model_.elastic_stiffness().lazyProduct(strain_).cwiseAbs();
  if (!wrenches_.empty()) {
    data_.force.setZero();
    add_wrench_force(model_, q, wrenches_, data_.force);
    r_ -= data_.force;
    size_ += data_.force.cwiseAbs();
  }
  if (wanted != Wanted::force) K_ = H_;
  sticking_ = 0.0;
  bent_ = q.lpNorm<Eigen::Infinity>();
  moved_ = q - q_;
  CableGeometry<double> geometry(model_, q.data());
  for (Index j = 0; j < model_.num_cables(); ++j) {
    geometry.set_cable(j);
    add_cable(geometry, j, q, wanted);
  }
}

/// The return mapping of one cable, eq. (114).
void SlowStep::add_cable(CableGeometry<double>& at, Index j, const VectorXd& q,
                         Wanted wanted) noexcept {
  const Cable& cable = model_.cables()[static_cast<std::size_t>(j)];
  double tension = command_[j];
  const auto lever = [&] {
    const Index size = model_.first_coordinate(at.last() + 1);
    return Eigen::Map<const VectorXd>(at.column(), size).lpNorm<Eigen::Infinity>();
  };
  if (cable.length_driven()) {
    tension =
        std::fmax(0.0, cable.stiffness * (at.length() - command_[j] - model_.slack_offset()[j]));
    size_.array() += cable.stiffness * at.length() * lever();
  }
  FrictionProfile<double> profile(tension, cable.entry_friction, model_.sheath_decay()[j],
                                  at.ways()[at.last()]);
  Sliding way = Sliding::sticks;
  double friction = 0.0, slid = 0.0;
  if (!(profile.most_out() > 0.0)) {
    for (int k = at.first(); k <= at.last(); ++k) slid += at.pulled_in(k, moved_.data());
    if (slid > 0.0) way = Sliding::pulled_in;
    if (slid < 0.0) way = Sliding::paid_out;
  } else {
    profile.set_friction(limited(stick_ * deflection_[j], profile.most_in(), profile.most_out()));
    for (int k = at.first(); k <= at.last(); ++k) {
      slid += profile.share(at.ways()[k]) * at.pulled_in(k, moved_.data());
    }
    const double asked = stick_ * (deflection_[j] + slid);
    friction = limited(asked, profile.most_in(), profile.most_out());
    if (asked >= profile.most_in()) way = Sliding::pulled_in;
    if (asked <= -profile.most_out()) way = Sliding::paid_out;
    profile.set_friction(friction);
    if (way == Sliding::sticks) {
      const double arm = lever();
      sticking_ = std::fmax(sticking_, stick_ * arm * arm * bent_);
    }
  }
  for (int k = at.first(); k <= at.last(); ++k) {
    const double mean = profile.mean(at.ways()[k]);
    for (Index i = model_.first_coordinate(k); i < model_.first_coordinate(k + 1); ++i) {
      const double pull = at.column()[i] * mean;
      r_[i] -= pull;
      size_[i] += std::abs(pull);
    }
  }
  tension_[j] = tension;
  friction_[j] = friction;
  end_tension_[j] = profile.end();
  new_deflection_[j] = profile.most_out() > 0.0 ? friction / stick_ : 0.0;
  sliding_[static_cast<std::size_t>(j)] = way;
  if (wanted == Wanted::force) return;
  if (wanted == Wanted::as_before && way == Sliding::sticks) {
    way = before_[static_cast<std::size_t>(j)];
  }
  add_stiffness(at, j, q, profile, cable.length_driven() && tension > 0.0, way);
}

/// Takes the derivative of a cable's force from K, eq. (115).
void SlowStep::add_stiffness(const CableGeometry<double>& at, Index j, const VectorXd& q,
                             const FrictionProfile<double>& profile, bool taut,
                             Sliding way) noexcept {
  const Cable& cable = model_.cables()[static_cast<std::size_t>(j)];
  const double* b = at.column();
  const Index begin = model_.first_coordinate(at.first()),
              end = model_.first_coordinate(at.last() + 1);
  if (way == Sliding::sticks && profile.most_out() > 0.0) {
    return add_stuck_stiffness(at, j, q, taut && !model_.has_rods());
  }
  const double F = tension_[j];
  double through = 1.0;  // d(mean tension)/dF, relative
  if (F > 0.0 && profile.most_out() > 0.0) {
    const double e = cable.entry_friction;
    const bool in = way == Sliding::pulled_in;
    through = in ? (F > e ? F / (F - e) : 0.0) : F / (F + e);
  }
  const bool in = way == Sliding::pulled_in, by_tension = taut && !model_.has_rods();
  const bool by_turns = !model_.has_rods() && profile.most_out() > 0.0;
  double falls[2 * max_sections];  // of a mean with a turn before it, by q, relative
  for (int k = at.first(); k <= at.last(); ++k) {
    const double mean = profile.mean(at.ways()[k]);
    const Index row = model_.first_coordinate(k);
    if (by_tension) {
      const double on_F = cable.stiffness * (F > 0.0 ? through * mean / F : 1.0);
      for (Index l = begin; l < end; ++l) {
        K_(row, l) += b[row] * on_F * b[l];
        K_(row + 1, l) += b[row + 1] * on_F * b[l];
      }
    }
    if (!by_turns) continue;
    // By the turns before, and by its own about half as much.
    const double mu = model_.friction()(k, j), turn = at.turn(k);
    const double falls_by = mu > 0.0 && turn > 0.0 ? (in ? mu : -mu) / turn : 0.0;
    const double own = falls_by != 0.0 ? at.factors(k).own_share(mu * turn, in) : 0.0;
    for (Index l = row; l < row + 2; ++l) falls[l] = falls_by * q[l];
    for (Index l = begin; l < row + 2; ++l) {
      const double slope = mean * falls[l] * (l < row ? 1.0 : own);
      K_(row, l) += b[row] * slope;
      K_(row + 1, l) += b[row + 1] * slope;
    }
  }
}

/// The same of a cable that sticks, whose friction depends on the way slid, tension and turns.
void SlowStep::add_stuck_stiffness(const CableGeometry<double>& at, Index j, const VectorXd& q,
                                   bool by_tension) noexcept {
  const Cable& cable = model_.cables()[static_cast<std::size_t>(j)];
  const double* b = at.column();
  const int first = at.first(), last = at.last();
  const auto of = [](int section) { return static_cast<std::size_t>(section); };
  bool by_turns = false;
  for (int k = first; k <= last && !model_.has_rods(); ++k) {
    by_turns = by_turns || model_.friction()(k, j) > 0.0;
  }
  // What changes with q: the way slid at constant shares, the tension, each turn.
  const Index way = 0, tension = by_tension ? 1 : -1, first_turn = by_tension ? 2 : 1;
  const Index count = by_turns ? first_turn + last - first + 1 : first_turn;
  for (Index from = 0; from < count; from += Dual::width) {
    const auto number = [from](double value, Index which, double slope = 1.0) {
      Dual x(value);
      if (which >= from && which < from + Dual::width) {
        x.slopes[static_cast<int>(which - from)] = slope;
      }
      return x;
    };
    for (int k = first; k <= last; ++k) {
      const double mu = model_.friction()(k, j);
      const auto own =
          mu > 0.0 ? CapstanFactors<Dual>(number(mu * at.turn(k), first_turn + k - first, mu))
                   : CapstanFactors<Dual>::free();
      turned_[of(k)] = k == first ? own : own.after(turned_[of(k - 1)]);
    }
    FrictionProfile<Dual> profile(number(tension_[j], tension), cable.entry_friction,
                                  model_.sheath_decay()[j], turned_[of(last)]);
    const Dual spring = stick_ * deflection_[j];
    profile.set_friction(limited(spring, profile.most_in(), profile.most_out()));
    Dual slid = number(0.0, way);
    for (int k = first; k <= last; ++k) {
      slid += profile.share(turned_[of(k)]) * at.pulled_in(k, moved_.data());
    }
    profile.set_friction(spring + stick_ * slid);
    for (int k = first; k <= last; ++k) {
      const Dual mean = profile.mean(turned_[of(k)]);
      for (Index c = from; c < std::min<Index>(count, from + Dual::width); ++c) {
        slopes_(c, k) = mean.slopes[static_cast<int>(c - from)];
      }
    }
  }
  FrictionProfile<double> before(tension_[j], cable.entry_friction, model_.sheath_decay()[j],
                                 at.ways()[last]);
  before.set_friction(limited(stick_ * deflection_[j], before.most_in(), before.most_out()));
  for (int k = first; k <= last; ++k) {
    for (int at_k = first; at_k <= last; ++at_k) {
      double on_b = slopes_(way, k) * before.share(at.ways()[at_k]), on_q = 0.0;
      if (by_tension) on_b -= slopes_(tension, k) * cable.stiffness;
      if (by_turns && at.turn(at_k) > 0.0) {
        on_q = slopes_(first_turn + at_k - first, k) / at.turn(at_k);
      }
      for (Index l = model_.first_coordinate(at_k); l < model_.first_coordinate(at_k + 1); ++l) {
        const double slope = on_b * b[l] + on_q * q[l];
        for (Index i = model_.first_coordinate(k); i < model_.first_coordinate(k + 1); ++i) {
          K_(i, l) -= b[i] * slope;
        }
      }
    }
  }
}

double SlowStep::tolerance() const noexcept {
  return smooth * size_.maxCoeff() + sticky * sticking_ + least;
}

/// Goes along the step until what is out of balance along it has become small: where cables stick
/// and slide that is nearly the slope of an energy, which is convex, so this always ends.
void SlowStep::search_along_step() noexcept {
  const double before = r_.dot(step_);
  double low = 0.0, slope_low = before, high = 0.0, slope_high = 0.0, at = 1.0;
  moved_from_ = trial_;
  for (int i = 0;; ++i) {
    trial_ = moved_from_ - at * step_;
    balance(trial_, Wanted::held);
    const double slope = r_.dot(step_);
    if (std::abs(slope) <= kept_slope * std::abs(before) || i == max_searches) return;
    if (slope * before > 0.0) {
      if (high == 0.0) return;  // the next step goes on
      low = at;
      slope_low = slope;
    } else {
      high = at;
      slope_high = slope;
    }
    // The secant, kept off both ends.
    const double secant = slope_low / (slope_low - slope_high);
    at = low + (high - low) * std::fmin(0.9, std::fmax(0.1, secant));
  }
}

/// Whether commands change much as they did in the last step.
bool SlowStep::goes_on() const noexcept {
  double bend = 0.0, most = 0.0;
  for (Index j = 0; j < command_.size(); ++j) {
    const double now = command_[j] - command_at_rest_[j];
    bend = std::fmax(bend, std::abs(now - command_change_[j]));
    most = std::fmax(most, std::abs(now));
  }
  return bend <= smooth_way * most;
}

bool SlowStep::step(const VectorXd& command, const VectorXd* near) noexcept {
  command_ = command;
  trial_ = near == nullptr ? q_ : *near;
  if (near == nullptr && goes_on()) trial_ += change_;
  set_curvature(trial_);
  balance(trial_, near == nullptr ? Wanted::as_before : Wanted::held);
  double out = r_.lpNorm<Eigen::Infinity>();
  int stalled = 0;
  for (int i = 0; i < max_iterations && out > tolerance(); ++i) {
    ++iterations_;
    lu_.compute(K_);
    step_ = lu_.solve(r_);
    const double longest = largest_bending(model_, step_);
    if (!(longest < HUGE_VAL)) return false;
    if (longest > longest_step) step_ *= longest_step / longest;
    if (i > 0 && i % keep_curvature == 0) set_curvature(trial_);
    const bool last = out < nearly * size_.maxCoeff();
    if (last) {
      trial_ -= step_;
      balance(trial_, Wanted::force);
      if (r_.lpNorm<Eigen::Infinity>() > tolerance()) balance(trial_, Wanted::held);
    } else {
      search_along_step();
    }
    const double now = r_.lpNorm<Eigen::Infinity>();
    // Rounding, of cables that stick above all, lets it come no nearer.
    stalled = now < 0.5 * out ? 0 : stalled + 1;
    out = now;
    if (stalled >= 3 && out <= stalled_by * tolerance()) break;
  }
  if (!(out <= stalled_by * tolerance()) || check_shape(model_, trial_) != Status::ok) return false;
  command_change_ = command_ - command_at_rest_;
  command_at_rest_ = command_;
  change_ = trial_ - q_;
  q_ = trial_;
  deflection_ = new_deflection_;
  before_ = sliding_;
  return true;
}

}  // namespace cdcr::detail
