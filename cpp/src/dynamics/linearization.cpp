#include "cdcr/linearization.hpp"

#include "base/sizes.hpp"
#include "cdcr/dynamics.hpp"
#include "dynamics/kept.hpp"
#include "loads/cable_force.hpp"
#include "loads/force_derivatives.hpp"

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

/// Rows of A that are d(qdd)/d(q, qd), and of B where it is wanted, under all forces.
void differentiate_motion(const Model& model, Data& data, const ConstVectorRef& q,
                          const ConstVectorRef& qd, const ConstVectorRef& command,
                          const Wrenches& wrenches, MatrixRef A, MatrixRef* B) noexcept {
  total_force(model, q, qd, command, wrenches, data.force);
  detail::ForceDuals& duals = data.kept()->force_duals;
  data.kept()->with_derivatives(
      model,
      [&](auto& chain, auto& state, auto& derivatives) {
        const detail::LaneMap& lanes = derivatives.lanes;
        derivatives.update(chain, state, q.data(), qd.data(), data.force.data());
        add_force_derivatives(model, duals, q, qd, command, wrenches, lanes,
                              derivatives.rows.data());
        derivatives.solve(B != nullptr ? lanes.width() : lanes.num_state_quads());
        const Index m = q.size();
        for (Index k = 0; k < m; ++k) {
          for (Index i = 0; i < m; ++i) {
            A(m + i, k) = derivatives(i, lanes.on_q(k));
            A(m + i, m + k) = derivatives(i, lanes.on_qd(k));
          }
        }
        for (Index j = 0; B != nullptr && j < command.size(); ++j) {
          for (Index i = 0; i < m; ++i) (*B)(m + i, j) = derivatives(i, lanes.on_command(j));
        }
      },
      q.data(), qd.data());
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
