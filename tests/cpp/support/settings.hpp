#pragma once

#include <cstdint>
#include <cstdlib>

namespace cdcr::test {

inline double environment(const char* variable, double otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtod(text, nullptr);
}

/// Random robots in each random test.
inline int test_count() {
  return static_cast<int>(environment("CDCR_TEST_COUNT", 8));
}

inline std::uint64_t test_seed() {
  return static_cast<std::uint64_t>(environment("CDCR_TEST_SEED", 1));
}

/// Multiplies every tolerance; with 0 every residual fails and so prints its true value.
inline double tolerance_scale() {
  static const double scale = environment("CDCR_TOL_SCALE", 1.0);
  return scale;
}

}  // namespace cdcr::test
