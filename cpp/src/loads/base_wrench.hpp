#pragma once

#include "cdcr/base_wrench.hpp"

namespace cdcr::detail {

/// Adds to slopes (6, d) what wrenches on the robot change with q.
void add_wrench_slopes(const Model& model, const ConstVectorRef& q, const Wrenches& wrenches,
                       MatrixRef slopes) noexcept;

}  // namespace cdcr::detail
