#pragma once

#include "dynamics/bending.hpp"
#include "integration/fixed_step.hpp"

namespace cdcr::detail {

/// One classical Runge-Kutta step on fixed storage, shared by Rk4 and Simulator.
struct Rk4Stages {
  explicit Rk4Stages(Index size) : k2(size), k3(size), k4(size), trial(size) {}

  /// Writes y(t + h) to `next`, given k1 = f(t, y). f is called as f(t, y*, dydt*).
  template <class F>
  void step(F&& f, double t, double h, const VectorXd& y, const VectorXd& k1, VectorXd& next) {
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
                        const VectorXd& k1, VectorXd& next) {
    if (status != Status::non_finite_state) return status;
    const auto looking = [&](double at, const double* stage, double* dydt) {
      if (is_shape_limit(check(stage))) status = check(stage);
      f(at, stage, dydt);
    };
    step(looking, t, h, y, k1, next);
    return status;
  }

  VectorXd k2, k3, k4, trial;
};

/// Classical Runge-Kutta. Between steps it is of the same order.
class Rk4 final : public FixedStep {
 public:
  Rk4(RobotOde& ode, const Options& options) : FixedStep(ode, options), stages_(ode.num_states()) {}

 private:
  Status make_step(double t, double h, const VectorXd& y, const VectorXd& slope,
                   VectorXd& next) override;

  Rk4Stages stages_;
};

}  // namespace cdcr::detail
