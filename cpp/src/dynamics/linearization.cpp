#include "cdcr/linearization.hpp"

#include "base/sizes.hpp"
#include "cdcr/dynamics.hpp"
#include "chain/dual.hpp"
#include "chain/forward.hpp"
#include "dynamics/kept.hpp"
#include "loads/cable_force.hpp"
#include "loads/total_force.hpp"

namespace cdcr {
namespace {

using detail::Dual;

// 16 cables at most end on each section, and a robot has at most 64 beside those.
constexpr int max_commands = 16 * max_sections + 64;

/// The rows of A that say d(q)/dt = qd.
void set_upper_rows(Index m, MatrixRef A) noexcept {
  A.topLeftCorner(m, m).setZero();
  A.topRightCorner(m, m).setIdentity();
}

[[maybe_unused]] bool fit(const Model& model, const Data& data, const ConstVectorRef& q,
                          const ConstVectorRef& qd, const ConstVectorRef& command,
                          const Wrenches& wrenches, const MatrixRef& A) noexcept {
  return data.belongs_to(model) && detail::has_size(A, 2 * q.size(), 2 * q.size()) &&
         detail::of_coordinates(model, q, qd) && detail::of_cables(model, command) &&
         check_wrenches(model, wrenches) == Status::ok;
}

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
  const detail::Chain& chain = detail::chain_of(model);
  for (int i = 0; i < m; ++i) {
    x[i] = Dual(q[i]);
    x[m + i] = Dual(qd[i]);
  }
  for (int j = 0; j < cables; ++j) commands[j] = Dual(command[j]);
  const auto sweep = [&](Dual* inputs, int num_inputs, MatrixRef out) {
    for (int first = 0; first < num_inputs; first += detail::dual_width) {
      const int count = std::min(detail::dual_width, num_inputs - first);
      for (int k = 0; k < count; ++k) inputs[first + k].derivatives()[k] = 1.0;
      detail::total_force<Dual>(model, x, x + m, commands, wrenches, force);
      state.update_position(chain, x);
      state.update_velocity(chain, x + m);
      detail::forward_dynamics(chain, state, static_cast<const Dual*>(force), qdd);
      for (int i = 0; i < m; ++i) {
        out.row(i).segment(first, count) = qdd[i].derivatives().head(count).transpose();
      }
      for (int k = 0; k < count; ++k) inputs[first + k].derivatives().setZero();
    }
  };
  sweep(x, 2 * m, A.bottomRows(m));
  if (B != nullptr) sweep(commands, cables, B->bottomRows(m));
}

/// The same with the room of either kind of section.
void differentiate_motion(const Model& model, Data& data, const ConstVectorRef& q,
                          const ConstVectorRef& qd, const ConstVectorRef& command,
                          const Wrenches& wrenches, MatrixRef A, MatrixRef* B) noexcept {
  if (model.has_rods()) {
    return differentiate_motion(model, *data.kept()->dual_rods, q, qd, command, wrenches, A, B);
  }
  detail::ArcChainState<Dual> state;
  differentiate_motion(model, state, q, qd, command, wrenches, A, B);
}

/// The lower rows of A, and M^-1, of one section under a constant force.
Eigen::Matrix2d differentiate_closed_form(const Model& model, const ConstVectorRef& q,
                                          const ConstVectorRef& qd, const ConstVectorRef& command,
                                          MatrixRef A) noexcept {
  double force[2];
  detail::single_actuation_force(model, command.data(), force);
  return detail::closed_form::acceleration_jacobians(
      detail::single_of(model), q, qd, force, A.bottomLeftCorner(2, 2), A.bottomRightCorner(2, 2));
}

}  // namespace

void state_jacobian(const Model& model, Data& data, const ConstVectorRef& q,
                    const ConstVectorRef& qd, const ConstVectorRef& command,
                    const Wrenches& wrenches, MatrixRef A) noexcept {
  const Index m = model.num_coordinates();
  assert(fit(model, data, q, qd, command, wrenches, A));
  set_upper_rows(m, A);
  if (model.has_closed_form() && force_is_constant(model, wrenches)) {
    differentiate_closed_form(model, q, qd, command, A);
    return;
  }
  differentiate_motion(model, data, q, qd, command, wrenches, A, nullptr);
}

void linearize(const Model& model, Data& data, const ConstVectorRef& q, const ConstVectorRef& qd,
               const ConstVectorRef& command, const Wrenches& wrenches, MatrixRef A,
               MatrixRef B) noexcept {
  const Index m = model.num_coordinates();
  assert(fit(model, data, q, qd, command, wrenches, A));
  assert(detail::has_size(B, 2 * m, model.num_cables()));
  if (model.num_cables() == 0) return state_jacobian(model, data, q, qd, command, wrenches, A);
  B.topRows(m).setZero();
  set_upper_rows(m, A);
  if (model.has_closed_form() && force_is_constant(model, wrenches)) {
    const Eigen::Matrix2d inverse = differentiate_closed_form(model, q, qd, command, A);
    B.bottomRows<2>() = inverse.lazyProduct(model.actuation_matrix().topRows<2>());
    return;
  }
  differentiate_motion(model, data, q, qd, command, wrenches, A, &B);
}

void linearize(const Model& model, Data& data, const ConstVectorRef& q, const ConstVectorRef& qd,
               const ConstVectorRef& command, MatrixRef A, MatrixRef B) noexcept {
  linearize(model, data, q, qd, command, no_wrenches(), A, B);
}

}  // namespace cdcr
