#include "dynamics/differentiate_motion.hpp"

// Compiled apart: beside it, the compiler would inline less of what arcs need.

namespace cdcr::detail {

template void differentiate_motion(const Model&, RodChainState<Dual>&, const ConstVectorRef&,
                                   const ConstVectorRef&, const ConstVectorRef&, const Wrenches&,
                                   MatrixRef, MatrixRef*) noexcept;

}  // namespace cdcr::detail
