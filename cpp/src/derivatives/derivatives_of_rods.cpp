#include "derivatives/differentiate_motion.hpp"
#include "section/rod_body.hpp"

namespace cdcr::detail {

template class MotionDerivatives<Rod>;

}  // namespace cdcr::detail
