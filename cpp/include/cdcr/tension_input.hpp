#pragma once

#include <functional>
#include <vector>

#include "cdcr/types.hpp"

namespace cdcr {

/// Cable tensions as a function of time (and, for feedback, of the state).
///
/// A table is smooth between its times and not at them; these break points are where integrators
/// stop and start again. Set up throws std::invalid_argument; evaluate is real-time safe except
/// for a function that is not.
class TensionInput {
 public:
  /// Writes the tensions (num_cables) [N] at time t in state (q, qd).
  using Function = std::function<void(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                                      VectorRef tension)>;
  enum class Interpolation { previous, linear };

  /// The same tensions at all times (num_cables) [N], finite and >= 0.
  [[nodiscard]] static TensionInput constant(const VectorXd& tension);

  /// Tensions at given times: `times` (N) [s], strictly increasing; `tensions` (N, num_cables) [N].
  /// `previous` holds each row until the next time, `linear` connects them. Before the first and
  /// after the last time, the first and the last row hold.
  [[nodiscard]] static TensionInput table(const VectorXd& times, const MatrixXd& tensions,
                                          Interpolation interpolation);

  /// Any function; it may throw to stop the run. Its own discontinuities are not known here: list
  /// them in `break_points` (strictly increasing) [s].
  [[nodiscard]] static TensionInput function(Function function, Index num_cables,
                                             std::vector<double> break_points = {});

  [[nodiscard]] Index num_cables() const noexcept { return num_cables_; }
  [[nodiscard]] bool is_function() const noexcept { return static_cast<bool>(function_); }
  [[nodiscard]] const std::vector<double>& break_points() const noexcept { return times_; }

  /// Segment that starts at or before t: 0 before the first break point, k after the k-th.
  [[nodiscard]] Index segment(double t) const noexcept;

  /// Whether the tensions are constant over that segment.
  [[nodiscard]] bool holds(Index segment) const noexcept;

  /// Tensions at t as seen from inside a segment, so that at a break point both sides exist.
  void evaluate(double t, Index segment, const ConstVectorRef& q, const ConstVectorRef& qd,
                VectorRef tension) const;

 private:
  Index num_cables_ = 0;
  std::vector<double> times_;  // break points
  MatrixXd values_;            // (num_cables, max(1, N)), one column a time
  Interpolation interpolation_ = Interpolation::previous;
  Function function_;
};

}  // namespace cdcr
