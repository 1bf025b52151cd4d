#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

#include "cdcr/types.hpp"

// Checks of arguments and the sentences that refuse them: the item, what is allowed, what was got.

namespace cdcr::detail {

/// Parts written one after the other; numbers to six digits, as a stream writes them.
template <class... Parts>
[[nodiscard]] std::string sentence(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  throw std::invalid_argument(sentence(parts...));
}

/// Throws std::invalid_argument with the sentence unless the argument is sound.
template <class... Parts>
void require(bool sound, const Parts&... parts) {
  if (!sound) refuse(parts...);
}

/// Numbers as a refusal has them, cut after twenty: "[1 nan 3]".
struct Listed {
  const VectorXd& numbers;
  friend std::ostream& operator<<(std::ostream& text, const Listed& all);
};

/// "reference must be 2 finite values, got [1 nan]".
void require_finite(const char* item, const VectorXd& v, Index size);

/// "t must be finite and strictly increasing, got 1 s at index 2 after 3 s".
/// With jumps, a time may stand twice.
void require_increasing(const char* item, const double* times, Index size, bool with_jumps = false);

/// Finite and above zero: "step must be > 0 s and finite, got -1".
void require_positive(const char* item, double value, const char* unit);

/// Finite and not below zero.
void require_not_negative(const char* item, double value, const char* unit);

}  // namespace cdcr::detail
