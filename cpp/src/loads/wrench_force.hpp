#pragma once

#include "cdcr/wrench.hpp"
#include "chain/arcs.hpp"

namespace cdcr::detail {

/// Adds J^T w of each wrench, eq. (35), by passes along the chain without velocities.
template <class S>
void add_wrench_force(const Chain& chain, const S* q, const Wrenches& wrenches, S* force) {
  for (const Wrench& wrench : wrenches) {
    Arcs<S> arcs;
    arcs.update(chain, q, wrench.section, wrench.fraction);
    const bool local = wrench.frame == Wrench::Frame::local;
    const Vector3<S> f = local ? arcs.frame.rotate(wrench.force) : wrench.force.cast<S>();
    const Vector3<S> m = local ? arcs.frame.rotate(wrench.moment) : wrench.moment.cast<S>();
    for (Index i = arcs.last; i >= 0; --i) {
      const Vector3<S> about_end = m + Vector3<S>(arcs.p - arcs.ends[i]).cross(f);
      for (Index k = 0; k < arcs.arcs[i].J_omega.cols(); ++k) {
        force[chain.first[i] + k] +=
            arcs.arcs[i].J_omega.col(k).dot(about_end) + arcs.arcs[i].J_v.col(k).dot(f);
      }
    }
  }
}

}  // namespace cdcr::detail
