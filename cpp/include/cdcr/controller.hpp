#pragma once

#include "cdcr/export.hpp"
#include "cdcr/status.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// Turns the measured state into tensions, once each period; they are held until the next.
///
/// Set up may allocate and throw; update is real-time safe.
class Controller {
 public:
  virtual ~Controller() = default;

  /// Forgets what has been accumulated, before a new run.
  virtual void reset() noexcept = 0;
  /// Tensions (num_cables) [N] for the state (q, qd) measured at time t [s].
  [[nodiscard]] virtual Status update(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                                      VectorRef tension) noexcept = 0;
  [[nodiscard]] virtual double period() const noexcept = 0;  ///< [s]
  [[nodiscard]] virtual Index num_cables() const noexcept = 0;
};

}  // namespace CDCR_EXPORT cdcr
