#pragma once

#include "derivatives/differentiate_motion.hpp"

// What MotionDerivatives tells of the base, for the two files that make it of their kind of
// section.

namespace cdcr::detail {

/// Loads of all lanes, moved to the first base, and what accelerations ask of it.
template <template <class> class Kind>
void MotionDerivatives<Kind>::differentiate_base(const Chain& chain,
                                                 const ChainState<Section>& state, const double* q,
                                                 const double* qd, const double* accelerations,
                                                 MatrixRef slopes) noexcept {
  const Index d = qdd.size();
  std::copy_n(accelerations, d, qdd.data());
  with_fma<double>([&] {
    add_up_mass(chain, state);
    accelerate(chain, state, qd);
    differentiate_inwards(chain, state, q, qd, true);
  });
  const auto take_load = [&](Index lane, Index column) {
    const Load& load = loads_[static_cast<std::size_t>(lane / Quad::count)];
    for (int c = 0; c < 3; ++c) {
      slopes(c, column) = -load.F[c][static_cast<int>(lane % Quad::count)];
      slopes(3 + c, column) = -load.T[c][static_cast<int>(lane % Quad::count)];
    }
  };
  Vector3d place = Vector3d::Zero();
  for (Index i = 0; i < chain.num_sections(); ++i) {
    for (Index k = chain.first[i]; k < chain.first[i + 1]; ++k) {
      take_load(lanes.on_q(k), k);
      take_load(lanes.on_qd(k), d + k);
      const Vector3d push = pushes_.col(k);
      slopes.col(2 * d + k) << -push, -(twists_.col(k) + place.cross(push));
    }
    place += state.sections[i].r;
  }
}

}  // namespace cdcr::detail
