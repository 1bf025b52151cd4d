#pragma once

#include "dynamics/bending.hpp"
#include "integration/fixed_step.hpp"
#include "integration/small_lu.hpp"

namespace cdcr::detail {

/// One step of ROS2 on fixed storage, shared by Rosenbrock and Simulator: two stages, of order 2
/// whatever matrix stands for the Jacobian, L-stable with the exact one (J. G. Verwer, E. J. Spee,
/// J. G. Blom, W. Hundsdorfer, "A second-order Rosenbrock method applied to photochemical
/// dispersion problems", SIAM J. Sci. Comput. 20, 1999). cpp/README.md has its formulas.
struct RosenbrockStages {
  /// Of states that begin with the coordinates and their rates.
  RosenbrockStages(Index num_states, Index num_coordinates);

  /// Writes y(t + h) to `next`, given slope = f(t, y) and `jacobian` = df/dy there. f is called as
  /// f(t, y*, dydt*).
  template <class F>
  void step(F&& f, double t, double h, const VectorXd& y, const VectorXd& slope, VectorXd& next) {
    factorise(h);
    k1 = slope;
    solve(k1);
    trial = y + h * k1;
    f(t + h, trial.data(), k2.data());
    k2 -= 2.0 * k1;
    solve(k2);
    next = y + 1.5 * h * k1 + 0.5 * h * k2;
  }

  /// How that step ended: bent beyond the limit at its stage, the state ends up not a number.
  template <class Check>
  [[nodiscard]] Status status_after(Check&& check, const VectorXd& next) const {
    const Status status = check(next.data());
    if (status != Status::non_finite_state) return status;
    const Status of_stage = check(trial.data());
    return is_shape_limit(of_stage) ? of_stage : status;
  }

  MatrixXd jacobian;
  VectorXd k1, k2, trial;

 private:
  void factorise(double h) noexcept;
  void solve(VectorXd& k) noexcept;

  SmallLu lu_;
  Index num_coordinates_;
  double shift_ = 0.0;
};

/// Linearly implicit steps: strong damping and many parts do not make them small. Between steps it
/// is of order 2 too.
class Rosenbrock final : public FixedStep {
 public:
  Rosenbrock(RobotOde& ode, const Options& options)
      : FixedStep(ode, options), stages_(ode.num_states(), ode.model().num_coordinates()) {}

 private:
  Status make_step(double t, double h, const VectorXd& y, const VectorXd& slope,
                   VectorXd& next) override;

  RosenbrockStages stages_;
};

}  // namespace cdcr::detail
