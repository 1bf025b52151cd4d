#pragma once

#include <limits>

#include "cdcr/model.hpp"
#include "cdcr/status.hpp"

namespace cdcr {

/// Tensions found for a generalised force, and how well they do.
struct Allocation {
  VectorXd tension;             ///< (num_cables) [N], within the limits
  VectorXd force;               ///< B F, the generalised force they give (2n) [N m]
  double distance = 0.0;        ///< |B F - Q|, zero but for rounding when feasible [N m]
  bool feasible = false;        ///< the force is met
  std::vector<Index> limiting;  ///< cables at a limit, when infeasible
};

/// Least-norm tensions F with B F = force and min <= F <= max [N]; cpp/README.md eq. (20).
///
/// When no such tensions exist, the tensions whose force comes nearest. Throws
/// std::invalid_argument for wrong sizes, non-finite forces, and limits without
/// 0 <= min_tension <= max_tension.
[[nodiscard]] Allocation allocate(const Model& model, const VectorXd& force,
                                  double min_tension = 0.0,
                                  double max_tension = std::numeric_limits<double>::infinity());

}  // namespace cdcr
