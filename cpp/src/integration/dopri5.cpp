#include "integration/dopri5.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cdcr::detail {
namespace {

// Controller constants of the reference code: safety, smallest and largest change of the step,
// and the PI exponents.
constexpr double safety = 0.9;
constexpr double largest_growth = 10.0;
constexpr double largest_cut = 0.2;
constexpr double beta = 0.04;
constexpr double exponent = 0.2 - 0.75 * beta;

double weighted_norm(const VectorXd& v, const VectorXd& y, double rtol, double atol) {
  double sum = 0.0;
  for (Index i = 0; i < v.size(); ++i) {
    const double scaled = v[i] / (atol + rtol * std::abs(y[i]));
    sum += scaled * scaled;
  }
  return std::sqrt(sum / static_cast<double>(v.size()));
}

}  // namespace

Dopri5::Dopri5(RobotOde& ode, const Options& options) : ode_(ode), options_(options) {
  for (VectorXd* v : {&y_, &trial_, &y_before_, &k1_, &k2_, &k3_, &k4_, &k5_, &k6_, &k7_,
                      &k1_before_, &bend_, &turn_, &fifth_}) {
    v->setZero(ode.num_states());
  }
}

void Dopri5::derivative(double t, const VectorXd& y, VectorXd& dydt) {
  ode_.derivative(t, y.data(), dydt.data());
  ++stats_.evaluations;
}

Status Dopri5::restart(double t, const VectorXd& y, double t_stop) {
  ode_.require_stretch(t, y, t_stop);
  t_ = t_before_ = t;
  stop_ = t_stop;
  y_ = y_before_ = y;
  h_before_ = 0.0;
  last_error_ = 1e-4;
  const Status status = ode_.check(y_.data());
  if (status != Status::ok) return status;
  derivative(t_, y_, k1_);
  if (!k1_.allFinite()) return Status::non_finite_state;
  h_ = first_step();
  return Status::ok;
}

/// Starting step: one that makes an explicit Euler step small, refined by the second derivative.
/// Depends on the problem and the tolerances alone.
double Dopri5::first_step() {
  const double rtol = options_.rtol, atol = options_.atol;
  const double d0 = weighted_norm(y_, y_, rtol, atol), d1 = weighted_norm(k1_, y_, rtol, atol);
  const double h0 = d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1;
  trial_ = y_ + h0 * k1_;
  derivative(t_ + h0, trial_, k2_);
  trial_ = k2_ - k1_;
  const double d2 = weighted_norm(trial_, y_, rtol, atol) / h0;
  const double largest = std::max(d1, d2);
  double h1 = largest <= 1e-15 ? std::max(1e-6, 1e-3 * h0) : std::pow(0.01 / largest, 0.2);
  h1 = std::isfinite(h1) ? std::min(100.0 * h0, h1) : h0;
  return options_.max_step > 0.0 ? std::min(h1, options_.max_step) : h1;
}

void Dopri5::make_stages(double h) {
  const Index n = y_.size();
  for (Index i = 0; i < n; ++i) trial_[i] = y_[i] + h * (1.0 / 5.0) * k1_[i];
  derivative(t_ + h / 5.0, trial_, k2_);
  for (Index i = 0; i < n; ++i) {
    trial_[i] = y_[i] + h * (3.0 / 40.0 * k1_[i] + 9.0 / 40.0 * k2_[i]);
  }
  derivative(t_ + 0.3 * h, trial_, k3_);
  for (Index i = 0; i < n; ++i) {
    trial_[i] = y_[i] + h * (44.0 / 45.0 * k1_[i] - 56.0 / 15.0 * k2_[i] + 32.0 / 9.0 * k3_[i]);
  }
  derivative(t_ + 0.8 * h, trial_, k4_);
  for (Index i = 0; i < n; ++i) {
    trial_[i] = y_[i] + h * (19372.0 / 6561.0 * k1_[i] - 25360.0 / 2187.0 * k2_[i] +
                             64448.0 / 6561.0 * k3_[i] - 212.0 / 729.0 * k4_[i]);
  }
  derivative(t_ + 8.0 / 9.0 * h, trial_, k5_);
  for (Index i = 0; i < n; ++i) {
    trial_[i] =
        y_[i] + h * (9017.0 / 3168.0 * k1_[i] - 355.0 / 33.0 * k2_[i] + 46732.0 / 5247.0 * k3_[i] +
                     49.0 / 176.0 * k4_[i] - 5103.0 / 18656.0 * k5_[i]);
  }
  derivative(t_ + h, trial_, k6_);
  for (Index i = 0; i < n; ++i) {
    trial_[i] =
        y_[i] + h * (35.0 / 384.0 * k1_[i] + 500.0 / 1113.0 * k3_[i] + 125.0 / 192.0 * k4_[i] -
                     2187.0 / 6784.0 * k5_[i] + 11.0 / 84.0 * k6_[i]);
  }
  derivative(t_ + h, trial_, k7_);
}

double Dopri5::error_norm(double h) const {
  double sum = 0.0;
  for (Index i = 0; i < y_.size(); ++i) {
    const double error =
        h * (71.0 / 57600.0 * k1_[i] - 71.0 / 16695.0 * k3_[i] + 71.0 / 1920.0 * k4_[i] -
             17253.0 / 339200.0 * k5_[i] + 22.0 / 525.0 * k6_[i] - 1.0 / 40.0 * k7_[i]);
    const double scale =
        options_.atol + options_.rtol * std::max(std::abs(y_[i]), std::abs(trial_[i]));
    sum += (error / scale) * (error / scale);
  }
  return std::sqrt(sum / static_cast<double>(y_.size()));
}

Status Dopri5::failure_status() const {
  if (trial_.allFinite() && k7_.allFinite()) return Status::step_too_small;
  const VectorXd beyond = 1.001 * y_;
  return ode_.check(beyond.data()) == Status::bending_limit ? Status::bending_limit
                                                            : Status::non_finite_state;
}

Status Dopri5::step() {
  const double smallest =
      4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t_), std::abs(stop_));
  for (bool rejected = false;; rejected = true) {
    double h = options_.max_step > 0.0 ? std::min(h_, options_.max_step) : h_;
    const double left = stop_ - t_;
    const bool last = 1.01 * h >= left;  // rather a slightly longer step than a tiny one after it
    if (last) h = left;
    if (!last && h < smallest) return failure_status();

    make_stages(h);
    const double error = error_norm(h);
    if (!(error <= 1.0)) {  // also for NaN
      ++stats_.rejected;
      h_ = h * (std::isfinite(error) ? std::max(largest_cut, safety * std::pow(error, -0.2))
                                     : largest_cut);
      if (h_ < smallest) return failure_status();
      continue;
    }
    const Status status = ode_.check(trial_.data());
    if (status != Status::ok) return status;

    const double wanted =
        safety * std::pow(std::max(error, 1e-16), -exponent) * std::pow(last_error_, beta);
    const double growth = std::clamp(wanted, largest_cut, rejected ? 1.0 : largest_growth);
    last_error_ = std::max(error, 1e-4);
    h_ = h * growth;
    t_before_ = t_;
    h_before_ = h;
    t_ = last ? stop_ : t_ + h;
    y_before_.swap(y_);
    y_.swap(trial_);
    k1_before_.swap(k1_);
    k1_.swap(k7_);
    dense_ready_ = false;
    ++stats_.steps;
    return Status::ok;
  }
}

void Dopri5::interpolate(double t, VectorXd& y) {
  const double h = h_before_;
  if (!dense_ready_) {  // k7 of the step just made lives in k1_ now
    bend_ = h * k1_before_ - (y_ - y_before_);
    turn_ = (y_ - y_before_) - h * k1_ - bend_;
    fifth_ =
        h * (-12715105075.0 / 11282082432.0 * k1_before_ + 87487479700.0 / 32700410799.0 * k3_ -
             10690763975.0 / 1880347072.0 * k4_ + 701980252875.0 / 199316789632.0 * k5_ -
             1453857185.0 / 822651844.0 * k6_ + 69997945.0 / 29380423.0 * k1_);
    dense_ready_ = true;
  }
  const double s = (t - t_before_) / h, r = 1.0 - s;
  y = y_before_ + s * ((y_ - y_before_) + r * (bend_ + s * (turn_ + r * fifth_)));
}

}  // namespace cdcr::detail
