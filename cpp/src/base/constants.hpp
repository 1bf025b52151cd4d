#pragma once

namespace cdcr::detail {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double full_circle = 2.0 * pi;

}  // namespace cdcr::detail
