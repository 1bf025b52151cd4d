#include "cdcr/kinematics.hpp"

#include "base/sizes.hpp"
#include "chain/arcs.hpp"
#include "dynamics/parts.hpp"

namespace cdcr {

Pose pose(const Model& model, const ConstVectorRef& q, Index section, double fraction) noexcept {
  assert(detail::of_coordinates(model, q) && detail::is_section(model, section));
  assert(detail::is_fraction(fraction));
  detail::Arcs<double> arcs;
  arcs.update(detail::chain_of(model), q.data(), section, fraction);
  return {arcs.frame.rotation(), arcs.p};
}

Pose tip(const Model& model, const ConstVectorRef& q) noexcept {
  return pose(model, q, model.num_sections() - 1, 1.0);
}

void jacobian(const Model& model, const ConstVectorRef& q, Index section, double fraction,
              MatrixRef J) noexcept {
  assert(detail::of_coordinates(model, q) && detail::is_section(model, section));
  assert(detail::is_fraction(fraction) && detail::has_size(J, 6, model.num_coordinates()));
  detail::Arcs<double> arcs;
  arcs.update(detail::chain_of(model), q.data(), section, fraction);
  J.setZero();
  for (Index i = 0; i <= section; ++i) {
    const auto& arc = arcs.arcs[i];
    const Vector3d beyond = arcs.p - arcs.ends[i];  // what the end of this arc carries along
    for (Index k = 0; k < arc.J_omega.cols(); ++k) {
      auto column = J.col(model.first_coordinate(i) + k);
      column.head<3>() = arc.J_v.col(k) + arc.J_omega.col(k).cross(beyond);
      column.tail<3>() = arc.J_omega.col(k);
    }
  }
}

void cable_lengths(const Model& model, const ConstVectorRef& q, VectorRef lengths) noexcept {
  assert(detail::of_coordinates(model, q) && detail::of_cables(model, lengths));
  lengths = model.straight_lengths();
  lengths.noalias() -= model.actuation_matrix().transpose() * q;
}

}  // namespace cdcr
