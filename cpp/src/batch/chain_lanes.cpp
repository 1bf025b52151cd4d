#include "batch/chain_lanes.hpp"

#include "base/lanes.hpp"
#include "chain/energy.hpp"
#include "chain/forward.hpp"
#include "chain/gradient.hpp"
#include "chain/inverse.hpp"
#include "chain/mass_matrix.hpp"
#include "derivatives/jacobian.hpp"

namespace cdcr::detail {
namespace {

/// f(), compiled for registers of W doubles.
template <int W, class F>
void in_lanes(const F& f) {
  in_lanes_of(std::integral_constant<int, W>(), [&](auto /*width*/) { f(); });
}

template <class P>
using ArcReach = Reach<Arc<P>, P>;

}  // namespace

template <int W>
void ChainLanes<W>::update_position(const P* q) noexcept {
  in_lanes<W>([&] { state_->update_position(chain_, q); });
}

template <int W>
void ChainLanes<W>::update(const P* q, const P* qd) noexcept {
  in_lanes<W>([&] { state_->update(chain_, q, qd); });
}

template <int W>
void ChainLanes<W>::accelerate(const P* q, const P* qd, const P* force, P* qdd) noexcept {
  update(q, qd);
  in_lanes<W>([&] { forward_dynamics(chain_, *state_, force, qdd); });
}

template <int W>
void ChainLanes<W>::inverse_dynamics(const P* q, const P* qd, const P* qdd, P* force) noexcept {
  update(q, qd);
  in_lanes<W>([&] { detail::inverse_dynamics(chain_, *state_, qdd, force); });
}

template <int W>
void ChainLanes<W>::mass_matrix(const P* q, P* M) noexcept {
  update_position(q);
  in_lanes<W>([&] {
    const Index d = chain_.num_coordinates();
    constexpr int most = 2 * max_sections;
    Eigen::Map<Eigen::Matrix<P, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>> matrix(M, d, d);
    composite_mass(chain_, *state_, matrix);
  });
}

template <int W>
void ChainLanes<W>::kinetic_energy(const P* q, const P* qd, P* T) noexcept {
  update_position(q);
  in_lanes<W>([&] { *T = kinetic_energy_of(chain_, *state_, qd); });
}

template <int W>
void ChainLanes<W>::potential_energy(const P* q, P* U) noexcept {
  update_position(q);
  in_lanes<W>([&] { *U = potential_energy_of(chain_, *state_, q); });
}

template <int W>
void ChainLanes<W>::potential_gradient(const P* q, P* gradient) noexcept {
  update_position(q);
  in_lanes<W>([&] { detail::potential_gradient(chain_, *state_, q, gradient); });
}

template <int W>
void ChainLanes<W>::pose(const P* q, const Place& place, P* R, P* p) noexcept {
  in_lanes<W>([&] {
    ArcReach<P> reach;
    reach.update(chain_, q, place.section, place.fraction);
    const Vector3<P> at = reach.p + reach.frame.rotate(place.offset);
    for (int row = 0; row < 3; ++row) {
      p[row] = at[row];
      for (int column = 0; column < 3; ++column) {
        R[3 * row + column] = reach.frame.rotate(place.turn.col(column))[row];
      }
    }
  });
}

template <int W>
void ChainLanes<W>::jacobian(const P* q, const Place& place, P* J) noexcept {
  in_lanes<W>([&] {
    ArcReach<P> reach;
    reach.update(chain_, q, place.section, place.fraction);
    const Index d = chain_.num_coordinates();
    for (Index i = 0; i < 6 * d; ++i) J[i] = P(0.0);
    const Vector3<P> at = reach.p + reach.frame.rotate(place.offset);
    each_column(reach, at,
                [&](Index i, Index k, const Vector3<P>& moving, const Vector3<P>& turning) {
                  P* column = J + chain_.first[i] + k;
                  for (int row = 0; row < 3; ++row) {
                    column[row * d] = moving[row];
                    column[(row + 3) * d] = turning[row];
                  }
                });
  });
}

template class ChainLanes<2>;
#if defined(__x86_64__)
template class ChainLanes<4>;
#endif

}  // namespace cdcr::detail
