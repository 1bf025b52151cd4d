#pragma once

#include "dynamics/kept.hpp"

namespace cdcr::detail {

// Functions of position alone (cdcr/dynamics.hpp). No chain is needed where the closed form
// applies.

/// Potential energy of the robot were its base at the origin: with all digits wherever it stands.
[[nodiscard]] double energy_from_base(const Model& model, KeptChain* kept,
                                      const ConstVectorRef& q) noexcept;
void potential_gradient(const Model& model, KeptChain* kept, const ConstVectorRef& q,
                        VectorRef gradient) noexcept;
void potential_hessian(const Model& model, KeptChain* kept, const ConstVectorRef& q,
                       MatrixRef H) noexcept;

}  // namespace cdcr::detail
