#pragma once

#include <type_traits>

namespace cdcr::detail {

#if defined(__x86_64__)
/// How many doubles are worked on at once: a register of this processor. Registers of AVX-512 are
/// left alone, since of chains they were slower where we could measure (bench/README.md).
// NOLINTNEXTLINE(readability-implicit-bool-conversion): a bool to clang, an int to GCC
inline const int num_lanes =
    __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? 4 : 2;

template <class F>
[[gnu::target("avx2,fma"), gnu::flatten]] void in_lanes_of(std::integral_constant<int, 4> width,
                                                           const F& f) {
  f(width);
}
#else
inline constexpr int num_lanes = 2;
#endif

/// f(width), compiled for registers of so many doubles.
template <class F>
[[gnu::flatten]] void in_lanes_of(std::integral_constant<int, 2> width, const F& f) {
  f(width);
}

/// f(width) of the width of this processor, or another, as std::integral_constant.
template <class F>
auto with_lanes(const F& f, [[maybe_unused]] int lanes = num_lanes) {
#if defined(__x86_64__)
  if (lanes == 4) return f(std::integral_constant<int, 4>());
#endif
  return f(std::integral_constant<int, 2>());
}

}  // namespace cdcr::detail
