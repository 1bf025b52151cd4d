#pragma once

#include <type_traits>

#include "section/pair.hpp"

namespace cdcr::detail {

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// Whether this processor has fused multiply-add, which halves the instructions of a rod.
// NOLINTNEXTLINE(readability-implicit-bool-conversion): a bool to clang, an int to GCC
inline const bool has_fma = __builtin_cpu_supports("fma") != 0;

template <class F, class Width>
[[gnu::target("fma"), gnu::flatten]] void run_with_fma(const F& f, Width width) {
  f(width);
}
#endif

template <class F, class Width>
void run(const F& f, Width width) {
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  if (has_fma) return run_with_fma(f, width);
#endif
  f(width);
}

/// f() of doubles.
template <class S, class F>
void with_fma(const F& f) {
  if constexpr (Rows<S>::count == 1) {
    f();
  } else {
    run([&f](int) { f(); }, 0);
  }
}

/// The largest that a width can be.
template <class Width>
inline constexpr int widest = 20;
template <int width>
inline constexpr int widest<std::integral_constant<int, width>> = width;

/// f(width) for a number of coordinates: of doubles with the least width known to the compiler that
/// holds them; columns beyond are zero.
template <class S, class F>
void with_width(int size, const F& f) {
  if constexpr (Rows<S>::count == 1) {
    f(size);
  } else {
    if (size <= 8) return run(f, std::integral_constant<int, 8>());
    if (size <= 12) return run(f, std::integral_constant<int, 12>());
    run(f, std::integral_constant<int, 20>());
  }
}

}  // namespace cdcr::detail
