#pragma once

#include "chain/chain.hpp"

namespace cdcr::detail {

/// The arcs from the base to one point of the backbone: its frame and how it moves, eqs. (23) to
/// (25). Nothing of the inertia is read.
template <class S>
struct Arcs {
  void update(const Chain& chain, const S* q, Index section, double fraction) {
    last = section;
    frame = root_of<S>(chain);
    p.setZero();
    for (Index i = 0; i <= last; ++i) {
      arcs[i].update_position(chain.sections[i], frame, q + chain.first[i],
                              i == last ? fraction : 1.0);
      p += arcs[i].r;
      ends[i] = p;
      frame = arcs[i].end();
    }
  }

  std::array<Arc<S>, max_sections> arcs;
  std::array<Vector3<S>, max_sections> ends;  // of the arcs, from the base
  Index last = -1;
  FrameState<S> frame;
  Vector3<S> p;
};

}  // namespace cdcr::detail
