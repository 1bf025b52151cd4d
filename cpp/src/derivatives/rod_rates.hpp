#pragma once

#include "cdcr/robot.hpp"
#include "section/rod.hpp"

namespace cdcr::detail {

/// Terms of a rod from velocities alone, on its base that turns or does not. Compiled apart.
void update_rates(Rod<double>& rod, const SectionParameters& fixed, const Vector3d& omega,
                  const double* qd, bool turns) noexcept;

}  // namespace cdcr::detail
