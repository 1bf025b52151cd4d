#include "cdcr/kinematics.hpp"

#include "base/sizes.hpp"
#include "derivatives/jacobian.hpp"
#include "dynamics/parts.hpp"

namespace cdcr {

namespace {

/// Of a point that the last of the parts carries, p from the base.
template <class Reach>
void jacobian_of(const Model& model, const Reach& reach, const Vector3d& p, MatrixRef& J) noexcept {
  J.setZero();
  detail::each_column(reach, p,
                      [&](Index i, Index k, const Vector3d& moving, const Vector3d& turning) {
                        auto column = J.col(model.first_coordinate(i) + k);
                        column.template head<3>() = moving;
                        column.template tail<3>() = turning;
                      });
}

}  // namespace

Pose pose(const Model& model, const ConstVectorRef& q, Index section, double fraction) noexcept {
  assert(detail::of_coordinates(model, q) && detail::is_section(model, section));
  assert(detail::is_fraction(fraction));
  return detail::with_reach(
      detail::chain_of(model), q.data(), section, fraction, [&](const auto& reach) {
        return Pose{reach.frame.rotation(), reach.p + model.robot().base_position};
      });
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
  detail::with_reach(detail::chain_of(model), q.data(), section, fraction,
                     [&](const auto& reach) { jacobian_of(model, reach, reach.p, J); });
}

void tip_jacobian(const Model& model, const ConstVectorRef& q, MatrixRef J) noexcept {
  assert(detail::of_coordinates(model, q) && detail::has_size(J, 6, model.num_coordinates()));
  const Vector3d tool = model.robot().tool.topRightCorner<3, 1>();
  detail::with_reach(
      detail::chain_of(model), q.data(), model.num_sections() - 1, 1.0,
      [&](const auto& reach) { jacobian_of(model, reach, reach.p + reach.frame.rotate(tool), J); });
}

}  // namespace cdcr
