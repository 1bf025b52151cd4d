#pragma once

#include "cdcr/cables.hpp"

// Friction of cables that remembers, cpp/friction.md eqs. (105) to (112), in models that have
// num_deflections(): deflection (num_cables) [m] is how far each cable has gone since it stuck,
// or what is left of that while it slides. All functions are real-time safe; sizes are the
// caller's duty. The functions of cdcr/cables.hpp, which know no history, take the law of the
// sliding speed.

namespace CDCR_EXPORT cdcr {

/// Generalised force (d) [N m] of the cables, and the rate of their deflections [m/s].
void cable_force(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const ConstVectorRef& command, const ConstVectorRef& deflection, VectorRef force,
                 VectorRef deflection_rate) noexcept;

/// What friction turns into heat [W], its work less what the deflections store: never negative,
/// but for rounding.
[[nodiscard]] double friction_power(const Model& model, const ConstVectorRef& q,
                                    const ConstVectorRef& qd, const ConstVectorRef& command,
                                    const ConstVectorRef& deflection) noexcept;

/// Energy that the deflections store [J].
[[nodiscard]] double deflection_energy(const Model& model,
                                       const ConstVectorRef& deflection) noexcept;

/// Play of drives, eq. (112): moves what each cable feels (num_cables) as far as the drive takes
/// it along, to within half the backlash of its command.
void follow_with_play(const Model& model, const ConstVectorRef& command, VectorRef felt) noexcept;

}  // namespace CDCR_EXPORT cdcr
