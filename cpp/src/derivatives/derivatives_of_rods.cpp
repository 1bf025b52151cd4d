#include "derivatives/differentiate_base.hpp"
#include "section/rod_body.hpp"

namespace cdcr::detail {

template class MotionDerivatives<Rod>;

}  // namespace cdcr::detail
