#pragma once

#include <memory>
#include <optional>

#include "cdcr/export.hpp"
#include "cdcr/method.hpp"
#include "cdcr/robot_ode.hpp"
#include "cdcr/status.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// rtol of a run that names none. With it the angles of one and of three sections stay within 1e-6
/// rad of the truth over 10 s, unless gravity makes the motion chaotic; bench/tolerances.py has the
/// figure of each method.
[[nodiscard]] constexpr double default_rtol(Method method) noexcept {
  return method == Method::bdf ? 1e-9 : 1e-8;
}

/// How to integrate.
struct Options {
  std::optional<double> rtol;     ///< relative tolerance of one step; by default default_rtol
  std::optional<double> atol;     ///< absolute one [rad], [rad/s]; by default a hundredth of rtol
  double step = 1e-3;             ///< step of rk4 [s]
  double max_step = 0.0;          ///< largest step of adaptive methods [s]; 0: no limit
  std::optional<long> max_steps;  ///< internal steps in one run; by default a million, and a
                                  ///< hundred more for each stretch between break points
};

/// What a run cost.
struct Stats {
  long steps = 0;                ///< internal steps accepted
  long rejected = 0;             ///< steps thrown away by the error test
  long evaluations = 0;          ///< evaluations of the equations of motion
  long jacobians = 0;            ///< evaluations of their Jacobian
  long newton_failures = 0;      ///< Newton iterations that did not converge
  long switches = 0;             ///< of automatic: changes between explicit and implicit steps
  std::optional<Method> method;  ///< of automatic: what made the last steps
  std::optional<double> stiff;  ///< of automatic: since when stability held explicit steps back [s]
};

/// Adds what another run cost; nothing that is not a count.
void add(Stats& to, const Stats& cost) noexcept;

/// Carries a state through time step by step. One object serves one thread.
///
/// The driver (simulate) calls restart at the start and at every break point, step until the stop
/// time is reached, and interpolate for any time inside the step just made; so the steps do not
/// depend on where the run is sampled.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Starts anew from y = (q, qd) at t; steps will end exactly at t_stop > t. Throws
  /// std::invalid_argument for a y of another size or another t_stop.
  virtual Status restart(double t, const VectorXd& y, double t_stop) = 0;
  /// One internal step. On failure the state is the one before the step.
  virtual Status step() = 0;
  /// State at a time within the last step.
  virtual void interpolate(double t, VectorXd& y) = 0;
  /// Whether steps end where the force of a cable bends; those of a fixed step do not.
  [[nodiscard]] virtual bool stops_at_kinks() const noexcept { return true; }
  [[nodiscard]] virtual double time() const noexcept = 0;
  [[nodiscard]] virtual const VectorXd& state() const noexcept = 0;
  [[nodiscard]] virtual Stats stats() const noexcept = 0;
};

/// What else to try in a run by that method; empty where message(status) says it all.
[[nodiscard]] const char* advice(Status status, Method method) noexcept;

/// Makes the integrator for a method; the equation must outlive it.
using IntegratorFactory = std::unique_ptr<Integrator> (*)(RobotOde&, Method, const Options&);

/// All methods but bdf and adams; automatic is dop853 throughout here. Throws
/// std::invalid_argument for those two and for bad options.
[[nodiscard]] std::unique_ptr<Integrator> make_integrator(RobotOde& ode, Method method,
                                                          const Options& options);

/// The tolerances of a step by that method, defaults filled in.
struct Tolerances {
  Tolerances(const Options& options, Method method)
      : rtol(options.rtol.value_or(default_rtol(method))),
        atol(options.atol.value_or(0.01 * rtol)) {}
  double rtol, atol;
};

/// automatic, which makes bdf by that factory when it first pays; stays explicit without one.
[[nodiscard]] std::unique_ptr<Integrator> make_automatic_integrator(RobotOde& ode,
                                                                    const Options& options,
                                                                    IntegratorFactory factory);

/// Throws std::invalid_argument naming the option that is out of range.
void validate(const Options& options);

}  // namespace CDCR_EXPORT cdcr
