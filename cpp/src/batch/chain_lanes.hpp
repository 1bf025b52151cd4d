#pragma once

#include <memory>

#include "batch/pack_tables.hpp"
#include "chain/chain.hpp"

namespace cdcr::detail {

/// Accelerations of W states of a chain of arcs at once. Made for one chain, which must outlive it.
template <int W>
class ChainLanes {
 public:
  explicit ChainLanes(const Chain& chain)
      : chain_(chain), state_(std::make_unique<ArcChainState<Pack<W>>>()) {}

  /// All of num_coordinates, force and qdd generalised forces and accelerations. Real-time safe.
  void accelerate(const Pack<W>* q, const Pack<W>* qd, const Pack<W>* force, Pack<W>* qdd) noexcept;

 private:
  const Chain& chain_;
  std::unique_ptr<ArcChainState<Pack<W>>> state_;  // too large for some stacks
};

extern template class ChainLanes<2>;
#if defined(__x86_64__)
extern template class ChainLanes<4>;
#endif

}  // namespace cdcr::detail
