#include "cdcr/kinematic_hessian.hpp"

#include "base/sizes.hpp"
#include "cdcr/kinematics.hpp"
#include "dynamics/parts.hpp"
#include "loads/wrench_derivatives.hpp"

namespace cdcr {

/// J^T w of unit forces and moments w has the rows of J.
void kinematic_hessian(const Model& model, const ConstVectorRef& q, Index section, double fraction,
                       MatrixRef H) noexcept {
  [[maybe_unused]] const Index d = model.num_coordinates();
  assert(detail::of_coordinates(model, q) && detail::is_section(model, section));
  assert(detail::is_fraction(fraction) && detail::has_size(H, 6, d * d));
  H.setZero();
  for (int r = 0; r < 6; ++r) {
    Wrench unit;
    unit.section = section;
    unit.fraction = fraction;
    (r < 3 ? unit.force : unit.moment)[r % 3] = 1.0;
    detail::differentiate_wrench(detail::chain_of(model), q.data(), unit,
                                 [&](Index row, Index coordinate, double slope) {
                                   H(r, q.size() * row + coordinate) += slope;
                                 });
  }
}

void tip_hessian(const Model& model, const ConstVectorRef& q, MatrixRef H) noexcept {
  const Index d = model.num_coordinates(), last = model.num_sections() - 1;
  kinematic_hessian(model, q, last, 1.0, H);
  if (!model.has_tool()) return;
  const Vector3d lever =
      pose(model, q, last, 1.0).R * Vector3d(model.robot().tool.topRightCorner<3, 1>());
  double columns[6 * max_coordinates];
  Eigen::Map<MatrixXd> J(columns, 6, d);
  jacobian(model, q, last, 1.0, J);
  for (Index c = 0; c < d; ++c) {  // of J_v + J_omega x lever, which turns with q
    const Vector3d turn = J.col(c).tail<3>();
    for (Index k = 0; k < d; ++k) {
      auto column = H.col(d * c + k);
      const Vector3d changed = column.tail<3>(), swing = Vector3d(J.col(k).tail<3>()).cross(lever);
      column.head<3>() += changed.cross(lever) + turn.cross(swing);
    }
  }
}

}  // namespace cdcr
