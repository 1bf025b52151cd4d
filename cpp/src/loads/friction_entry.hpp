#pragma once

#include <cmath>

#include "cdcr/model.hpp"

namespace cdcr::detail {

/// Tension that is left within the entry of a cable pulled in at a speed [m/s], by the law without
/// memory, eq. (105).
template <class S>
[[nodiscard]] S entry_tension(const Model& model, Index j, const S& tension, const S& speed) {
  const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
  if (!(cable.entry_friction > 0.0 || cable.sheath_friction > 0.0 || cable.viscosity > 0.0)) {
    return tension;
  }
  using std::exp;
  using std::tanh;
  const S way = tanh(S(speed * (1.0 / model.robot().sliding_speed)));
  const S left = tension - cable.entry_friction * way;
  if (left < 0.0) return S(0.0);  // at 0 a cable paid out is dragged, as it is just above
  const S within = left * exp(S(-cable.sheath_friction * way)) - cable.viscosity * speed;
  return within > 0.0 ? within : S(0.0);
}

}  // namespace cdcr::detail
