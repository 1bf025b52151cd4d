#pragma once

#include "cdcr/types.hpp"

namespace cdcr::detail {

/// A collocation method: nodes c on [0, 1], the last of them 1, and integrals of their polynomials.
struct Collocation {
  /// Radau IIA of so many stages s, 2 to 5: of order 2 s - 1, and stiff modes die out in it. Hairer
  /// and Wanner, "Solving Ordinary Differential Equations II", section IV.5.
  static Collocation radau(int stages);

  [[nodiscard]] Index stages() const noexcept { return nodes.size(); }

  VectorXd nodes;
  MatrixXd once;   ///< a_ij: integral of polynomial j from 0 to c_i; the last row are the weights
  MatrixXd twice;  ///< of that integral again
  MatrixXd error;  ///< the weights less those without the first, in row 0, or the second node
};

}  // namespace cdcr::detail
