#pragma once

#include <vector>

#include "integration/rollout_rows.hpp"
#include "integration/workers.hpp"

namespace cdcr::detail {

/// Whether the motions of a rollout can be worked on in lanes: one model, rk4, and commands that
/// alone decide the force.
[[nodiscard]] bool fits_lanes(const Motions& motions, const RolloutOptions& options) noexcept;

/// How many motions of such a rollout go on together.
[[nodiscard]] Index lane_block(const Motions& motions);

/// Runs the motions first, first + 1, .. of such a rollout, as many as go on together, and writes
/// their rows. Returns false where go_on did not want to go on, and adds to `lost` the motions that
/// left the shapes the model is valid for, whose rows do not count.
[[nodiscard]] bool run_in_lanes(const Motions& motions, const RolloutOptions& options, Index first,
                                RowWriter& rows, const GoOn& go_on, std::vector<Index>& lost);

}  // namespace cdcr::detail
