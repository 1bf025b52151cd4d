// Orders of convergence, fitted: what a coefficient mistyped by one digit would spoil.
#include <doctest/doctest.h>

#include <functional>
#include <vector>

#include "cdcr/simulate.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"

namespace cdcr::test {
namespace {

const Eigen::Vector2d q_start(0.6, -0.3), qd_start(1.0, 4.0);
constexpr double end = 1.0;

Model damped_upright() {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  robot.sections[0].damping = 1e-3;
  return Model(robot);
}

/// One period of a pulse that jumps at times that are no multiple of any step.
CommandInput pulse() {
  Eigen::MatrixXd rows = MatrixXd::Zero(3, 3);
  rows(1, 0) = 5.0;
  return CommandInput::table(Eigen::Vector3d(0.0, 0.123456789, 0.6180339), rows,
                             CommandInput::Interpolation::previous);
}

CommandInput ramp() {
  Eigen::MatrixXd rows = MatrixXd::Zero(3, 3);
  rows(1, 1) = 5.0;
  return CommandInput::table(Eigen::Vector3d(0.1, 0.123456789, 0.6180339), rows,
                             CommandInput::Interpolation::linear);
}

/// Largest error of q over the output times against the tightest Dormand-Prince.
double error_of(const Model& model, const CommandInput& input, const VectorXd& times, Method method,
                const Options& options) {
  const Trajectory run = simulate(model, q_start, qd_start, times, input, method, options);
  const Trajectory best =
      simulate(model, q_start, qd_start, times, input, Method::dopri5, tightest());
  REQUIRE(run.status == Status::ok);
  REQUIRE(best.status == Status::ok);
  return largest(run.q - best.q);
}

/// Fitted order over steps that halve, from `coarsest` on.
double order(double coarsest, int count, const std::function<double(double step)>& error) {
  std::vector<double> steps, errors;
  for (int i = 0; i < count; ++i) {
    steps.push_back(coarsest);
    errors.push_back(error(coarsest));
    coarsest *= 0.5;
  }
  return fitted_order(steps, errors);
}

/// Dormand-Prince held to a fixed step: tolerances that never bind, and a largest step.
Options held_to(double step) {
  Options options = tolerances(0.5, 1e6);
  options.max_step = step;
  return options;
}

TEST_SUITE_BEGIN("convergence");

TEST_CASE("Runge-Kutta is of order 4") {
  const Model model = damped_upright();
  const VectorXd at_end = even_times(0.0, end, 2);
  const double fitted = order(0.02, 5, [&](double step) {
    return error_of(model, no_tension(model), at_end, Method::rk4, fixed_step(step));
  });
  MESSAGE("fitted order of rk4: ", fitted);
  CHECK(fitted > 3.9);
  CHECK(fitted < 4.2);
}

TEST_CASE("Runge-Kutta keeps order 4 across the jumps and kinks of a table") {
  const Model model = damped_upright();
  for (const CommandInput& input : {pulse(), ramp()}) {
    const double fitted = order(0.02, 5, [&](double step) {
      return error_of(model, input, even_times(0.0, end, 2), Method::rk4, fixed_step(step));
    });
    CHECK(fitted > 3.8);
    CHECK(fitted < 4.2);
  }
}

TEST_CASE("Runge-Kutta between its steps is of order 4 too") {
  const Model model = damped_upright();
  const double fitted = order(0.02, 4, [&](double step) {
    return error_of(model, no_tension(model), even_times(0.0, end, 1234), Method::rk4,
                    fixed_step(step));
  });
  CHECK(fitted > 3.8);
  CHECK(fitted < 4.3);
}

TEST_CASE("Rosenbrock's method is of order 2, at its steps and between them") {
  const Model model = damped_upright();
  for (const CommandInput& input : {no_tension(model), pulse(), ramp()}) {
    for (const int samples : {2, 1234}) {
      const double fitted = order(0.005, 4, [&](double step) {
        return error_of(model, input, even_times(0.0, end, samples), Method::rosenbrock,
                        fixed_step(step));
      });
      MESSAGE("fitted order of rosenbrock: ", fitted, ", samples: ", samples);
      CHECK(fitted > 1.9);
      CHECK(fitted < 2.2);
    }
  }
}

TEST_CASE("Dormand-Prince is of order 5") {
  const Model model = damped_upright();
  const double fitted = order(0.025, 5, [&](double step) {
    return error_of(model, no_tension(model), even_times(0.0, end, 2), Method::dopri5,
                    held_to(step));
  });
  MESSAGE("fitted order of dopri5: ", fitted);
  CHECK(fitted > 4.8);
  CHECK(fitted < 5.4);
}

TEST_CASE("Dormand-Prince between its steps is of order 4 at least") {
  const Model model = damped_upright();
  const double fitted = order(0.025, 5, [&](double step) {
    return error_of(model, no_tension(model), even_times(0.0, end, 1234), Method::dopri5,
                    held_to(step));
  });
  MESSAGE("fitted order of the dense output of dopri5: ", fitted);
  CHECK(fitted > 4.0);
}

TEST_CASE("Dormand-Prince of order 8, at its steps and between them") {
  const Model model = damped_upright();
  for (const int samples : {2, 1234}) {
    const double fitted = order(0.1, 3, [&](double step) {
      return error_of(model, no_tension(model), even_times(0.0, end, samples), Method::dop853,
                      held_to(step));
    });
    MESSAGE("fitted order of dop853: ", fitted, ", samples: ", samples);
    CHECK(fitted > 7.5);
    CHECK(fitted < 8.6);
  }
}

TEST_CASE("the error of Dormand-Prince follows its tolerance") {
  const Model model = damped_upright();
  for (const Method method : {Method::dopri5, Method::dop853}) {
    for (const CommandInput& input : {no_tension(model), pulse(), ramp()}) {
      std::vector<double> tolerance, error;
      for (const double rtol : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11}) {
        tolerance.push_back(rtol);
        error.push_back(
            error_of(model, input, even_times(0.0, end, 101), method, tolerances(rtol, rtol)));
        CHECK(error.back() < 50.0 * rtol);
      }
      const double slope = fitted_order(tolerance, error);
      CHECK(slope > 0.85);
      CHECK(slope < 1.15);
    }
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
