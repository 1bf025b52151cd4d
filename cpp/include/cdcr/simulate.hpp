#pragma once

#include <functional>
#include <string>

#include "cdcr/export.hpp"
#include "cdcr/integrator.hpp"

namespace CDCR_EXPORT cdcr {

/// A run, sampled: one row for each output time reached.
struct Trajectory {
  VectorXd t;           ///< (N) [s]
  RowMatrixXd q;        ///< (N, d) [rad]
  RowMatrixXd qd;       ///< (N, d) [rad/s]
  RowMatrixXd tension;  ///< at the base (N, num_cables) [N]; at a jump, the value after it
  RowMatrixXd command;  ///< what was asked of the cables (N, num_cables), [N] or [m]
  std::vector<SlackEvent> slack_events;  ///< located by bdf and adams, in the order of time
  Status status = Status::ok;
  std::string message;  ///< empty when ok; else when it stopped, why, and what to try
  Stats stats;
};

/// Told the time reached every few hundred internal steps; returning false ends the run.
using Progress = std::function<bool(double t)>;

/// Runs the robot from (q0, qd0) at times[0] through strictly increasing output times.
///
/// Break points of the input are hit exactly. A run that fails keeps the samples up to there.
/// Throws std::invalid_argument for arguments out of range, and whatever the input throws.
/// `factory` is make_integrator, or make_cvode_integrator of cdcr/cvode.hpp.
[[nodiscard]] Trajectory simulate(const Model& model, const VectorXd& q0, const VectorXd& qd0,
                                  const VectorXd& times, const CommandInput& input,
                                  Method method = Method::dopri5, const Options& options = {},
                                  IntegratorFactory factory = make_integrator,
                                  const Progress& progress = {}, const WrenchInput& loads = {});

/// The same under a controller, which is reset, then asked at times[0] and each period after.
[[nodiscard]] Trajectory simulate(const Model& model, const VectorXd& q0, const VectorXd& qd0,
                                  const VectorXd& times, Controller& controller,
                                  Method method = Method::dopri5, const Options& options = {},
                                  IntegratorFactory factory = make_integrator,
                                  const Progress& progress = {}, const WrenchInput& loads = {});

}  // namespace CDCR_EXPORT cdcr
