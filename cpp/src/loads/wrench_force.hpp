#pragma once

#include "cdcr/wrench.hpp"
#include "chain/reach.hpp"

namespace cdcr::detail {

/// Adds J^T w of a wrench, eq. (35), by a pass along the chain without velocities.
template <class S>
void add_wrench_force(const Chain& chain, const S* q, const Wrench& wrench, S* force) {
  with_reach(chain, q, wrench.section, wrench.fraction, [&](const auto& reach) {
    const bool local = wrench.frame == Wrench::Frame::local;
    const auto& frame = reach.frame;
    const Vector3<S> f = local ? frame.rotate(wrench.force) : wrench.force.cast<S>();
    const Vector3<S> m = local ? frame.rotate(wrench.moment) : wrench.moment.cast<S>();
    for (Index i = reach.last; i >= 0; --i) {
      const Vector3<S> about_end = m + Vector3<S>(reach.p - reach.ends[i]).cross(f);
      for (Index k = 0; k < reach.parts[i].J_omega.cols(); ++k) {
        force[chain.first[i] + k] +=
            reach.parts[i].J_omega.col(k).dot(about_end) + reach.parts[i].J_v.col(k).dot(f);
      }
    }
  });
}

/// The same of each.
template <class S>
void add_wrench_force(const Chain& chain, const S* q, const Wrenches& wrenches, S* force) {
  for (const Wrench& wrench : wrenches) add_wrench_force(chain, q, wrench, force);
}

}  // namespace cdcr::detail
