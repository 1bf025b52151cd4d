#include "batch/in_packs.hpp"
#include "batch/motion_lanes.hpp"
#include "cdcr/batch.hpp"
#include "loads/cable_force.hpp"
#include "statics/potential.hpp"

namespace cdcr {
namespace {

using detail::Quantity, detail::row;
using Arguments = std::initializer_list<detail::Argument>;
using Vector = Eigen::Map<VectorXd>;

/// A quantity of many states, of `size` numbers each.
void answer_in_lanes(const Model& model, Quantity quantity, Index count, Arguments arguments,
                     Index size, double* out) {
  const Index d = model.num_coordinates();
  detail::with_motion_lanes(model, [&](auto width, auto closed) {
    using Lanes = detail::MotionLanes<width.value, closed.value>;
    using P = typename Lanes::Scalar;
    Lanes lanes(model);
    std::vector<P> force(static_cast<std::size_t>(d));
    detail::in_packs<width.value, P>(count, arguments, {{out, size}}, [&](const P* in, P* found) {
      if (quantity != Quantity::acceleration) return lanes.answer(quantity, in, found);
      if constexpr (closed.value) {
        detail::single_actuation_force(model, in + 2 * d, force.data());
      } else {
        detail::actuation_force(model, in + 2 * d, force.data());
      }
      lanes.accelerate(in, in + d, force.data(), found);
    });
  });
}

/// The same, or f(i) of each state where that is better.
template <class F>
void answer(const Model& model, Quantity quantity, Index count, Arguments arguments, Index size,
            double* out, const F& f) {
  const bool by_tension = quantity == Quantity::acceleration;
  if (count > 1 && !model.has_rods() && (!by_tension || model.has_plain_cables())) {
    return answer_in_lanes(model, quantity, count, arguments, size, out);
  }
  for (Index i = 0; i < count; ++i) f(i);
}

}  // namespace

void forward_dynamics(const Model& model, Data& data, Index count, const StateRows& q,
                      const StateRows& qd, const StateRows& tension, double* qdd) {
  const Index d = model.num_coordinates(), cables = model.num_cables();
  answer(model, Quantity::acceleration, count, {{q, d}, {qd, d}, {tension, cables}}, d, qdd,
         [&](Index i) {
           forward_dynamics(model, data, row(q, i, d), row(qd, i, d), row(tension, i, cables),
                            Vector(qdd + i * d, d));
         });
}

void inverse_dynamics(const Model& model, Data& data, Index count, const StateRows& q,
                      const StateRows& qd, const StateRows& qdd, double* force) {
  const Index d = model.num_coordinates();
  answer(model, Quantity::force, count, {{q, d}, {qd, d}, {qdd, d}}, d, force, [&](Index i) {
    inverse_dynamics(model, data, row(q, i, d), row(qd, i, d), row(qdd, i, d),
                     Vector(force + i * d, d));
  });
}

void bias(const Model& model, Data& data, Index count, const StateRows& q, const StateRows& qd,
          double* h) {
  const Index d = model.num_coordinates();
  answer(model, Quantity::bias, count, {{q, d}, {qd, d}}, d, h,
         [&](Index i) { bias(model, data, row(q, i, d), row(qd, i, d), Vector(h + i * d, d)); });
}

void mass_matrix(const Model& model, Data& data, Index count, const StateRows& q, double* M) {
  const Index d = model.num_coordinates(), size = d * d;
  answer(model, Quantity::mass_matrix, count, {{q, d}}, size, M, [&](Index i) {
    // Symmetric: its columns are its rows.
    mass_matrix(model, data, row(q, i, d), Eigen::Map<MatrixXd>(M + i * size, d, d));
  });
}

void kinetic_energy(const Model& model, Data& data, Index count, const StateRows& q,
                    const StateRows& qd, double* energy) {
  const Index d = model.num_coordinates();
  answer(model, Quantity::kinetic_energy, count, {{q, d}, {qd, d}}, 1, energy,
         [&](Index i) { energy[i] = kinetic_energy(model, data, row(q, i, d), row(qd, i, d)); });
}

void potential_energy(const Model& model, Data& data, Index count, const StateRows& q,
                      double* energy) {
  const Index d = model.num_coordinates();
  answer(model, Quantity::potential_energy, count, {{q, d}}, 1, energy,
         [&](Index i) { energy[i] = detail::energy_from_base(model, data.kept(), row(q, i, d)); });
  for (Index i = 0; i < count; ++i) energy[i] += model.base_energy();
}

void potential_gradient(const Model& model, Data& data, Index count, const StateRows& q,
                        double* gradient) {
  const Index d = model.num_coordinates();
  answer(model, Quantity::potential_gradient, count, {{q, d}}, d, gradient, [&](Index i) {
    potential_gradient(model, data, row(q, i, d), Vector(gradient + i * d, d));
  });
}

}  // namespace cdcr
