#pragma once

#include "cdcr/export.hpp"

namespace CDCR_EXPORT cdcr {

/// Which inertia functions a(sigma), b(sigma) a model of one section uses. The equations of motion
/// are the same for all. cpp/README.md says what the printed ones keep and mend.
enum class Formulation {
  exact,           ///< eqs. (9), (10)
  taylor,          ///< M11 and M22 of the exact model cut after theta^4, as the paper cuts them
  printed,         ///< the paper's factors H1 to H8 as printed, made consistent
  printed_taylor,  ///< the same cut after theta^4
};

/// Bending angle up to which the paper holds its Taylor factors to be good [rad], section 4.1.1.
inline constexpr double taylor_range = 3.0 * 3.14159265358979323846 / 5.0;

/// "exact", "taylor", "printed" or "printed-taylor".
[[nodiscard]] const char* name(Formulation formulation) noexcept;

}  // namespace CDCR_EXPORT cdcr
