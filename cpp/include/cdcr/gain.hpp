#pragma once

#include "cdcr/export.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// A gain on a vector: one number for all components, one for each, or a matrix.
class Gain {
 public:
  // Both implicit, so that options are written as numbers and vectors.
  Gain(double value) : values_(MatrixXd::Constant(1, 1, value)) {}  // NOLINT
  template <class Derived>
  Gain(const Eigen::MatrixBase<Derived>& values) : values_(values) {}  // NOLINT

  /// As given: (1, 1), (size, 1) or (size, size).
  [[nodiscard]] const MatrixXd& values() const noexcept { return values_; }
  /// output += gain input. Real-time safe.
  void add(const ConstVectorRef& input, VectorRef output) const noexcept;
  /// Throws std::invalid_argument unless it fits vectors of `size`, is finite and, but for a
  /// matrix, not negative.
  void require(const char* item, Index size, const char* unit) const;

 private:
  MatrixXd values_;
};

}  // namespace CDCR_EXPORT cdcr
