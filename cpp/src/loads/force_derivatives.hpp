#pragma once

#include <vector>

#include "cdcr/model.hpp"
#include "cdcr/wrench.hpp"
#include "derivatives/dual.hpp"
#include "derivatives/lane_map.hpp"

namespace cdcr::detail {

/// Room for dual numbers of a state, of commands and of a generalised force; empty where no cable
/// needs it.
struct ForceDuals {
  explicit ForceDuals(const Model& model);
  std::vector<Dual> q, qd, command, force;
};

/// Adds to rows the derivatives of total_force with respect to q and qd, and to commands where
/// there is room for them.
void add_force_derivatives(const Model& model, ForceDuals& duals, const ConstVectorRef& q,
                           const ConstVectorRef& qd, const ConstVectorRef& command,
                           const Wrenches& wrenches, const LaneMap& lanes, Quad* rows) noexcept;

/// Takes from K (d, d) the derivatives of the generalised force of wrenches.
void subtract_wrench_stiffness(const Model& model, const ConstVectorRef& q,
                               const Wrenches& wrenches, MatrixRef K) noexcept;

}  // namespace cdcr::detail
