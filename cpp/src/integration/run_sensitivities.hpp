#pragma once

#include <Eigen/LU>

#include "cdcr/sensitivities.hpp"
#include "integration/collocation.hpp"

namespace cdcr::detail {

/// Derivatives of the states of a run, carried along with it: S = d(q, qd)/dp of the variational
/// equation, cpp/sensitivities.md eq. (120), which is linear, so that each step of the run costs it
/// one solution of linear equations.
class RunSensitivities {
 public:
  /// Time counts from `start`, as in the run, whose options these are.
  RunSensitivities(RobotOde& ode, const Sensitivities& asked, double start, Method method,
                   const Options& options);

  [[nodiscard]] Index columns() const noexcept { return columns_; }
  /// S at the time reached (2d, columns).
  [[nodiscard]] const MatrixXd& here() const noexcept { return here_; }
  /// S at a time within the integrator's last step, not before the time reached.
  const MatrixXd& at(Integrator& integrator, double t);
  /// Goes on to that time.
  void advance(Integrator& integrator, double t);
  /// Goes on to where the force of a cable bends, which it is not asked beyond.
  void advance_to_kink(Integrator& integrator, double t);

 private:
  void set_start(const Sensitivities& asked);
  /// Derivatives of the accelerations at a time within the last step.
  void differentiate(Integrator& integrator, double t, Index segment);
  void solve(Integrator& integrator, double t);
  double step(Integrator& integrator, double t, double h);

  RobotOde& ode_;
  const Sensitivities& asked_;
  Index d_, columns_, first_command_, first_parameter_;
  Collocation method_;
  std::optional<Signal> command_slopes_;
  Data data_;
  ParameterData room_;
  double largest_error_;  // of a step, by its estimate
  double time_ = 0.0, there_time_ = 0.0;
  double inside_ = 0.0;  // share of a step by which its end is seen from inside
  MatrixXd here_, there_;
  // At one stage.
  VectorXd y_, command_slope_;
  MatrixXd on_q_, on_qd_, on_command_, on_wrenches_, on_parameters_;
  // Of all stages: rows of one after those of another.
  MatrixXd equations_, slopes_, moved_, errors_;
  Eigen::PartialPivLU<MatrixXd> factors_;
};

}  // namespace cdcr::detail
