#pragma once

#include <algorithm>
#include <cmath>

#include "base/arguments.hpp"
#include "base/sizes.hpp"
#include "cdcr/allocation.hpp"

namespace cdcr::detail {

/// Throws std::invalid_argument naming the limit that is out of range.
inline void check(const Model& model, const TensionLimits& limits) {
  require(!std::isnan(limits.min_tension) && limits.min_tension != HUGE_VAL &&
              limits.max_tension >= limits.min_tension,
          "tension limits must satisfy min_tension <= max_tension, got min_tension ",
          limits.min_tension, " N and max_tension ", limits.max_tension, " N");
  require(limits.max_tension >= 0.0, "max_tension must be >= 0 N (a cable cannot push), got ",
          limits.max_tension);
  require(limits.pretension.size() == 0 || limits.pretension.size() == model.num_cables(),
          "pretension must have one value for each of the ", model.num_cables(), " cables, got ",
          limits.pretension.size());
  for (Index j = 0; j < limits.pretension.size(); ++j) {
    const double least = limits.pretension[j];
    require(std::isfinite(least) && least <= limits.max_tension, "pretension of cable ", j + 1,
            " must be finite and at most max_tension, ", limits.max_tension, " N, got ", least);
  }
  for (const Index cable : limits.cables) {
    require(is_cable(model, cable), "cables must be indices from 0 to ", model.num_cables() - 1,
            ", got ", cable);
    const auto times = std::count(limits.cables.begin(), limits.cables.end(), cable);
    require(times == 1, "cables must differ, got ", cable, " ", times, " times");
  }
}

}  // namespace cdcr::detail
