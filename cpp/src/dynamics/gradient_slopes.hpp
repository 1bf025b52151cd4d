#pragma once

#include <optional>

#include "chain/dual.hpp"
#include "chain/gradient.hpp"
#include "dynamics/parts.hpp"

namespace cdcr::detail {

/// Derivatives (d, d) of dU/dq, and of what add_more(const Dual* q, Dual* gradient) adds to it.
/// `rods` has room for a robot of rods.
template <class AddMore>
void gradient_slopes(const Model& model, std::optional<RodChainState<Dual>>& rods,
                     const ConstVectorRef& q, MatrixRef slopes, const AddMore& add_more) noexcept {
  const Chain& chain = chain_of(model);
  const auto m = static_cast<int>(model.num_coordinates());
  const auto differentiate_with = [&](auto& state) {
    differentiate(m, m, q.data(), slopes, [&](const Dual* x, Dual* y) {
      state.update_position(chain, x);
      potential_gradient(chain, state, x, y);
      add_more(x, y);
    });
  };
  if (chain.has_rods()) {
    differentiate_with(*rods);  // NOLINT(bugprone-unchecked-optional-access): has room
  } else {
    ArcChainState<Dual> state;
    differentiate_with(state);
  }
}

}  // namespace cdcr::detail
