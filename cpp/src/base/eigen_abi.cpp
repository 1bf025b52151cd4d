#include "cdcr/eigen_abi.hpp"

namespace cdcr::detail {
const char CDCR_EIGEN_ABI = 0;
}  // namespace cdcr::detail
