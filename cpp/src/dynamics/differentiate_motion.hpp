#pragma once

#include "chain/dual.hpp"
#include "chain/forward.hpp"
#include "loads/cable_force.hpp"
#include "loads/total_force.hpp"

namespace cdcr::detail {

// 16 cables at most end on each section, and a robot has at most 64 beside those.
inline constexpr int max_commands = 16 * max_sections + 64;

/// Rows d(qdd)/d(q, qd) of A, and d(qdd)/d(command) where B is wanted, under all forces; the state
/// is room for dual numbers.
template <class State>
void differentiate_motion(const Model& model, State& state, const ConstVectorRef& q,
                          const ConstVectorRef& qd, const ConstVectorRef& command,
                          const Wrenches& wrenches, MatrixRef A, MatrixRef* B) noexcept {
  const auto m = static_cast<int>(model.num_coordinates());
  const auto cables = static_cast<int>(model.num_cables());
  Dual x[2 * max_coordinates], qdd[max_coordinates], force[max_coordinates];
  Dual commands[max_commands];
  const Chain& chain = chain_of(model);
  for (int i = 0; i < m; ++i) {
    x[i] = Dual(q[i]);
    x[m + i] = Dual(qd[i]);
  }
  for (int j = 0; j < cables; ++j) commands[j] = Dual(command[j]);
  const auto sweep = [&](Dual* inputs, int num_inputs, MatrixRef out) {
    for (int first = 0; first < num_inputs; first += dual_width) {
      const int count = std::min(dual_width, num_inputs - first);
      for (int k = 0; k < count; ++k) inputs[first + k].derivatives()[k] = 1.0;
      total_force<Dual>(model, x, x + m, commands, wrenches, force);
      state.update_position(chain, x);
      state.update_velocity(chain, x + m);
      forward_dynamics(chain, state, static_cast<const Dual*>(force), qdd);
      for (int i = 0; i < m; ++i) {
        out.row(i).segment(first, count) = qdd[i].derivatives().head(count).transpose();
      }
      for (int k = 0; k < count; ++k) inputs[first + k].derivatives().setZero();
    }
  };
  sweep(x, 2 * m, A.bottomRows(m));
  if (B != nullptr) sweep(commands, cables, B->bottomRows(m));
}

extern template void differentiate_motion(const Model&, RodChainState<Dual>&, const ConstVectorRef&,
                                          const ConstVectorRef&, const ConstVectorRef&,
                                          const Wrenches&, MatrixRef, MatrixRef*) noexcept;

}  // namespace cdcr::detail
