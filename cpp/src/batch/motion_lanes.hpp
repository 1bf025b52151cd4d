#pragma once

#include <type_traits>
#include <vector>

#include "batch/chain_lanes.hpp"
#include "batch/lanes.hpp"
#include "dynamics/parts.hpp"

namespace cdcr::detail {

/// Whether states of a model may be worked on in lanes under commands of its cables: arcs, of which
/// Q = B F depends on the tensions alone.
[[nodiscard]] inline bool fits_lanes(const Model& model) noexcept {
  return !model.has_rods() && model.has_plain_cables();
}

/// Accelerations of some states of such a model, in registers of W, in closed form where that
/// applies: of twice as many then.
template <int W, bool closed>
class MotionLanes {
 public:
  using Scalar = std::conditional_t<closed, Twin<W>, Pack<W>>;

  explicit MotionLanes(const Model& model) : model_(model), chain_(chain_of(model)) {}

  /// To be called where it is compiled for registers of this width.
  [[gnu::always_inline]] void accelerate(const Scalar* q, const Scalar* qd, const Scalar* force,
                                         Scalar* qdd) noexcept {
    if constexpr (closed) {
      closed_form::forward_dynamics(single_of(model_), q, qd, force, qdd);
    } else {
      chain_.accelerate(q, qd, force, qdd);
    }
  }

 private:
  const Model& model_;
  ChainLanes<W> chain_;
};

/// f(width, closed) of the width of this processor, both std::integral_constant.
template <class F>
auto with_motion_lanes(const Model& model, const F& f, [[maybe_unused]] int lanes = num_lanes) {
  const auto of_width = [&](auto width) {
    return model.has_closed_form() ? f(width, std::true_type()) : f(width, std::false_type());
  };
#if defined(__x86_64__)
  if (lanes == 4) return of_width(std::integral_constant<int, 4>());
#endif
  return of_width(std::integral_constant<int, 2>());
}

}  // namespace cdcr::detail
