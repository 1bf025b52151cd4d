#include "cdcr/gain.hpp"

#include <cassert>

#include "base/arguments.hpp"

namespace cdcr {

void Gain::add(const ConstVectorRef& input, VectorRef output) const noexcept {
  assert(values_.size() == 1 || values_.rows() == output.size());
  if (values_.size() == 1) {
    output += values_(0, 0) * input;
  } else if (values_.cols() == 1) {
    output += values_.col(0).cwiseProduct(input);
  } else {
    output.noalias() += values_ * input;
  }
}

void Gain::require(const char* item, Index size, const char* unit) const {
  const bool fits = values_.size() == 1 ||
                    (values_.rows() == size && (values_.cols() == 1 || values_.cols() == size));
  detail::require(fits, item, " must be a number, ", size, " numbers or a matrix of ", size, " by ",
                  size, ", got ", values_.rows(), " by ", values_.cols());
  if (values_.cols() > 1) {
    detail::require(values_.allFinite(), item, " must be finite");
    return;
  }
  for (Index i = 0; i < values_.rows(); ++i) {
    detail::require_not_negative(item, values_(i, 0), unit);
  }
}

}  // namespace cdcr
