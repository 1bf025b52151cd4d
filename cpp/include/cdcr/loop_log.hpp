#pragma once

#include <chrono>

#include "cdcr/export.hpp"
#include "cdcr/log.hpp"
#include "cdcr/loop.hpp"

namespace CDCR_EXPORT cdcr {

/// What a loop does, a row each step, with the names that files of runs have: time and state where
/// the step begins, and what holds over it; the tip; what sensors tell and what the controller is
/// told; the reference, where the controller tells it; what the estimator tells; how the step
/// ended, 0 for Status::ok; how long the controller's update and the whole step took.
///
/// Made for a loop and handed to it by Loop::set_log.
class LoopLog final : public Log {
 public:
  explicit LoopLog(const Loop& loop, Index capacity = 8192);

 private:
  friend class Loop;
  /// Throws std::invalid_argument for a loop of other columns.
  void require_fit(const Loop& loop) const;
  /// Before and after a step. Real-time safe.
  void begin(const Loop& loop) noexcept;
  void end(const Loop& loop) noexcept;

  VectorXd row_, tension_, reference_, values_, deviations_;
  bool has_lengths_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace CDCR_EXPORT cdcr
