#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "cdcr/cvode.hpp"
#include "residual.hpp"
#include "runs.hpp"

// Runs with bdf and adams.

namespace cdcr::test {

namespace tolerance {
/// Error of q [rad] at rtol 1e-12 over a few seconds: those of thousands of steps add up.
constexpr double cvode_tight = 1e-9;
/// The same across a jump that is no break point, which some step has to straddle.
constexpr double cvode_jump = 3e-8;
/// Error of q [rad] at the default tolerances in step-tension over 10 s: ten times what is seen.
constexpr double cvode_default = 2.5e-6;
}  // namespace tolerance

inline const std::vector<Method> cvode_methods = {Method::bdf, Method::adams};
inline const Options tight = tolerances(1e-12, 1e-14);

inline std::string label(Method method) {
  return method == Method::bdf ? "bdf" : "adams";
}

/// Table 1 with weight, payload and damping.
inline Robot heavy_robot() {
  Robot robot = amouri2020();
  robot.gravity = {2.0, -1.0, -9.0};
  robot.payload = 0.01;
  robot.sections[0].damping = 2e-3;
  return robot;
}

inline VectorXd state(double q_x, double q_y, double qd_x = 0.0, double qd_y = 0.0) {
  return Eigen::Vector4d(q_x, q_y, qd_x, qd_y);
}

inline CommandInput pull(double first, double second = 0.0) {
  return CommandInput::constant(Eigen::Vector3d(first, second, 0.0));
}

/// Tension of cable 1 as a function of time and q_x; the others are slack.
template <typename Function>
CommandInput pull_by(Function function) {
  return CommandInput::function(
      [function](double t, const ConstVectorRef& q, const ConstVectorRef&, VectorRef tension) {
        tension.setZero();
        tension[0] = function(t, q[0]);
      },
      3);
}

inline Trajectory run(const Model& model, const CommandInput& input, const VectorXd& y,
                      const VectorXd& times, Method method, const Options& options = {}) {
  return simulate(model, y.head(2), y.tail(2), times, input, method, options,
                  make_cvode_integrator);
}

inline Trajectory reference(const Model& model, const CommandInput& input, const VectorXd& y,
                            const VectorXd& times) {
  return run(model, input, y, times, Method::dopri5, tightest());
}

/// Steps up to the stop time of the last restart, or to a failure.
inline Status run(Integrator& integrator, double t_stop) {
  Status status = Status::ok;
  while (status == Status::ok && integrator.time() < t_stop) status = integrator.step();
  return status;
}

/// Largest distance of q [rad] between two runs that went well.
inline Residual distance(const Trajectory& a, const Trajectory& b) {
  REQUIRE(a.status == Status::ok);
  REQUIRE(b.status == Status::ok);
  REQUIRE(a.t == b.t);
  return {(a.q - b.q).rowwise().norm().maxCoeff()};
}

}  // namespace cdcr::test
