#pragma once

#include "chain/chain.hpp"
#include "section/rod_part.hpp"

namespace cdcr::detail {

/// The sections from the base to one point of the backbone: its frame and how it moves, eqs. (23)
/// to (25). Nothing of the inertia is read. A part is an Arc or a RodPart.
template <class Part, class S>
struct Reach {
  void update(const Chain& chain, const S* q, Index section, double fraction) {
    last = section;
    frame = root_of<S>(chain);
    p.setZero();
    for (Index i = 0; i <= last; ++i) {
      parts[i].update_position(chain.sections[i], frame, q + chain.first[i],
                               i == last ? fraction : 1.0);
      p += parts[i].r;
      ends[i] = p;
      frame = parts[i].end();
    }
  }

  std::array<Part, max_sections> parts;
  std::array<Vector3<S>, max_sections> ends;  // of the parts, from the base
  Index last = -1;
  FrameState<S> frame;
  Vector3<S> p;
};

/// f(reach) of a point, of either kind of section.
template <class S, class F>
auto with_reach(const Chain& chain, const S* q, Index section, double fraction, const F& f) {
  if (chain.has_rods()) {
    Reach<RodPart<S>, S> reach;
    reach.update(chain, q, section, fraction);
    return f(reach);
  }
  Reach<Arc<S>, S> reach;
  reach.update(chain, q, section, fraction);
  return f(reach);
}

}  // namespace cdcr::detail
