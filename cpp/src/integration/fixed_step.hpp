#pragma once

#include "cdcr/integrator.hpp"

namespace cdcr::detail {

/// Steps of one size; the last before a stop time is shortened to hit it. Between steps, the cubic
/// through states and slopes.
class FixedStep : public Integrator {
 public:
  Status restart(double t, const VectorXd& y, double t_stop) final;
  Status step() final;
  void interpolate(double t, VectorXd& y) final;
  [[nodiscard]] bool stops_at_kinks() const noexcept final { return false; }
  [[nodiscard]] double time() const noexcept final { return t_; }
  [[nodiscard]] const VectorXd& state() const noexcept final { return y_; }
  [[nodiscard]] Stats stats() const noexcept final { return stats_; }

 protected:
  FixedStep(RobotOde& ode, const Options& options);

  /// Writes y(t + h) to `next`, given slope = f(t, y); why it failed, if it did.
  virtual Status make_step(double t, double h, const VectorXd& y, const VectorXd& slope,
                           VectorXd& next) = 0;
  void derivative(double t, const double* y, double* dydt);

  RobotOde& ode_;
  Stats stats_;

 private:
  double step_size_;
  double start_ = 0.0, stop_ = 0.0, t_ = 0.0, t_before_ = 0.0;
  long count_ = 0, last_ = 0;  // steps made and steps to make since restart
  VectorXd y_, y_before_, slope_, slope_before_;
};

}  // namespace cdcr::detail
