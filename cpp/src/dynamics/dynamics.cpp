#include "cdcr/dynamics.hpp"

#include "base/sizes.hpp"
#include "dynamics/kept.hpp"
#include "loads/cable_force.hpp"

namespace cdcr {

namespace closed_form = detail::closed_form;
using detail::of_coordinates, detail::single_of;

void mass_matrix(const Model& model, Data& data, const ConstVectorRef& q, MatrixRef M) noexcept {
  assert(data.belongs_to(model) && of_coordinates(model, q));
  assert(detail::has_size(M, model.num_coordinates(), model.num_coordinates()));
  if (model.has_closed_form()) return closed_form::mass_matrix(single_of(model), q, M);
  data.kept()->with(
      model, [&](auto& chain, auto& state) { detail::mass_matrix(chain, state, M); }, q.data());
}

void bias(const Model& model, Data& data, const ConstVectorRef& q, const ConstVectorRef& qd,
          VectorRef h) noexcept {
  assert(data.belongs_to(model) && of_coordinates(model, q, qd, h));
  if (model.has_closed_form()) return closed_form::bias(single_of(model), q, qd, h);
  data.kept()->with(
      model,
      [&](auto& chain, auto& state) { detail::inverse_motion(chain, state, nullptr, h.data()); },
      q.data(), qd.data());
}

void forward_dynamics_force(const Model& model, Data& data, const ConstVectorRef& q,
                            const ConstVectorRef& qd, const ConstVectorRef& force,
                            VectorRef qdd) noexcept {
  assert(data.belongs_to(model) && of_coordinates(model, q, qd, force, qdd));
  if (model.has_closed_form()) {
    closed_form::forward_dynamics(single_of(model), q.data(), qd.data(), force.data(), qdd.data());
    return;
  }
  data.kept()->with(
      model,
      [&](auto& chain, auto& state) {
        detail::forward_motion(chain, state, force.data(), qdd.data());
      },
      q.data(), qd.data());
}

void forward_dynamics(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& tension,
                      VectorRef qdd) noexcept {
  assert(data.belongs_to(model) && of_coordinates(model, q, qd, qdd));
  assert(detail::of_cables(model, tension));
  if (model.has_closed_form() && model.has_plain_cables()) {
    double force[2];
    detail::single_actuation_force(model, tension.data(), force);
    closed_form::forward_dynamics(single_of(model), q.data(), qd.data(), force, qdd.data());
    return;
  }
  cable_force(model, q, qd, tension, data.force);
  forward_dynamics_force(model, data, q, qd, data.force, qdd);
}

void forward_dynamics(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& tension,
                      const Wrenches& wrenches, VectorRef qdd) noexcept {
  assert(data.belongs_to(model));
  total_force(model, q, qd, tension, wrenches, data.force);
  forward_dynamics_force(model, data, q, qd, data.force, qdd);
}

void inverse_dynamics(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& qdd,
                      VectorRef force) noexcept {
  assert(data.belongs_to(model) && of_coordinates(model, q, qd, qdd, force));
  if (model.has_closed_form()) {
    closed_form::inverse_dynamics(single_of(model), q.data(), qd.data(), qdd.data(), force.data());
    return;
  }
  data.kept()->with(
      model,
      [&](auto& chain, auto& state) {
        detail::inverse_motion(chain, state, qdd.data(), force.data());
      },
      q.data(), qd.data());
}

void inverse_dynamics(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& qdd, const Wrenches& wrenches,
                      VectorRef force) noexcept {
  inverse_dynamics(model, data, q, qd, qdd, force);
  data.force.setZero();
  add_wrench_force(model, q, wrenches, data.force);
  force -= data.force;
}

double kinetic_energy(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd) noexcept {
  assert(data.belongs_to(model) && of_coordinates(model, q, qd));
  if (model.has_closed_form()) return closed_form::kinetic_energy(single_of(model), q, qd);
  return data.kept()->with(
      model,
      [&](auto& chain, auto& state) { return detail::kinetic_energy(chain, state, qd.data()); },
      q.data());
}

}  // namespace cdcr
