#include "cdcr/integrator.hpp"

#include <cmath>

#include "base/arguments.hpp"
#include "integration/automatic.hpp"
#include "integration/dop853.hpp"
#include "integration/dopri5.hpp"
#include "integration/rk4.hpp"
#include "integration/rosenbrock.hpp"

namespace cdcr {
namespace {

void require(bool sound, const char* item, double value, const char* allowed) {
  detail::require(sound, item, " must be ", allowed, ", got ", value);
}

}  // namespace

void validate(const Options& o) {
  // Below 1e-14 the error test measures rounding, and a run would never end.
  const double rtol = o.rtol.value_or(default_rtol(Method::bdf)), atol = o.atol.value_or(rtol);
  require(rtol >= 1e-14 && rtol < 1.0, "rtol", rtol, "at least 1e-14 and below 1");
  require(atol > 0.0 && std::isfinite(atol), "atol", atol, "> 0 and finite");
  require(o.step > 0.0 && std::isfinite(o.step), "step", o.step, "> 0 s and finite");
  require(o.max_step >= 0.0 && std::isfinite(o.max_step), "max_step", o.max_step,
          ">= 0 s and finite (0: no limit)");
  const long most = o.max_steps.value_or(1);
  require(most >= 1, "max_steps", static_cast<double>(most), "at least 1");
}

void add(Stats& to, const Stats& cost) noexcept {
  to.steps += cost.steps;
  to.rejected += cost.rejected;
  to.evaluations += cost.evaluations;
  to.jacobians += cost.jacobians;
  to.newton_failures += cost.newton_failures;
  to.switches += cost.switches;
}

const char* advice(Status status, Method method) noexcept {
  const bool fixed = method == Method::rk4 || method == Method::rosenbrock;
  if (status == Status::bending_limit) {
    return fixed ? " Or add damping, or use a smaller step." : " Or add damping.";
  }
  if (status != Status::step_limit) return "";
  if (fixed) return " Or use a larger step.";
  return method == Method::bdf || method == Method::automatic
             ? " Or loosen rtol and atol."
             : " Or loosen rtol and atol, or use method bdf if the robot is stiff.";
}

std::unique_ptr<Integrator> make_automatic_integrator(RobotOde& ode, const Options& options,
                                                      IntegratorFactory factory) {
  validate(options);
  return std::make_unique<detail::Automatic>(ode, options, factory);
}

std::unique_ptr<Integrator> make_integrator(RobotOde& ode, Method method, const Options& options) {
  validate(options);
  switch (method) {
    case Method::rk4:
      return std::make_unique<detail::Rk4>(ode, options);
    case Method::dopri5:
      return std::make_unique<detail::Dopri5>(ode, options);
    case Method::dop853:
      return std::make_unique<detail::Dop853>(ode, options);
    case Method::automatic:
      return make_automatic_integrator(ode, options, nullptr);
    case Method::rosenbrock:
      return std::make_unique<detail::Rosenbrock>(ode, options);
    case Method::bdf:
    case Method::adams:
      break;
  }
  detail::refuse("methods bdf and adams are made by make_cvode_integrator of cdcr/cvode.hpp");
}

}  // namespace cdcr
