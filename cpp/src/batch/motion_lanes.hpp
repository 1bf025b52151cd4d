#pragma once

#include <type_traits>
#include <vector>

#include "base/lanes.hpp"
#include "batch/chain_lanes.hpp"
#include "batch/closed_form.hpp"
#include "dynamics/parts.hpp"

namespace cdcr::detail {

/// Whether states of a model may be worked on in lanes under commands of its cables: arcs, of which
/// Q = B F depends on the tensions alone.
[[nodiscard]] inline bool fits_lanes(const Model& model) noexcept {
  return !model.has_rods() && model.has_plain_cables();
}

/// What is asked of a state q: arguments one after another in `in`, the answer in `out`.
enum class Quantity {
  acceleration,        // qd, force
  force,               // qd, qdd
  bias,                // qd
  mass_matrix,         //
  kinetic_energy,      // qd
  potential_energy,    //
  potential_gradient,  //
};

/// Answers about some states of a robot of arcs, in registers of W, in closed form where that
/// applies: of twice as many then.
template <int W, bool closed>
class MotionLanes {
 public:
  using Scalar = std::conditional_t<closed, Twin<W>, Pack<W>>;

  explicit MotionLanes(const Model& model) : model_(model), chain_(chain_of(model)) {}

  // To be called where it is compiled for registers of this width.

  [[gnu::always_inline]] void accelerate(const Scalar* q, const Scalar* qd, const Scalar* force,
                                         Scalar* qdd) noexcept {
    if constexpr (closed) {
      closed_form::forward_dynamics(single_of(model_), q, qd, force, qdd);
    } else {
      chain_.accelerate(q, qd, force, qdd);
    }
  }

  [[gnu::always_inline]] void answer(Quantity quantity, const Scalar* in, Scalar* out) noexcept {
    const Index d = closed ? 2 : model_.num_coordinates();
    const Scalar *q = in, *qd = in + d, *next = in + 2 * d;
    switch (quantity) {
      case Quantity::acceleration:
        return accelerate(q, qd, next, out);
      case Quantity::force:
        return force(q, qd, next, out);
      case Quantity::bias:
        return force(q, qd, nullptr, out);
      default:
        break;
    }
    if constexpr (closed) {
      const SingleSection& section = single_of(model_);
      switch (quantity) {
        case Quantity::mass_matrix:
          closed_form::mass_matrix(section, q, out[0], out[1], out[3]);
          out[2] = out[1];
          return;
        case Quantity::kinetic_energy:
          return closed_form::kinetic_energy(section, q, qd, *out);
        case Quantity::potential_energy:
          return closed_form::potential_energy(section, q, *out);
        default:
          return closed_form::potential_gradient(section, q, out);
      }
    } else {
      switch (quantity) {
        case Quantity::mass_matrix:
          return chain_.mass_matrix(q, out);
        case Quantity::kinetic_energy:
          return chain_.kinetic_energy(q, qd, out);
        case Quantity::potential_energy:
          return chain_.potential_energy(q, out);
        default:
          return chain_.potential_gradient(q, out);
      }
    }
  }

 private:
  [[gnu::always_inline]] void force(const Scalar* q, const Scalar* qd, const Scalar* qdd,
                                    Scalar* out) noexcept {
    if constexpr (closed) {
      const SingleSection& section = single_of(model_);
      closed_form::bias(section, q, qd, out);
      if (qdd == nullptr) return;
      Scalar M_xx, M_xy, M_yy;
      closed_form::mass_matrix(section, q, M_xx, M_xy, M_yy);
      out[0] += M_xx * qdd[0] + M_xy * qdd[1];
      out[1] += M_xy * qdd[0] + M_yy * qdd[1];
    } else {
      chain_.inverse_dynamics(q, qd, qdd, out);
    }
  }

  const Model& model_;
  ChainLanes<W> chain_;
};

/// f(width, closed) of the width of this processor, both std::integral_constant.
template <class F>
auto with_motion_lanes(const Model& model, const F& f, int lanes = num_lanes) {
  return with_lanes(
      [&](auto width) {
        return model.has_closed_form() ? f(width, std::true_type()) : f(width, std::false_type());
      },
      lanes);
}

}  // namespace cdcr::detail
