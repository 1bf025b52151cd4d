#pragma once

#include "cdcr/integrator.hpp"
#include "dynamics/bending.hpp"

namespace cdcr::detail {

/// One classical Runge-Kutta step on fixed storage, shared by Rk4 and Simulator.
struct Rk4Stages {
  explicit Rk4Stages(Index size) : k1(size), k2(size), k3(size), k4(size), trial(size) {}

  /// Writes y(t + h) to `next`, given k1 = f(t, y). f is called as f(t, y*, dydt*).
  template <class F>
  void step(F&& f, double t, double h, const VectorXd& y, VectorXd& next) {
    trial = y + 0.5 * h * k1;
    f(t + 0.5 * h, trial.data(), k2.data());
    trial = y + 0.5 * h * k2;
    f(t + 0.5 * h, trial.data(), k3.data());
    trial = y + h * k3;
    f(t + h, trial.data(), k4.data());
    next = y + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
  }

  /// Why a step failed: bent beyond the limit at a stage, the state ends up not a number. Makes
  /// the failed step again, so that the good ones need not look.
  template <class Check, class F>
  Status failure_status(Status status, Check&& check, F&& f, double t, double h, const VectorXd& y,
                        VectorXd& next) {
    if (status != Status::non_finite_state) return status;
    const auto looking = [&](double at, const double* stage, double* dydt) {
      if (is_shape_limit(check(stage))) status = check(stage);
      f(at, stage, dydt);
    };
    step(looking, t, h, y, next);
    return status;
  }

  VectorXd k1, k2, k3, k4, trial;
};

/// Fixed step; the last step before a stop time is shortened to hit it. Between steps, the cubic
/// through states and slopes, which is of the same order.
class Rk4 final : public Integrator {
 public:
  Rk4(RobotOde& ode, const Options& options);

  Status restart(double t, const VectorXd& y, double t_stop) override;
  Status step() override;
  void interpolate(double t, VectorXd& y) override;
  [[nodiscard]] bool stops_at_kinks() const noexcept override { return false; }
  [[nodiscard]] double time() const noexcept override { return t_; }
  [[nodiscard]] const VectorXd& state() const noexcept override { return y_; }
  [[nodiscard]] Stats stats() const noexcept override { return stats_; }

 private:
  RobotOde& ode_;
  double step_size_;
  double start_ = 0.0, stop_ = 0.0, t_ = 0.0, t_before_ = 0.0;
  long count_ = 0, last_ = 0;  // steps made and steps to make since restart
  Rk4Stages stages_;
  VectorXd y_, y_before_, slope_before_;
  Stats stats_;
};

}  // namespace cdcr::detail
