#pragma once

#include <algorithm>
#include <limits>

#include "cdcr/rollout.hpp"

namespace cdcr::detail {

/// The commands of a motion over a step; null where a controller gives them.
[[nodiscard]] inline const double* command_of(const Motions& motions, Index motion,
                                              Index step) noexcept {
  const RolloutCommands& given = motions.commands;
  if (given.data == nullptr) return nullptr;
  return given.data + motion * given.between_motions + step * given.between_steps;
}

/// Writes rows where a rollout wants them.
class RowWriter {
 public:
  RowWriter(const RolloutRows& to, Index num_rows, Index num_coordinates, Index num_cables)
      : to_(to), num_rows_(num_rows), d_(num_coordinates), cables_(num_cables) {}

  /// A row of a motion, by pointers to q, qd and the commands.
  void write(Index motion, Index row, const double* q, const double* qd,
             const double* command) noexcept {
    const Index at = motion * num_rows_ + row;
    std::copy_n(q, d_, to_.q + at * d_);
    std::copy_n(qd, d_, to_.qd + at * d_);
    if (to_.command != nullptr) std::copy_n(command, cables_, to_.command + at * cables_);
  }

  /// NaN from a row on.
  void clear(Index motion, Index from = 0) noexcept {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const Index at = motion * num_rows_ + from, count = num_rows_ - from;
    std::fill_n(to_.q + at * d_, count * d_, none);
    std::fill_n(to_.qd + at * d_, count * d_, none);
    if (to_.command != nullptr) std::fill_n(to_.command + at * cables_, count * cables_, none);
  }

 private:
  RolloutRows to_;
  Index num_rows_, d_, cables_;
};

}  // namespace cdcr::detail
