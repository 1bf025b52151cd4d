#include "batch/chain_lanes.hpp"
#include "batch/in_packs.hpp"
#include "cdcr/batch.hpp"
#include "dynamics/parts.hpp"

namespace cdcr {
namespace {

using detail::row;

/// f(lanes, in, out) of many positions of arcs.
template <class F>
void answer_in_lanes(const Model& model, Index count, const StateRows& q,
                     std::initializer_list<detail::Answer> answers, const F& f) {
  detail::with_lanes([&](auto width) {
    using P = detail::Pack<width.value>;
    detail::ChainLanes<width.value> lanes(detail::chain_of(model));
    detail::in_packs<width.value, P>(count, {{q, model.num_coordinates()}}, answers,
                                     [&](const P* in, P* out) { f(lanes, in, out); });
  });
}

[[nodiscard]] detail::Place tip_of(const Model& model) {
  const Transform& tool = model.robot().tool;
  return {model.num_sections() - 1, 1.0, tool.topRightCorner<3, 1>(), tool.topLeftCorner<3, 3>()};
}

[[nodiscard]] bool fits_lanes(const Model& model, Index count) noexcept {
  return count > 1 && !model.has_rods();
}

void poses_in_lanes(const Model& model, Index count, const StateRows& q, const detail::Place& place,
                    double* R, double* p) {
  answer_in_lanes(model, count, q, {{R, 9}, {p, 3}}, [&](auto& lanes, const auto* in, auto* out) {
    lanes.pose(in, place, out, out + 9);
    for (int k = 0; k < 3; ++k) out[9 + k] += model.robot().base_position[k];
  });
}

void jacobians_in_lanes(const Model& model, Index count, const StateRows& q,
                        const detail::Place& place, double* J) {
  const Index size = 6 * model.num_coordinates();
  answer_in_lanes(model, count, q, {{J, size}},
                  [&](auto& lanes, const auto* in, auto* out) { lanes.jacobian(in, place, out); });
}

/// of(q) of each.
template <class F>
void poses_one_by_one(const Model& model, Index count, const StateRows& q, double* R, double* p,
                      const F& of) {
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  for (Index i = 0; i < count; ++i) {
    const Pose pose = of(row(q, i, model.num_coordinates()));
    if (R != nullptr) Eigen::Map<Rows>(R + 9 * i) = pose.R;
    if (p != nullptr) Eigen::Map<Vector3d>(p + 3 * i) = pose.p;
  }
}

/// write(q, J) of each.
template <class F>
void jacobians_one_by_one(const Model& model, Index count, const StateRows& q, double* J,
                          const F& write) {
  const Index d = model.num_coordinates();
  MatrixXd columns(6, d);
  for (Index i = 0; i < count; ++i) {
    write(row(q, i, d), columns);
    Eigen::Map<RowMatrixXd>(J + i * 6 * d, 6, d) = columns;
  }
}

}  // namespace

void pose(const Model& model, Index count, const StateRows& q, Index section, double fraction,
          double* R, double* p) {
  if (fits_lanes(model, count)) {
    return poses_in_lanes(model, count, q, {section, fraction}, R, p);
  }
  poses_one_by_one(model, count, q, R, p,
                   [&](const auto& x) { return pose(model, x, section, fraction); });
}

void tip(const Model& model, Index count, const StateRows& q, double* R, double* p) {
  if (fits_lanes(model, count)) return poses_in_lanes(model, count, q, tip_of(model), R, p);
  poses_one_by_one(model, count, q, R, p, [&](const auto& x) { return tip(model, x); });
}

void jacobian(const Model& model, Index count, const StateRows& q, Index section, double fraction,
              double* J) {
  if (fits_lanes(model, count)) {
    return jacobians_in_lanes(model, count, q, {section, fraction}, J);
  }
  jacobians_one_by_one(model, count, q, J, [&](const auto& x, MatrixRef columns) {
    jacobian(model, x, section, fraction, columns);
  });
}

void tip_jacobian(const Model& model, Index count, const StateRows& q, double* J) {
  if (fits_lanes(model, count)) return jacobians_in_lanes(model, count, q, tip_of(model), J);
  jacobians_one_by_one(model, count, q, J,
                       [&](const auto& x, MatrixRef columns) { tip_jacobian(model, x, columns); });
}

void cable_lengths(const Model& model, Index count, const StateRows& q, double* lengths) {
  const Index cables = model.num_cables();
  if (!fits_lanes(model, count)) {
    for (Index i = 0; i < count; ++i) {
      cable_lengths(model, row(q, i, model.num_coordinates()),
                    Eigen::Map<VectorXd>(lengths + i * cables, cables));
    }
    return;
  }
  answer_in_lanes(model, count, q, {{lengths, cables}},
                  [&](auto& /*lanes*/, const auto* x, auto* out) {
                    for (Index j = 0; j < cables; ++j) {
                      auto length = x[0] * -model.actuation_matrix()(0, j);
                      const Index rows = model.cable_rows()[static_cast<std::size_t>(j)];
                      for (Index i = 1; i < rows; ++i) {
                        length -= x[i] * model.actuation_matrix()(i, j);
                      }
                      out[j] = length + model.straight_lengths()[j];
                    }
                  });
}

}  // namespace cdcr
