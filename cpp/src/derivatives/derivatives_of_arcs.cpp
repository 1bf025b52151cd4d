#include "derivatives/differentiate_base.hpp"

namespace cdcr::detail {

template class MotionDerivatives<ConstantCurvature>;
template void weight_hessian(const Chain&, const ArcChainState<double>&, const double*,
                             MatrixRef) noexcept;

}  // namespace cdcr::detail
