#pragma once

#include "chain/reach.hpp"

namespace cdcr::detail {

/// f(section, k, moving, turning) of the columns of the Jacobian of a point at `at`, from the base,
/// that the last of the parts carries, eq. (5).
template <class Part, class S, class F>
void each_column(const Reach<Part, S>& reach, const Vector3<S>& at, const F& f) {
  for (Index i = 0; i <= reach.last; ++i) {
    const Part& part = reach.parts[i];
    const Vector3<S> beyond = at - reach.ends[i];  // what the end of this part carries along
    for (Index k = 0; k < part.J_omega.cols(); ++k) {
      const Vector3<S> turning = part.J_omega.col(k);
      f(i, k, Vector3<S>(part.J_v.col(k) + turning.cross(beyond)), turning);
    }
  }
}

}  // namespace cdcr::detail
