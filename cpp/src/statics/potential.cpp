#include "statics/potential.hpp"

#include "base/sizes.hpp"
#include "cdcr/dynamics.hpp"
#include "derivatives/weight_hessian.hpp"

namespace cdcr {

using detail::of_coordinates;

namespace detail {

double energy_from_base(const Model& model, KeptChain* kept, const ConstVectorRef& q) noexcept {
  if (model.has_closed_form()) return closed_form::potential_energy(single_of(model), q);
  return kept->with(
      model, [&](auto& chain, auto& state) { return potential_energy(chain, state, q.data()); },
      q.data());
}

void potential_gradient(const Model& model, KeptChain* kept, const ConstVectorRef& q,
                        VectorRef gradient) noexcept {
  assert(of_coordinates(model, q, gradient));
  if (model.has_closed_form()) {
    return closed_form::potential_gradient(single_of(model), q, gradient);
  }
  kept->with(
      model,
      [&](auto& chain, auto& state) { weight_gradient(chain, state, q.data(), gradient.data()); },
      q.data());
}

void potential_hessian(const Model& model, KeptChain* kept, const ConstVectorRef& q,
                       MatrixRef H) noexcept {
  assert(of_coordinates(model, q));
  assert(has_size(H, model.num_coordinates(), model.num_coordinates()));
  if (model.has_closed_form()) return closed_form::potential_hessian(single_of(model), q, H);
  kept->with(
      model, [&](auto& chain, auto& state) { weight_hessian(chain, state, q.data(), H); },
      q.data());
}

}  // namespace detail

double potential_energy(const Model& model, Data& data, const ConstVectorRef& q) noexcept {
  assert(data.belongs_to(model) && of_coordinates(model, q));
  return detail::energy_from_base(model, data.kept(), q) + model.base_energy();
}

void potential_gradient(const Model& model, Data& data, const ConstVectorRef& q,
                        VectorRef gradient) noexcept {
  assert(data.belongs_to(model));
  detail::potential_gradient(model, data.kept(), q, gradient);
}

void potential_hessian(const Model& model, Data& data, const ConstVectorRef& q,
                       MatrixRef H) noexcept {
  detail::potential_hessian(model, data.kept(), q, H);
}

}  // namespace cdcr
