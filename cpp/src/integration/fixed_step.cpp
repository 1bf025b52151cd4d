#include "integration/fixed_step.hpp"

#include <algorithm>
#include <cmath>

namespace cdcr::detail {

FixedStep::FixedStep(RobotOde& ode, const Options& options)
    : ode_(ode),
      step_size_(options.step),
      y_(VectorXd::Zero(ode.num_states())),
      y_before_(y_),
      slope_(y_),
      slope_before_(y_) {}

void FixedStep::derivative(double t, const double* y, double* dydt) {
  ode_.derivative(t, y, dydt);
  ++stats_.evaluations;
}

Status FixedStep::restart(double t, const VectorXd& y, double t_stop) {
  ode_.require_stretch(t, y, t_stop);
  start_ = t_ = t_before_ = t;
  stop_ = t_stop;
  count_ = 0;
  // A remainder below one part in 1e9 of a step is rounding error of the caller's times.
  const double steps = std::ceil((t_stop - t) / step_size_ - 1e-9);
  last_ = static_cast<long>(std::clamp(steps, 1.0, 9e18));
  y_ = y_before_ = y;
  derivative(t_, y_.data(), slope_.data());
  return ode_.check(y_.data());
}

Status FixedStep::step() {
  const double t_next =
      count_ + 1 >= last_ ? stop_ : start_ + static_cast<double>(count_ + 1) * step_size_;
  y_before_.swap(y_);
  const Status status = make_step(t_, t_next - t_, y_before_, slope_, y_);
  if (status != Status::ok) {
    y_.swap(y_before_);
    return status;
  }
  t_before_ = t_;
  t_ = t_next;
  slope_before_.swap(slope_);
  derivative(t_, y_.data(), slope_.data());
  ++count_;
  ++stats_.steps;
  return Status::ok;
}

void FixedStep::interpolate(double t, VectorXd& y) {
  const double h = t_ - t_before_;
  const double s = (t - t_before_) / h, r = 1.0 - s;
  y = r * r * (1.0 + 2.0 * s) * y_before_ + s * s * (1.0 + 2.0 * r) * y_ +
      h * s * r * (r * slope_before_ - s * slope_);
}

}  // namespace cdcr::detail
