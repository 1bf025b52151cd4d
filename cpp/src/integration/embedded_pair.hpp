#pragma once

#include <algorithm>
#include <cmath>

#include "cdcr/integrator.hpp"

namespace cdcr::detail {

/// An explicit Runge-Kutta method with an error estimate, PI step control and dense output, after
/// Hairer, Norsett, Wanner, "Solving Ordinary Differential Equations I", section II.4 to II.6.
class EmbeddedPair : public Integrator {
 public:
  Status restart(double t, const VectorXd& y, double t_stop) final;
  Status step() final;
  void interpolate(double t, VectorXd& y) final;
  [[nodiscard]] double time() const noexcept final { return t_; }
  [[nodiscard]] const VectorXd& state() const noexcept final { return y_; }
  [[nodiscard]] Stats stats() const noexcept final { return stats_; }

  [[nodiscard]] double last_step() const noexcept { return h_before_; }  ///< made [s]

 protected:
  /// How steps follow the error.
  struct Control {
    double inverse_order;  // of the error over the step
    double beta;           // of the error before, in the PI controller
    double exponent;       // of this one
    double largest_growth, largest_cut;
    double safety;  // of the step over the one wanted
  };
  EmbeddedPair(RobotOde& ode, Method method, const Options& options, const Control& control);

  /// All slopes of a step from y_ and slope_: trial_ and new_slope_, its own slope.
  virtual void make_stages(double h) = 0;
  /// Size of the error of that step over the tolerances.
  [[nodiscard]] virtual double error_norm(double h) = 0;
  /// What interpolate_in_step needs, once for the step from y_before_ to y_.
  virtual void prepare_interpolation(double h) = 0;
  /// State at a share of that step, 0 to 1.
  virtual void interpolate_in_step(double share, VectorXd& y) const = 0;

  void derivative(double t, const double* y, double* dydt) {
    ode_.derivative(t, y, dydt);
    ++stats_.evaluations;
  }
  /// Of coordinate i of the step.
  [[nodiscard]] double tolerance(Index i) const {
    return tolerances_.atol + tolerances_.rtol * std::max(std::abs(y_[i]), std::abs(trial_[i]));
  }

  double t_ = 0.0, t_before_ = 0.0;
  VectorXd y_, trial_, y_before_;
  VectorXd slope_, new_slope_, slope_before_;

 private:
  [[nodiscard]] double first_step();
  [[nodiscard]] Status failure_status() const;

  RobotOde& ode_;
  Tolerances tolerances_;
  double max_step_;
  Control control_;
  double stop_ = 0.0, h_ = 0.0;  // h_: the next step wanted
  double h_before_ = 0.0;        // the last step made
  // ln of the error of the step before, for the PI controller, at least of one of 1e-4.
  static constexpr double least_log_error = -9.210340371976182;
  double last_log_error_ = least_log_error;
  bool dense_ready_ = false;
  Stats stats_;
};

}  // namespace cdcr::detail
