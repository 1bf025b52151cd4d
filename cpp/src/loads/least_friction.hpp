#pragma once

#include "cdcr/model.hpp"

namespace cdcr::detail {

/// A ten thousandth of the tension that bends the softest section by a radian [N], 0 where no cable
/// bends any: cpp/friction.md eq. (107).
[[nodiscard]] double least_friction(const Model& model) noexcept;

}  // namespace cdcr::detail
