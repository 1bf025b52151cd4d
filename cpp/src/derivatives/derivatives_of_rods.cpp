#include "derivatives/differentiate_motion.hpp"
#include "section/rod_body.hpp"

namespace cdcr::detail {

template class MotionDerivatives<Rod>;
template void weight_hessian(const Chain&, const RodChainState<double>&, const double*, Rod<Dual>&,
                             MatrixRef) noexcept;

}  // namespace cdcr::detail
