#pragma once

#include <string>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/status.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// Numbers about the last update of a controller.
struct ControlDiagnostics {
  long long updates = 0;  ///< since the last reset, failed ones counted too
  double duration = 0.0;  ///< of the last one, by the clock [s]
  double error = 0.0;     ///< norm of reference minus measurement, in the unit of the reference
  double missing = 0.0;   ///< norm of the generalised force that limits withheld [N m]
  Index limited = 0;      ///< cables at one of their limits
};

/// Turns the measured state into commands, once each period; they are held until the next.
///
/// It may have been made for another model than the one it drives, to see what it makes of a robot
/// that it does not know exactly; simulate refuses it where the sizes or the drives differ. Set up
/// may allocate and throw; update is real-time safe.
class Controller {
 public:
  virtual ~Controller() = default;

  /// Forgets what has been accumulated, before a new run.
  virtual void reset() noexcept = 0;
  /// After reset, where the cables have these commands (num_cables): rates count from them.
  virtual void hold(const ConstVectorRef& /*command*/) noexcept {}
  /// Commands (num_cables), [N] or [m], for the state (q, qd) measured at time t [s]. Anything but
  /// ok ends the run; wrong_size for vectors of another size.
  [[nodiscard]] virtual Status update(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                                      VectorRef command) noexcept = 0;
  [[nodiscard]] virtual double period() const noexcept = 0;  ///< [s]
  /// Sizes of the robots that it drives; any_size where it takes all.
  [[nodiscard]] virtual Index num_coordinates() const noexcept = 0;
  [[nodiscard]] virtual Index num_cables() const noexcept = 0;
  /// Whether it gives tensions for all cables, so that none may be driven by length.
  [[nodiscard]] virtual bool gives_tensions() const noexcept { return false; }
  /// The robot that it reckons with, whose cables must be driven as those of the robot that it
  /// drives; null where it reckons with none.
  [[nodiscard]] virtual const Model* reckons_with() const noexcept { return nullptr; }
  /// Real-time safe.
  [[nodiscard]] virtual ControlDiagnostics diagnostics() const noexcept { return {}; }

  /// What it followed at the last update, for logs: names, such as those of coordinates or tip_x,
  /// and values, which are real-time safe; none where that is nobody's business.
  [[nodiscard]] virtual std::vector<std::string> reference_names() const { return {}; }
  virtual void write_reference(VectorRef /*values*/) const noexcept {}

  static constexpr Index any_size = -1;
};

/// Throws std::invalid_argument where a controller does not fit a robot: its sizes, its period, the
/// drives of its cables.
void require_fit(const Controller& controller, const Model& model);

}  // namespace CDCR_EXPORT cdcr
