#pragma once

#include <functional>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// Values as a function of time (and, for feedback, of the state): constant, a table or a function.
///
/// A table is smooth between its times and not at them; these break points are where integrators
/// stop and start again. Set up throws std::invalid_argument in the name of `item`; evaluate is
/// real-time safe except for a function that is not.
class Signal {
 public:
  /// Writes the values (size) at time t [s] in state (q, qd).
  using Function = std::function<void(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                                      VectorRef value)>;
  enum class Interpolation { previous, linear };

  [[nodiscard]] static Signal constant(const VectorXd& value);

  /// `times` (N) [s], strictly increasing, and values (N, size). `previous` holds each row until
  /// the next time, `linear` connects them; there a time given twice is a jump. Before the first
  /// and after the last time, the first and the last row hold.
  [[nodiscard]] static Signal table(const char* item, const VectorXd& times, const MatrixXd& values,
                                    Interpolation interpolation);

  /// Any function; it may throw to stop the run. Its own discontinuities are not known here: list
  /// them in `break_points` (strictly increasing) [s].
  [[nodiscard]] static Signal function(const char* item, Function function, Index size,
                                       std::vector<double> break_points);

  /// The same values, time counted from `start` [s]; a function is still given its own time.
  [[nodiscard]] Signal since(double start) const;

  [[nodiscard]] Index size() const noexcept { return size_; }
  [[nodiscard]] bool is_function() const noexcept { return static_cast<bool>(function_); }
  /// Whether it is a function of which no break points are known.
  [[nodiscard]] bool is_unbroken_function() const noexcept {
    return is_function() && times_.empty();
  }
  [[nodiscard]] const std::vector<double>& break_points() const noexcept { return times_; }

  /// Segment that starts at or before t: 0 before the first break point, k after the k-th.
  [[nodiscard]] Index segment(double t) const noexcept;

  /// Whether the values are constant over that segment.
  [[nodiscard]] bool is_constant(Index segment) const noexcept;

  /// Values at t as seen from inside a segment, so that at a break point both sides exist.
  void evaluate(double t, Index segment, const ConstVectorRef& q, const ConstVectorRef& qd,
                VectorRef value) const;

 private:
  Index size_ = 0;
  std::vector<double> times_;  // break points
  std::vector<double> given_;  // the same as given; of a function alone
  double start_ = 0.0;         // from which time counts
  MatrixXd values_;            // (size, max(1, N)), one column a time
  Interpolation interpolation_ = Interpolation::previous;
  Function function_;
};

}  // namespace CDCR_EXPORT cdcr
