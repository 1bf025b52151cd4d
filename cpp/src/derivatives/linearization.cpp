#include "cdcr/linearization.hpp"

#include "base/sizes.hpp"
#include "cdcr/dynamics.hpp"
#include "dynamics/kept.hpp"
#include "loads/cable_force.hpp"
#include "loads/force_derivatives.hpp"
#include "loads/wrench_force.hpp"

namespace cdcr {
namespace {

/// Derivatives of the accelerations, the last two where they are wanted.
struct Slopes {
  MatrixRef on_q, on_qd;
  MatrixRef* on_command = nullptr;
  MatrixRef* on_wrenches = nullptr;
  const ConstVectorRef* added = nullptr;  ///< to the generalised force
};

/// The rows of A that say d(q)/dt = qd.
void set_upper_rows(Index m, MatrixRef A) noexcept {
  A.topLeftCorner(m, m).setZero();
  A.topRightCorner(m, m).setIdentity();
}

[[maybe_unused]] bool fit(const Model& model, const Data& data, const ConstVectorRef& q,
                          const ConstVectorRef& qd, const ConstVectorRef& command,
                          const Wrenches& wrenches) noexcept {
  return data.belongs_to(model) && detail::of_coordinates(model, q, qd) &&
         detail::of_cables(model, command) && check_wrenches(model, wrenches) == Status::ok;
}

/// Columns of the generalised force by force and moment of each wrench, which `solve` divides by
/// the mass.
template <class Solve>
void differentiate_by_wrenches(const Model& model, const ConstVectorRef& q,
                               const Wrenches& wrenches, MatrixRef columns,
                               const Solve& solve) noexcept {
  columns.setZero();
  for (std::size_t i = 0; i < wrenches.size(); ++i) {
    for (int k = 0; k < 6; ++k) {
      Wrench unit = wrenches[i];
      unit.force = k < 3 ? Vector3d(Vector3d::Unit(k)) : Vector3d(Vector3d::Zero());
      unit.moment = k < 3 ? Vector3d(Vector3d::Zero()) : Vector3d(Vector3d::Unit(k - 3));
      auto column = columns.col(6 * static_cast<Index>(i) + k);
      detail::add_wrench_force(detail::chain_of(model), q.data(), unit, column.data());
      solve(column);
    }
  }
}

/// Adds to the slopes of one section those of cables whose force changes with the state.
void add_cable_slopes(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& command,
                      const Eigen::Matrix2d& inverse_mass, Slopes out) noexcept {
  const auto add = [&](auto& /*chain*/, auto& /*state*/, auto& derivatives) {
    const detail::LaneMap& lanes = derivatives.lanes;
    derivatives.clear();
    add_force_derivatives(model, data.kept()->force_duals, q, qd, command, no_wrenches(), lanes,
                          derivatives.rows.data());
    const auto column = [&](Index lane) {
      return Eigen::Vector2d(inverse_mass *
                             Eigen::Vector2d(derivatives(0, lane), derivatives(1, lane)));
    };
    for (Index k = 0; k < 2; ++k) {
      out.on_q.col(k) += column(lanes.on_q(k));
      out.on_qd.col(k) += column(lanes.on_qd(k));
    }
    for (Index j = 0; out.on_command != nullptr && j < command.size(); ++j) {
      out.on_command->col(j) = column(lanes.on_command(j));
    }
  };
  data.kept()->with_derivatives(model, add, q.data());
}

/// Of one section in closed form.
void differentiate_closed_form(const Model& model, Data& data, const ConstVectorRef& q,
                               const ConstVectorRef& qd, const ConstVectorRef& command,
                               const Wrenches& wrenches, Slopes out) noexcept {
  if (force_is_constant(model, wrenches)) {
    detail::single_actuation_force(model, command.data(), data.force.data());
  } else {
    total_force(model, q, qd, command, wrenches, data.force);
  }
  if (out.added != nullptr) data.force += *out.added;
  const Eigen::Matrix2d inverse = detail::closed_form::acceleration_jacobians(
      detail::single_of(model), q, qd, data.force.data(), out.on_q, out.on_qd);
  if (!model.has_plain_cables()) {
    add_cable_slopes(model, data, q, qd, command, inverse, out);
  } else if (out.on_command != nullptr) {
    *out.on_command = inverse.lazyProduct(model.actuation_matrix().topRows<2>());
  }
  if (wrenches.empty()) return;
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();
  detail::subtract_wrench_stiffness(model, q, wrenches, stiffness);
  out.on_q -= inverse.lazyProduct(stiffness);
  if (out.on_wrenches == nullptr) return;
  differentiate_by_wrenches(model, q, wrenches, *out.on_wrenches, [&](auto column) {
    column = Eigen::Vector2d(inverse * Eigen::Vector2d(column[0], column[1]));
  });
}

/// Of any robot.
void differentiate_motion(const Model& model, Data& data, const ConstVectorRef& q,
                          const ConstVectorRef& qd, const ConstVectorRef& command,
                          const Wrenches& wrenches, Slopes out) noexcept {
  if (model.has_closed_form()) {
    return differentiate_closed_form(model, data, q, qd, command, wrenches, out);
  }
  total_force(model, q, qd, command, wrenches, data.force);
  if (out.added != nullptr) data.force += *out.added;
  data.kept()->with_derivatives(
      model,
      [&](auto& chain, auto& state, auto& derivatives) {
        const detail::LaneMap& lanes = derivatives.lanes;
        derivatives.update(chain, state, q.data(), qd.data(), data.force.data());
        add_force_derivatives(model, data.kept()->force_duals, q, qd, command, wrenches, lanes,
                              derivatives.rows.data());
        derivatives.solve(out.on_command != nullptr ? lanes.width() : lanes.num_state_quads());
        for (Index k = 0; k < q.size(); ++k) {
          for (Index i = 0; i < q.size(); ++i) {
            out.on_q(i, k) = derivatives(i, lanes.on_q(k));
            out.on_qd(i, k) = derivatives(i, lanes.on_qd(k));
          }
        }
        for (Index j = 0; out.on_command != nullptr && j < command.size(); ++j) {
          for (Index i = 0; i < q.size(); ++i) {
            (*out.on_command)(i, j) = derivatives(i, lanes.on_command(j));
          }
        }
        if (out.on_wrenches == nullptr) return;
        differentiate_by_wrenches(model, q, wrenches, *out.on_wrenches,
                                  [&](auto column) { derivatives.solve(column.data()); });
      },
      q.data(), qd.data());
}

}  // namespace

void state_jacobian(const Model& model, Data& data, const ConstVectorRef& q,
                    const ConstVectorRef& qd, const ConstVectorRef& command,
                    const Wrenches& wrenches, MatrixRef A) noexcept {
  const Index m = model.num_coordinates();
  assert(fit(model, data, q, qd, command, wrenches) && detail::has_size(A, 2 * m, 2 * m));
  set_upper_rows(m, A);
  differentiate_motion(model, data, q, qd, command, wrenches,
                       {A.bottomLeftCorner(m, m), A.bottomRightCorner(m, m)});
}

void state_jacobian_force(const Model& model, Data& data, const ConstVectorRef& q,
                          const ConstVectorRef& qd, const ConstVectorRef& command,
                          const Wrenches& wrenches, const ConstVectorRef& added,
                          MatrixRef A) noexcept {
  const Index m = model.num_coordinates();
  assert(fit(model, data, q, qd, command, wrenches) && detail::has_size(A, 2 * m, 2 * m));
  assert(detail::of_coordinates(model, added));
  set_upper_rows(m, A);
  differentiate_motion(
      model, data, q, qd, command, wrenches,
      {A.bottomLeftCorner(m, m), A.bottomRightCorner(m, m), nullptr, nullptr, &added});
}

void linearize(const Model& model, Data& data, const ConstVectorRef& q, const ConstVectorRef& qd,
               const ConstVectorRef& command, const Wrenches& wrenches, MatrixRef A,
               MatrixRef B) noexcept {
  const Index m = model.num_coordinates();
  assert(fit(model, data, q, qd, command, wrenches) && detail::has_size(A, 2 * m, 2 * m));
  assert(detail::has_size(B, 2 * m, model.num_cables()));
  set_upper_rows(m, A);
  B.topRows(m).setZero();
  MatrixRef on_command = B.middleRows(B.cols() > 0 ? m : 0, m);  // without cables it has no data
  differentiate_motion(model, data, q, qd, command, wrenches,
                       {A.bottomLeftCorner(m, m), A.bottomRightCorner(m, m), &on_command});
}

void linearize(const Model& model, Data& data, const ConstVectorRef& q, const ConstVectorRef& qd,
               const ConstVectorRef& command, MatrixRef A, MatrixRef B) noexcept {
  linearize(model, data, q, qd, command, no_wrenches(), A, B);
}

void acceleration_derivatives(const Model& model, Data& data, const ConstVectorRef& q,
                              const ConstVectorRef& qd, const ConstVectorRef& command,
                              const Wrenches& wrenches, MatrixRef on_q, MatrixRef on_qd,
                              MatrixRef on_command, MatrixRef on_wrenches) noexcept {
  [[maybe_unused]] const Index m = model.num_coordinates();
  assert(fit(model, data, q, qd, command, wrenches) && detail::has_size(on_q, m, m));
  assert(detail::has_size(on_qd, m, m) && detail::has_size(on_command, m, model.num_cables()));
  assert(detail::has_size(on_wrenches, m, 6 * static_cast<Index>(wrenches.size())));
  differentiate_motion(model, data, q, qd, command, wrenches,
                       {on_q, on_qd, &on_command, &on_wrenches});
}

}  // namespace cdcr
