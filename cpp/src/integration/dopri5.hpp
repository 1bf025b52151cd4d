#pragma once

#include "cdcr/integrator.hpp"

namespace cdcr::detail {

/// Dormand-Prince 5(4) with PI step control and dense output of order 4, after Hairer, Norsett,
/// Wanner, "Solving Ordinary Differential Equations I", section II.4 to II.6.
class Dopri5 final : public Integrator {
 public:
  Dopri5(RobotOde& ode, const Options& options);

  Status restart(double t, const VectorXd& y, double t_stop) override;
  Status step() override;
  void interpolate(double t, VectorXd& y) override;
  [[nodiscard]] double time() const noexcept override { return t_; }
  [[nodiscard]] const VectorXd& state() const noexcept override { return y_; }
  [[nodiscard]] Stats stats() const noexcept override { return stats_; }

 private:
  void derivative(double t, const VectorXd& y, VectorXd& dydt);
  void make_stages(double h);
  [[nodiscard]] double error_norm(double h) const;
  [[nodiscard]] double first_step();
  [[nodiscard]] Status failure_status() const;

  RobotOde& ode_;
  Options options_;
  double t_ = 0.0, stop_ = 0.0, h_ = 0.0;   // h_: the next step wanted
  double t_before_ = 0.0, h_before_ = 0.0;  // the last step made
  double last_error_ = 1e-4;                // of the step before, for the PI controller
  bool dense_ready_ = false;
  VectorXd y_, trial_, y_before_;
  VectorXd k1_, k2_, k3_, k4_, k5_, k6_, k7_;  // slopes; k1_ holds f(t_, y_) between steps
  VectorXd k1_before_;
  VectorXd bend_, turn_, fifth_;  // dense output beyond the straight line
  Stats stats_;
};

}  // namespace cdcr::detail
