#pragma once

#include <variant>
#include <vector>

#include "cdcr/base_wrench.hpp"
#include "chain/chain.hpp"
#include "derivatives/dual.hpp"

namespace cdcr::detail {

/// How cdcr::base_wrench changes with (q, qd, qdd), exact to rounding. Set-up allocates; the rest
/// is real-time safe.
class BaseWrenchSlopes {
 public:
  explicit BaseWrenchSlopes(const Model& model);

  /// (6, 3d), without wrenches.
  void update(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
              const ConstVectorRef& qdd, MatrixRef slopes) noexcept;

 private:
  /// One section of either kind at a time, on the heap where it is large.
  std::variant<std::vector<ConstantCurvature<Dual>>, std::vector<Rod<Dual>>> section_;
  std::vector<Dual> motion_;  // q, qd, qdd
};

/// Adds to slopes (6, d) what wrenches on the robot change with q.
void add_wrench_slopes(const Model& model, const ConstVectorRef& q, const Wrenches& wrenches,
                       MatrixRef slopes) noexcept;

}  // namespace cdcr::detail
