#pragma once

#include "cdcr/model.hpp"

// One section with nothing but a point on its tip: equations of motion in closed form, cpp/README.md
// eqs. (8) to (19).

namespace cdcr::detail::closed_form {

void mass_matrix(const Model& model, const ConstVectorRef& q, MatrixRef M) noexcept;
void bias(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
          VectorRef h) noexcept;
void forward_dynamics(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                      const ConstVectorRef& force, VectorRef qdd) noexcept;
void inverse_dynamics(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                      const ConstVectorRef& qdd, VectorRef force) noexcept;
[[nodiscard]] double kinetic_energy(const Model& model, const ConstVectorRef& q,
                                    const ConstVectorRef& qd) noexcept;
[[nodiscard]] double potential_energy(const Model& model, const ConstVectorRef& q) noexcept;
void potential_gradient(const Model& model, const ConstVectorRef& q, VectorRef gradient) noexcept;
void potential_hessian(const Model& model, const ConstVectorRef& q, MatrixRef H) noexcept;
/// d(qdd)/dq and d(qdd)/dqd (2, 2) at a constant force.
void acceleration_jacobians(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                            const ConstVectorRef& force, MatrixRef on_q, MatrixRef on_qd) noexcept;
/// M^-1 applied to the columns of `rows` (2, any).
void solve_mass(const Model& model, const ConstVectorRef& q, const MatrixXd& rows,
                MatrixRef solution) noexcept;

}  // namespace cdcr::detail::closed_form
