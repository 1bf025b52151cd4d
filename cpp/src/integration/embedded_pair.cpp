#include "integration/embedded_pair.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/bending.hpp"
#include "integration/step_size.hpp"

namespace cdcr::detail {
EmbeddedPair::EmbeddedPair(RobotOde& ode, Method method, const Options& options,
                           const Control& control)
    : ode_(ode), tolerances_(options, method), max_step_(options.max_step), control_(control) {
  for (VectorXd* v : {&y_, &trial_, &y_before_, &slope_, &new_slope_, &slope_before_}) {
    v->setZero(ode.num_states());
  }
}

Status EmbeddedPair::restart(double t, const VectorXd& y, double t_stop) {
  ode_.require_stretch(t, y, t_stop);
  t_ = t_before_ = t;
  stop_ = t_stop;
  y_ = y_before_ = y;
  h_before_ = 0.0;
  last_log_error_ = least_log_error;
  const Status status = ode_.check(y_.data());
  if (status != Status::ok) return status;
  derivative(t_, y_.data(), slope_.data());
  if (!slope_.allFinite()) return Status::non_finite_state;
  h_ = first_step();
  return Status::ok;
}

/// Starting step: one that makes an explicit Euler step small, refined by the second derivative.
/// Depends on the problem, its stretches and the tolerances alone.
double EmbeddedPair::first_step() {
  const double rtol = tolerances_.rtol, atol = tolerances_.atol;
  const double d0 = weighted_norm(y_, y_, rtol, atol), d1 = weighted_norm(slope_, y_, rtol, atol);
  const double wanted = d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1;  // tiny near straight
  const double h0 = std::min(std::max(wanted, time_resolution(t_, stop_)), stop_ - t_);
  trial_ = y_ + h0 * slope_;
  derivative(t_ + h0, trial_.data(), new_slope_.data());
  trial_ = new_slope_ - slope_;
  const double d2 = weighted_norm(trial_, y_, rtol, atol) / h0;
  const double largest = std::max(d1, d2);
  double h1 = largest <= 1e-15 ? std::max(1e-6, 1e-3 * h0)
                               : std::pow(0.01 / largest, control_.inverse_order);
  h1 = std::isfinite(h1) ? std::min(100.0 * h0, h1) : h0;
  return max_step_ > 0.0 ? std::min(h1, max_step_) : h1;
}

Status EmbeddedPair::failure_status() const {
  if (trial_.allFinite() && new_slope_.allFinite()) return Status::step_too_small;
  const VectorXd beyond = 1.001 * y_;
  const Status status = ode_.check(beyond.data());
  return is_shape_limit(status) ? status : Status::non_finite_state;
}

Status EmbeddedPair::step() {
  const double smallest = time_resolution(t_, stop_);
  for (bool rejected = false;; rejected = true) {
    double h = max_step_ > 0.0 ? std::min(h_, max_step_) : h_;
    const double left = stop_ - t_;
    const bool last = 1.01 * h >= left;  // rather a slightly longer step than a tiny one after it
    if (last) h = left;
    if (!last && h < smallest) return failure_status();

    make_stages(h);
    const double error = error_norm(h);
    if (!(error <= 1.0)) {  // also for NaN
      ++stats_.rejected;
      const double cut = control_.safety * std::pow(error, -control_.inverse_order);
      h_ = h * (std::isfinite(error) ? std::max(control_.largest_cut, cut) : control_.largest_cut);
      if (h_ < smallest) return failure_status();
      continue;
    }
    const Status status = ode_.check(trial_.data());
    if (status != Status::ok) return status;

    const double log_error = std::log(std::max(error, 1e-16));
    const double wanted =
        control_.safety * std::exp(control_.beta * last_log_error_ - control_.exponent * log_error);
    const double growth =
        std::clamp(wanted, control_.largest_cut, rejected ? 1.0 : control_.largest_growth);
    last_log_error_ = std::max(log_error, least_log_error);
    h_ = h * growth;
    t_before_ = t_;
    h_before_ = h;
    t_ = last ? stop_ : t_ + h;
    y_before_.swap(y_);
    y_.swap(trial_);
    slope_before_.swap(slope_);
    slope_.swap(new_slope_);
    dense_ready_ = false;
    ++stats_.steps;
    return Status::ok;
  }
}

void EmbeddedPair::interpolate(double t, VectorXd& y) {
  if (!dense_ready_) prepare_interpolation(h_before_);
  dense_ready_ = true;
  interpolate_in_step((t - t_before_) / h_before_, y);
}

}  // namespace cdcr::detail
