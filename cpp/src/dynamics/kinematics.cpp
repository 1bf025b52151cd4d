#include "cdcr/kinematics.hpp"

#include "base/sizes.hpp"
#include "chain/arcs.hpp"
#include "dynamics/parts.hpp"

namespace cdcr {

namespace {

/// Columns of the Jacobian of a point that the last of the arcs carries, p from the base, eq. (5).
inline void jacobian_of(const Model& model, const detail::Arcs<double>& arcs, const Vector3d& p,
                        MatrixRef& J) noexcept {
  J.setZero();
  for (Index i = 0; i <= arcs.last; ++i) {
    const auto& arc = arcs.arcs[i];
    const Vector3d beyond = p - arcs.ends[i];  // what the end of this arc carries along
    for (Index k = 0; k < arc.J_omega.cols(); ++k) {
      auto column = J.col(model.first_coordinate(i) + k);
      column.head<3>() = arc.J_v.col(k) + arc.J_omega.col(k).cross(beyond);
      column.tail<3>() = arc.J_omega.col(k);
    }
  }
}

}  // namespace

Pose pose(const Model& model, const ConstVectorRef& q, Index section, double fraction) noexcept {
  assert(detail::of_coordinates(model, q) && detail::is_section(model, section));
  assert(detail::is_fraction(fraction));
  detail::Arcs<double> arcs;
  arcs.update(detail::chain_of(model), q.data(), section, fraction);
  return {arcs.frame.rotation(), arcs.p + model.robot().base_position};
}

Pose tip(const Model& model, const ConstVectorRef& q) noexcept {
  Pose at = pose(model, q, model.num_sections() - 1, 1.0);
  if (model.has_tool()) {
    const Transform& tool = model.robot().tool;
    at.p += at.R * tool.topRightCorner<3, 1>();
    at.R *= tool.topLeftCorner<3, 3>();
  }
  return at;
}

void jacobian(const Model& model, const ConstVectorRef& q, Index section, double fraction,
              MatrixRef J) noexcept {
  assert(detail::of_coordinates(model, q) && detail::is_section(model, section));
  assert(detail::is_fraction(fraction) && detail::has_size(J, 6, model.num_coordinates()));
  detail::Arcs<double> arcs;
  arcs.update(detail::chain_of(model), q.data(), section, fraction);
  jacobian_of(model, arcs, arcs.p, J);
}

void tip_jacobian(const Model& model, const ConstVectorRef& q, MatrixRef J) noexcept {
  assert(detail::of_coordinates(model, q) && detail::has_size(J, 6, model.num_coordinates()));
  detail::Arcs<double> arcs;
  arcs.update(detail::chain_of(model), q.data(), model.num_sections() - 1, 1.0);
  const Vector3d tool = model.robot().tool.topRightCorner<3, 1>();
  jacobian_of(model, arcs, arcs.p + arcs.frame.rotate(tool), J);
}

void cable_lengths(const Model& model, const ConstVectorRef& q, VectorRef lengths) noexcept {
  assert(detail::of_coordinates(model, q) && detail::of_cables(model, lengths));
  lengths = model.straight_lengths();
  lengths.noalias() -= model.actuation_matrix().transpose() * q;
}

}  // namespace cdcr
