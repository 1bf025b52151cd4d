#include "chain/recursions.hpp"

namespace cdcr::detail {

template void update_position(const Chain&, MotionState&, const double*) noexcept;
template void update_velocity(const Chain&, MotionState&, const double*) noexcept;
template void update_motion(const Chain&, MotionState&, const double*, const double*) noexcept;
template void forward_motion(const Chain&, const MotionState&, const double*, double*) noexcept;
template void inverse_motion(const Chain&, const MotionState&, const double*, double*) noexcept;
template void mass_matrix(const Chain&, const MotionState&, MatrixRef) noexcept;
template double kinetic_energy(const Chain&, const MotionState&, const double*) noexcept;
template double potential_energy(const Chain&, const MotionState&, const double*) noexcept;
template void weight_gradient(const Chain&, const MotionState&, const double*, double*) noexcept;

}  // namespace cdcr::detail
