#pragma once

#include "cdcr/model.hpp"

namespace cdcr::detail {

/// Throws std::invalid_argument where float64 cannot hold a robot's length squared, its stiffness
/// or its inertia.
void require_magnitudes(const Model& model);

}  // namespace cdcr::detail
