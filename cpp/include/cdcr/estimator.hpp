#pragma once

#include <string>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/sensor.hpp"
#include "cdcr/status.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// What a sensor tells, and whether that is new.
struct Measurement {
  VectorXd value;
  bool fresh = false;
};

/// Numbers about the last update of an estimator.
struct EstimatorDiagnostics {
  long long updates = 0;  ///< since the last reset, failed ones counted too
  double duration = 0.0;  ///< of the last one, by the clock [s]
  double innovation =
      0.0;             ///< sum of squares of what was measured unlike expected, over its spread
  Index measured = 0;  ///< values in that sum; 0 where nothing was new
};

/// Makes a state of measurements, each period.
///
/// Set up may allocate and throw; reset and update are real-time safe.
class Estimator {
 public:
  virtual ~Estimator() = default;
  /// Before a run, with the state at its start and what actuators give there (num_cables).
  virtual void reset(const ConstVectorRef& q, const ConstVectorRef& qd,
                     const ConstVectorRef& command) noexcept = 0;
  /// The state (q, qd) at time t [s] from what the sensors tell and the command asked for over the
  /// period before. q and qd come in as the controller would be told them otherwise. Anything but
  /// ok ends the run.
  [[nodiscard]] virtual Status update(double t, const std::vector<Measurement>& told,
                                      const ConstVectorRef& command, VectorRef q,
                                      VectorRef qd) noexcept = 0;
  /// [s]; 0: each step of the loop.
  [[nodiscard]] virtual double period() const noexcept { return 0.0; }
  /// Throws std::invalid_argument where it was made for a robot of other coordinates, cables or
  /// drives: reset and update, which throw nothing, read as many numbers as it has.
  virtual void require_robot(const Model& /*model*/) const {}
  /// The same, and where it cannot hear these sensors of the robot, in their order.
  virtual void require_fit(const Model& model, const std::vector<Sensor>& sensors) const;
  /// What else it estimates: names, values and their standard deviations, 0 where it has none.
  [[nodiscard]] virtual std::vector<std::string> value_names() const { return {}; }
  virtual void write_values(VectorRef /*values*/, VectorRef /*deviations*/) const noexcept {}
  [[nodiscard]] virtual EstimatorDiagnostics diagnostics() const noexcept { return {}; }
  /// What it remembers of a run: an estimator made alike that takes it up goes on as this one
  /// would, but for the count of diagnostics. Not real-time safe.
  [[nodiscard]] virtual VectorXd memory() const { return {}; }
  /// Throws std::invalid_argument where that is not of an estimator made alike.
  virtual void set_memory(const VectorXd& /*memory*/) {}
};

}  // namespace CDCR_EXPORT cdcr
