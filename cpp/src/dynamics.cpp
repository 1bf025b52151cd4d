#include "cdcr/dynamics.hpp"

#include "chain_functions.hpp"
#include "chain_statics.hpp"
#include "closed_form.hpp"
#include "dual.hpp"

namespace cdcr {

namespace closed_form = detail::closed_form;

void mass_matrix(const Model& model, Data& /*data*/, const ConstVectorRef& q,
                 MatrixRef M) noexcept {
  if (model.has_closed_form()) return closed_form::mass_matrix(model, q, M);
  detail::mass_matrix(model.chain(), q.data(), M);
}

void bias(const Model& model, Data& /*data*/, const ConstVectorRef& q, const ConstVectorRef& qd,
          VectorRef h) noexcept {
  if (model.has_closed_form()) return closed_form::bias(model, q, qd, h);
  detail::inverse_motion(model.chain(), q.data(), qd.data(), nullptr, h.data());
}

void forward_dynamics_force(const Model& model, Data& /*data*/, const ConstVectorRef& q,
                            const ConstVectorRef& qd, const ConstVectorRef& force,
                            VectorRef qdd) noexcept {
  if (model.has_closed_form()) {
    closed_form::forward_dynamics(model, q.data(), qd.data(), force.data(), qdd.data());
  } else {
    detail::forward_motion(model.chain(), q.data(), qd.data(), force.data(), qdd.data());
  }
}

void forward_dynamics(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& tension,
                      VectorRef qdd) noexcept {
  if (model.has_closed_form() && model.has_plain_cables()) {
    double force[2];
    closed_form::actuation_force(model, tension.data(), force);
    closed_form::forward_dynamics(model, q.data(), qd.data(), force, qdd.data());
    return;
  }
  cable_force(model, q, qd, tension, data.force);
  forward_dynamics_force(model, data, q, qd, data.force, qdd);
}

void forward_dynamics(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& tension,
                      const Wrenches& wrenches, VectorRef qdd) noexcept {
  cable_force(model, q, qd, tension, data.force);
  add_wrench_force(model, q, wrenches, data.force);
  forward_dynamics_force(model, data, q, qd, data.force, qdd);
}

void inverse_dynamics(const Model& model, Data& /*data*/, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& qdd,
                      VectorRef force) noexcept {
  if (model.has_closed_form()) return closed_form::inverse_dynamics(model, q, qd, qdd, force);
  detail::inverse_motion(model.chain(), q.data(), qd.data(), qdd.data(), force.data());
}

double kinetic_energy(const Model& model, Data& /*data*/, const ConstVectorRef& q,
                      const ConstVectorRef& qd) noexcept {
  if (model.has_closed_form()) return closed_form::kinetic_energy(model, q, qd);
  return detail::kinetic_energy(model.chain(), q.data(), qd.data());
}

double potential_energy(const Model& model, Data& /*data*/, const ConstVectorRef& q) noexcept {
  if (model.has_closed_form()) return closed_form::potential_energy(model, q);
  return detail::potential_energy(model.chain(), q.data());
}

void potential_gradient(const Model& model, Data& /*data*/, const ConstVectorRef& q,
                        VectorRef gradient) noexcept {
  if (model.has_closed_form()) return closed_form::potential_gradient(model, q, gradient);
  detail::potential_gradient(model.chain(), q.data(), gradient.data());
}

void potential_hessian(const Model& model, Data& /*data*/, const ConstVectorRef& q,
                       MatrixRef H) noexcept {
  if (model.has_closed_form()) return closed_form::potential_hessian(model, q, H);
  const auto m = static_cast<int>(model.num_coordinates());
  detail::differentiate(m, m, q.data(), H, [&model](const detail::Dual* x, detail::Dual* y) {
    detail::potential_gradient(model.chain(), x, y);
  });
}

}  // namespace cdcr
