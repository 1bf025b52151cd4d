#pragma once

namespace cdcr::detail {

inline constexpr double pi = 3.14159265358979323846;

}  // namespace cdcr::detail
