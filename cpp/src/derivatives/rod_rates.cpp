#include "derivatives/rod_rates.hpp"

namespace cdcr::detail {

void update_rates(Rod<double>& rod, const SectionParameters& fixed, const Vector3d& omega,
                  const double* qd, bool turns) noexcept {
  if (turns) {
    rod.update_velocity<true>(fixed, omega, qd);
  } else {
    rod.update_velocity<false>(fixed, omega, qd);
  }
}

}  // namespace cdcr::detail
