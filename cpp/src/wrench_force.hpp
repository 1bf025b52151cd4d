#pragma once

#include "cdcr/wrench.hpp"
#include "chain.hpp"

namespace cdcr::detail {

/// Adds J^T w of each wrench, eq. (35), by passes along the chain without velocities.
template <class S>
void add_wrench_force(const Chain& chain, const S* q, const Wrenches& wrenches, S* force) {
  for (const Wrench& wrench : wrenches) {
    const Index last = wrench.section;
    Arc<S> arcs[max_sections];
    Vector3<S> ends[max_sections];
    Mount<S> mount = root_of<S>(chain);
    Vector3<S> p = Vector3<S>::Zero();
    for (Index i = 0; i <= last; ++i) {
      const Body& body = chain.bodies[i];
      arcs[i].place(body, mount, q[2 * i], q[2 * i + 1], i == last ? wrench.fraction : 1.0);
      p += arcs[i].r;
      ends[i] = p;
      mount = arcs[i].tip();
    }
    Vector3<S> f = wrench.force.cast<S>(), m = wrench.moment.cast<S>();
    if (wrench.frame == Wrench::Frame::local) {
      f = mount.x * wrench.force[0] + mount.y * wrench.force[1] + mount.z * wrench.force[2];
      m = mount.x * wrench.moment[0] + mount.y * wrench.moment[1] + mount.z * wrench.moment[2];
    }
    for (Index i = last; i >= 0; --i) {
      const Vector3<S> about_end = m + Vector3<S>(p - ends[i]).cross(f);
      for (int k = 0; k < 2; ++k) {
        force[2 * i + k] += arcs[i].W.col(k).dot(about_end) + arcs[i].D.col(k).dot(f);
      }
    }
  }
}

}  // namespace cdcr::detail
