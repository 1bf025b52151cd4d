#pragma once

#include "cdcr/linearization.hpp"

namespace cdcr::detail {

/// A matrix of the caller, stored by columns or by rows.
using AnyMatrix = Eigen::Map<MatrixXd, 0, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>>;

[[nodiscard]] inline AnyMatrix by_columns(MatrixRef matrix) {
  return {matrix.data(), matrix.rows(), matrix.cols(), {matrix.outerStride(), 1}};
}
/// The columns from `first` on of rows that have `width` numbers.
[[nodiscard]] inline AnyMatrix by_rows(double* data, Index num_rows, Index num_columns, Index width,
                                       Index first = 0) {
  return {data + first, num_rows, num_columns, {1, width}};
}

/// Derivatives of the accelerations; nothing where nothing is wanted.
struct AccelerationSlopes {
  AnyMatrix on_q, on_qd;
  AnyMatrix* on_command = nullptr;
  AnyMatrix* on_wrenches = nullptr;
  const ConstVectorRef* added = nullptr;  ///< to the generalised force
};

/// All functions of cdcr/linearization.hpp.
void differentiate_motion(const Model& model, Data& data, const ConstVectorRef& q,
                          const ConstVectorRef& qd, const ConstVectorRef& command,
                          const Wrenches& wrenches, AccelerationSlopes out) noexcept;

}  // namespace cdcr::detail
