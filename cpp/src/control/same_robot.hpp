#pragma once

#include "cdcr/model.hpp"

// Whether controllers and estimators were made for a robot like the one that they meet.

namespace cdcr::detail {

/// Throws std::invalid_argument where `who` was made for other numbers of coordinates and cables.
void require_sizes(const char* who, Index num_coordinates, Index num_cables, const Model& model);

/// Throws std::invalid_argument where a cable of one is driven by tension and of the other by
/// length. `who` begins the sentence: "the controller drives cables by ".
void require_drives(const char* who, const Model& made_for, const Model& model);

}  // namespace cdcr::detail
