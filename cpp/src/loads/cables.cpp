#include "cdcr/cables.hpp"

#include "base/sizes.hpp"
#include "cdcr/kinematics.hpp"
#include "loads/cable_force.hpp"

namespace cdcr {

using detail::chain_of, detail::of_cables, detail::of_coordinates, detail::path_of;

void actuation_matrix(const Model& model, const ConstVectorRef& q, MatrixRef B) noexcept {
  assert(of_coordinates(model, q));
  assert(detail::has_size(B, model.num_coordinates(), model.num_cables()));
  if (model.has_constant_actuation()) {
    B = model.actuation_matrix();
    return;
  }
  for (Index j = 0; j < model.num_cables(); ++j) {
    const detail::CableSlope<double> slope(chain_of(model), path_of(model, j), q.data());
    for (Index i = 0; i < q.size(); ++i) B(i, j) = slope.column[i];
  }
}

void cable_lengths(const Model& model, const ConstVectorRef& q, VectorRef lengths) noexcept {
  assert(of_coordinates(model, q) && of_cables(model, lengths));
  if (model.has_constant_actuation()) {
    lengths = model.straight_lengths();
    lengths.noalias() -= model.actuation_matrix().transpose() * q;
    return;
  }
  for (Index j = 0; j < model.num_cables(); ++j) {
    lengths[j] = detail::CableSlope<double>(chain_of(model), path_of(model, j), q.data()).length;
  }
}

void actuation_force(const Model& model, const ConstVectorRef& tension, VectorRef force) noexcept {
  assert(of_cables(model, tension) && of_coordinates(model, force));
  assert(model.has_constant_actuation());
  detail::actuation_force(model, tension.data(), force.data());
}

void cable_tensions(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                    const ConstVectorRef& command, VectorRef tension) noexcept {
  assert(of_coordinates(model, q, qd) && of_cables(model, command, tension));
  for (Index j = 0; j < model.num_cables(); ++j) {
    tension[j] = detail::base_tension(model, j, q.data(), qd.data(), command[j]);
  }
}

void cable_force(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const ConstVectorRef& command, VectorRef force) noexcept {
  assert(of_coordinates(model, q, qd, force) && of_cables(model, command));
  detail::cable_force(model, q.data(), qd.data(), command.data(), force.data());
}

double cable_pull(const Model& model, Index cable, const ConstVectorRef& q,
                  const ConstVectorRef& qd, double command) noexcept {
  assert(detail::is_cable(model, cable) && of_coordinates(model, q, qd));
  return detail::spring_force(model, cable, q.data(), qd.data(), command);
}

void tensions_along(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                    const ConstVectorRef& command, MatrixRef tension) noexcept {
  assert(of_coordinates(model, q, qd) && of_cables(model, command));
  assert(detail::has_size(tension, model.num_sections() + 1, model.num_cables()));
  double unused[max_coordinates] = {};
  tension.setZero();
  for (Index j = 0; j < model.num_cables(); ++j) {
    tension(0, j) = detail::base_tension(model, j, q.data(), qd.data(), command[j]);
    if (model.has_rods()) {
      detail::add_rod_cable_force(model, j, q.data(), qd.data(), double{tension(0, j)}, unused,
                                  &tension(1, j));
      continue;
    }
    detail::add_capstan_force(model, j, q.data(), qd.data(), double{tension(0, j)}, unused,
                              &tension(1, j));
  }
}

double friction_power(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                      const ConstVectorRef& command) noexcept {
  assert(of_coordinates(model, q, qd) && of_cables(model, command));
  if (!model.has_friction()) return 0.0;
  double lost = 0.0, force[max_coordinates] = {};
  const detail::Chain& chain = detail::chain_of(model);
  for (Index j = 0; j < model.num_cables(); ++j) {
    const double tension = detail::base_tension(model, j, q.data(), qd.data(), command[j]);
    if (model.has_rods()) {
      const detail::CableSlope<double> slope(chain, detail::path_of(model, j), q.data());
      lost -= tension * slope.rate(chain, qd.data());
      detail::add_rod_cable_force(model, j, q.data(), qd.data(), tension, force);
      continue;
    }
    lost += tension * model.actuation_matrix().col(j).dot(qd);
    detail::add_capstan_force(model, j, q.data(), qd.data(), tension, force);
  }
  return lost - Eigen::Map<const VectorXd>(force, qd.size()).dot(qd);
}

double cable_energy(const Model& model, const ConstVectorRef& q,
                    const ConstVectorRef& command) noexcept {
  assert(of_coordinates(model, q) && of_cables(model, command));
  double energy = 0.0;
  for (Index j = 0; j < model.num_cables(); ++j) {
    const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
    if (!cable.length_driven()) continue;
    const double longer = detail::elongation(model, j, q.data(), double{command[j]});
    if (longer > 0.0) energy += 0.5 * cable.stiffness * longer * longer;
  }
  return energy;
}

void rest_command(const Model& model, VectorRef command) noexcept {
  assert(of_cables(model, command));
  for (Index j = 0; j < model.num_cables(); ++j) {
    const bool by_length = model.cables()[static_cast<std::size_t>(j)].length_driven();
    command[j] = by_length ? model.straight_lengths()[j] : 0.0;
  }
}

}  // namespace cdcr
