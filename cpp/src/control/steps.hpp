#pragma once

#include <cmath>

#include "base/arguments.hpp"

namespace cdcr::detail {

/// How many steps a time is, from `least`. Throws std::invalid_argument where it is not a whole
/// number of them.
inline Index whole_steps(const char* item, double time, double step, Index least) {
  constexpr double close = 1e-9, most = 1e9;  // steps
  const double steps = std::round(time / step);
  require(std::isfinite(time) && steps >= static_cast<double>(least) && steps <= most &&
              std::abs(time / step - steps) <= close * std::fmax(1.0, steps),
          item, " must be a whole number of steps of ", step, " s, ", least > 0 ? "1" : "0",
          " to 1e9, got ", time, " s");
  return static_cast<Index>(steps);
}

}  // namespace cdcr::detail
