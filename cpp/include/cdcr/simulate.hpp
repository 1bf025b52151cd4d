#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/integrator.hpp"

namespace CDCR_EXPORT cdcr {

/// Something to look for in a run: where a function of time and state goes through zero. It is
/// looked at several times a step and located on the interpolant of the method, to rounding.
struct Event {
  std::function<double(double t, const ConstVectorRef& q, const ConstVectorRef& qd)> function;
  int direction = 0;  ///< above 0: upwards, below 0: downwards, 0: both
  int terminal = 0;   ///< the run ends where it has happened so often; 0: never
};
using Events = std::vector<Event>;

/// An event that happened.
struct EventRecord {
  double time = 0.0;  ///< [s]
  Index event = 0;    ///< which
  VectorXd q, qd;     ///< state there (d) [rad], [rad/s]
};

/// A length-driven cable turned slack or taut.
struct SlackEvent {
  double time = 0.0;  ///< [s]
  Index cable = 0;
  bool slack = false;  ///< slack from here on, or taut again
};

/// A run, sampled: one row for each output time reached.
struct Trajectory {
  VectorXd t;                 ///< (N) [s]
  RowMatrixXd q;              ///< (N, d) [rad]
  RowMatrixXd qd;             ///< (N, d) [rad/s]
  RowMatrixXd tension;        ///< at the base (N, num_cables) [N]; at a jump, the value after it
  RowMatrixXd command;        ///< what was asked of the cables (N, num_cables), [N] or [m]
  RowMatrixXd deflection;     ///< of cables whose friction remembers (N, num_deflections) [m]
  RowMatrixXd sensitivities;  ///< (N, 2 d k), where asked for (cdcr/sensitivities.hpp)
  std::vector<SlackEvent> slack_events;  ///< in the order of time
  std::vector<EventRecord> events;       ///< in the order of time
  Status status = Status::ok;
  std::string message;  ///< empty when ok; else when it stopped, why, and what to try
  Stats stats;
};

/// Told the time reached every few hundred internal steps; returning false ends the run.
using Progress = std::function<bool(double t)>;

/// Runs the robot from (q0, qd0) at times[0] through strictly increasing output times.
///
/// Time counts from times[0] inside, so that a run does not depend on its zero. Break points of the
/// input are hit exactly; under a function of time without break points no step is longer than a
/// thousandth of the run, or than the mean distance of the output times, unless `max_step` says so.
/// Where a length-driven cable turns slack or taut the method starts anew, as at a break point. A
/// run that fails keeps the samples up to there. Throws std::invalid_argument for arguments out of
/// range, and whatever the input throws. `factory` is make_integrator, or make_cvode_integrator of
/// cdcr/cvode.hpp.
[[nodiscard]] Trajectory simulate(const Model& model, const VectorXd& q0, const VectorXd& qd0,
                                  const VectorXd& times, const CommandInput& input,
                                  Method method = Method::automatic, const Options& options = {},
                                  IntegratorFactory factory = make_integrator,
                                  const Progress& progress = {}, const WrenchInput& loads = {},
                                  const Events& events = {});

/// The same under a controller, which is reset, then asked at times[0] and each period after.
[[nodiscard]] Trajectory simulate(const Model& model, const VectorXd& q0, const VectorXd& qd0,
                                  const VectorXd& times, Controller& controller,
                                  Method method = Method::automatic, const Options& options = {},
                                  IntegratorFactory factory = make_integrator,
                                  const Progress& progress = {}, const WrenchInput& loads = {},
                                  const Events& events = {});

}  // namespace CDCR_EXPORT cdcr
