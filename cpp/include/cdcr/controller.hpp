#pragma once

#include "cdcr/export.hpp"
#include "cdcr/status.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

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

  static constexpr Index any_size = -1;
};

}  // namespace CDCR_EXPORT cdcr
