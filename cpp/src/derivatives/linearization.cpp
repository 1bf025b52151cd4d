#include "derivatives/linearization.hpp"

#include "base/sizes.hpp"
#include "cdcr/dynamics.hpp"
#include "dynamics/kept.hpp"
#include "loads/cable_force.hpp"
#include "loads/force_derivatives.hpp"
#include "loads/wrench_force.hpp"

namespace cdcr {
namespace {

using detail::AnyMatrix, detail::AccelerationSlopes;

/// The rows of A that say d(q)/dt = qd.
void set_upper_rows(Index m, MatrixRef A) noexcept {
  A.topLeftCorner(m, m).setZero();
  A.topRightCorner(m, m).setIdentity();
}

AccelerationSlopes lower_rows(Index m, MatrixRef A) noexcept {
  return {detail::by_columns(A.bottomLeftCorner(m, m)),
          detail::by_columns(A.bottomRightCorner(m, m))};
}

[[maybe_unused]] bool fit(const Model& model, const Data& data, const ConstVectorRef& q,
                          const ConstVectorRef& qd, const ConstVectorRef& command,
                          const Wrenches& wrenches) noexcept {
  return data.belongs_to(model) && detail::of_coordinates(model, q, qd) &&
         detail::of_cables(model, command) && check_wrenches(model, wrenches) == Status::ok;
}

/// By force and moment of each wrench: columns of the generalised force, which `solve` divides by
/// the mass.
template <class Solve>
void differentiate_by_wrenches(const Model& model, Data& data, const ConstVectorRef& q,
                               const Wrenches& wrenches, AnyMatrix out,
                               const Solve& solve) noexcept {
  VectorXd& column = data.force;
  for (std::size_t i = 0; i < wrenches.size(); ++i) {
    for (int k = 0; k < 6; ++k) {
      Wrench unit = wrenches[i];
      unit.force = k < 3 ? Vector3d(Vector3d::Unit(k)) : Vector3d(Vector3d::Zero());
      unit.moment = k < 3 ? Vector3d(Vector3d::Zero()) : Vector3d(Vector3d::Unit(k - 3));
      column.setZero();
      detail::add_wrench_force(detail::chain_of(model), q.data(), unit, column.data());
      solve(column);
      out.col(6 * static_cast<Index>(i) + k) = column;
    }
  }
}

/// Adds to the slopes of one section those of cables whose force changes with the state.
void add_cable_slopes(const Model& model, Data& data, const ConstVectorRef& q,
                      const ConstVectorRef& qd, const ConstVectorRef& command,
                      const Eigen::Matrix2d& inverse_mass, AccelerationSlopes out) noexcept {
  const auto add = [&](auto& /*chain*/, auto& /*state*/, auto& derivatives) {
    const detail::LaneMap& lanes = derivatives.lanes;
    derivatives.clear();
    add_force_derivatives(model, data.kept()->force_duals, q, qd, command, no_wrenches(), lanes,
                          derivatives.rows.data());
    const auto column = [&](Index lane) {
      return Eigen::Vector2d(inverse_mass *
                             Eigen::Vector2d(derivatives.row(0)[lane], derivatives.row(1)[lane]));
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
                               const Wrenches& wrenches, AccelerationSlopes out) noexcept {
  if (force_is_constant(model, wrenches)) {
    detail::single_actuation_force(model, command.data(), data.force.data());
  } else {
    total_force(model, q, qd, command, wrenches, data.force);
  }
  if (out.added != nullptr) data.force += *out.added;
  Eigen::Matrix2d on_q, on_qd;
  const Eigen::Matrix2d inverse = detail::closed_form::acceleration_jacobians(
      detail::single_of(model), q, qd, data.force.data(), on_q, on_qd);
  out.on_q = on_q;
  out.on_qd = on_qd;
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
  differentiate_by_wrenches(model, data, q, wrenches, *out.on_wrenches, [&](VectorXd& column) {
    column = Eigen::Vector2d(inverse * column.head<2>());
  });
}

/// Derivatives that stand in lanes: column k in that of lane_of(k).
template <class Derivatives, class LaneOf>
void read_out(const Derivatives& derivatives, const LaneOf& lane_of, AnyMatrix out) noexcept {
  const auto copy = [&](Index i, Index k) { out(i, k) = derivatives.row(i)[lane_of(k)]; };
  if (out.innerStride() == 1) {
    for (Index k = 0; k < out.cols(); ++k) {
      for (Index i = 0; i < out.rows(); ++i) copy(i, k);
    }
  } else {
    for (Index i = 0; i < out.rows(); ++i) {
      for (Index k = 0; k < out.cols(); ++k) copy(i, k);
    }
  }
}

}  // namespace

void detail::differentiate_motion(const Model& model, Data& data, const ConstVectorRef& q,
                                  const ConstVectorRef& qd, const ConstVectorRef& command,
                                  const Wrenches& wrenches, AccelerationSlopes out) noexcept {
  assert(fit(model, data, q, qd, command, wrenches));
  if (model.has_closed_form()) {
    return differentiate_closed_form(model, data, q, qd, command, wrenches, out);
  }
  total_force(model, q, qd, command, wrenches, data.force);
  if (out.added != nullptr) data.force += *out.added;
  data.kept()->with_derivatives(
      model,
      [&](auto& chain, auto& state, auto& derivatives) {
        const LaneMap& lanes = derivatives.lanes;
        derivatives.update(chain, state, q.data(), qd.data(), data.force.data());
        add_force_derivatives(model, data.kept()->force_duals, q, qd, command, wrenches, lanes,
                              derivatives.rows.data());
        derivatives.solve(out.on_command != nullptr ? lanes.width() : lanes.num_state_quads());
        read_out(derivatives, [&](Index k) { return lanes.on_q(k); }, out.on_q);
        read_out(derivatives, [&](Index k) { return lanes.on_qd(k); }, out.on_qd);
        if (out.on_command != nullptr) {
          read_out(derivatives, [&](Index k) { return lanes.on_command(k); }, *out.on_command);
        }
        if (out.on_wrenches == nullptr) return;
        differentiate_by_wrenches(model, data, q, wrenches, *out.on_wrenches,
                                  [&](VectorXd& column) { derivatives.solve(column.data()); });
      },
      q.data(), qd.data());
}

void state_jacobian(const Model& model, Data& data, const ConstVectorRef& q,
                    const ConstVectorRef& qd, const ConstVectorRef& command,
                    const Wrenches& wrenches, MatrixRef A) noexcept {
  const Index m = model.num_coordinates();
  assert(detail::has_size(A, 2 * m, 2 * m));
  set_upper_rows(m, A);
  detail::differentiate_motion(model, data, q, qd, command, wrenches, lower_rows(m, A));
}

void state_jacobian_force(const Model& model, Data& data, const ConstVectorRef& q,
                          const ConstVectorRef& qd, const ConstVectorRef& command,
                          const Wrenches& wrenches, const ConstVectorRef& added,
                          MatrixRef A) noexcept {
  const Index m = model.num_coordinates();
  assert(detail::has_size(A, 2 * m, 2 * m) && detail::of_coordinates(model, added));
  set_upper_rows(m, A);
  AccelerationSlopes slopes = lower_rows(m, A);
  slopes.added = &added;
  detail::differentiate_motion(model, data, q, qd, command, wrenches, slopes);
}

void linearize(const Model& model, Data& data, const ConstVectorRef& q, const ConstVectorRef& qd,
               const ConstVectorRef& command, const Wrenches& wrenches, MatrixRef A,
               MatrixRef B) noexcept {
  const Index m = model.num_coordinates();
  assert(detail::has_size(A, 2 * m, 2 * m) && detail::has_size(B, 2 * m, model.num_cables()));
  set_upper_rows(m, A);
  B.topRows(m).setZero();
  // Without cables it has no data.
  AnyMatrix on_command = detail::by_columns(B.middleRows(B.cols() > 0 ? m : 0, m));
  AccelerationSlopes slopes = lower_rows(m, A);
  slopes.on_command = &on_command;
  detail::differentiate_motion(model, data, q, qd, command, wrenches, slopes);
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
  assert(detail::has_size(on_q, m, m) && detail::has_size(on_qd, m, m));
  assert(detail::has_size(on_command, m, model.num_cables()));
  assert(detail::has_size(on_wrenches, m, 6 * static_cast<Index>(wrenches.size())));
  AnyMatrix command_slopes = detail::by_columns(on_command),
            wrench_slopes = detail::by_columns(on_wrenches);
  detail::differentiate_motion(
      model, data, q, qd, command, wrenches,
      {detail::by_columns(on_q), detail::by_columns(on_qd), &command_slopes, &wrench_slopes});
}

}  // namespace cdcr
