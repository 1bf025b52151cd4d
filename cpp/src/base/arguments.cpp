#include "base/arguments.hpp"

#include <cmath>

namespace cdcr::detail {

std::ostream& operator<<(std::ostream& text, const Listed& all) {
  constexpr Index most = 20;
  const Index size = all.numbers.size(), shown = size > most ? most : size;
  text << "[" << all.numbers.head(shown).transpose();
  if (size > shown) text << " ... of " << size;
  return text << "]";
}

void require_finite(const char* item, const VectorXd& v, Index size) {
  require(v.size() == size && v.allFinite(), item, " must be ", size, " finite values, got ",
          Listed{v});
}

void require_increasing(const char* item, const double* times, Index size, bool with_jumps) {
  for (Index i = 0; i < size; ++i) {
    const bool jumps =
        with_jumps && i > 0 && times[i] == times[i - 1] && (i == 1 || times[i - 1] > times[i - 2]);
    if (std::isfinite(times[i]) && (i == 0 || times[i] > times[i - 1] || jumps)) continue;
    refuse(item, " must be finite and strictly increasing, got ", times[i], " s at index ", i,
           i > 0 ? sentence(" after ", times[i - 1], " s") : "");
  }
}

void require_positive(const char* item, double value, const char* unit) {
  require(value > 0.0 && std::isfinite(value), item, " must be > 0 ", unit, " and finite, got ",
          value);
}

void require_not_negative(const char* item, double value, const char* unit) {
  require(value >= 0.0 && std::isfinite(value), item, " must be >= 0 ", unit, " and finite, got ",
          value);
}

}  // namespace cdcr::detail
