#include "batch/chain_lanes.hpp"

#include "batch/lanes.hpp"
#include "chain/forward.hpp"

namespace cdcr::detail {

template <int W>
void ChainLanes<W>::accelerate(const Pack<W>* q, const Pack<W>* qd, const Pack<W>* force,
                               Pack<W>* qdd) noexcept {
  in_lanes_of(std::integral_constant<int, W>(), [&](auto /*width*/) {
    state_->update(chain_, q, qd);
    forward_dynamics(chain_, *state_, force, qdd);
  });
}

template class ChainLanes<2>;
#if defined(__x86_64__)
template class ChainLanes<4>;
#endif

}  // namespace cdcr::detail
