#include "cdcr/linearization.hpp"

#include "base/sizes.hpp"
#include "cdcr/dynamics.hpp"
#include "dynamics/differentiate_motion.hpp"
#include "dynamics/kept.hpp"

namespace cdcr {
namespace {

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

/// The same with the room of either kind of section.
void differentiate_motion(const Model& model, Data& data, const ConstVectorRef& q,
                          const ConstVectorRef& qd, const ConstVectorRef& command,
                          const Wrenches& wrenches, MatrixRef A, MatrixRef* B) noexcept {
  if (model.has_rods()) {
    // NOLINTNEXTLINE(bugprone-unchecked-optional-access): has room
    return detail::differentiate_motion(model, *data.kept()->dual_rods, q, qd, command, wrenches, A,
                                        B);
  }
  detail::ArcChainState<detail::Dual> state;
  detail::differentiate_motion(model, state, q, qd, command, wrenches, A, B);
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
