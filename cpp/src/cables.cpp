#include "cdcr/cables.hpp"

#include "cable_force.hpp"

namespace cdcr {

void actuation_force(const Model& model, const ConstVectorRef& tension, VectorRef force) noexcept {
  // Plain loops: for so few numbers a general matrix product costs more than the dynamics. A cable
  // reaches no further than the section it ends on.
  const MatrixXd& B = model.actuation_matrix();
  for (Index i = 0; i < B.rows(); ++i) force[i] = 0.0;
  for (Index j = 0; j < B.cols(); ++j) {
    const Index rows = model.cable_rows()[static_cast<std::size_t>(j)];
    for (Index i = 0; i < rows; ++i) force[i] += B(i, j) * tension[j];
  }
}

void cable_tensions(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                    const ConstVectorRef& command, VectorRef tension) noexcept {
  for (Index j = 0; j < model.num_cables(); ++j) {
    tension[j] = detail::base_tension(model, j, q.data(), qd.data(), command[j]);
  }
}

void cable_force(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const ConstVectorRef& command, VectorRef force) noexcept {
  if (model.has_plain_cables()) return actuation_force(model, command, force);
  detail::cable_force(model, q.data(), qd.data(), command.data(), force.data());
}

double cable_pull(const Model& model, Index cable, const ConstVectorRef& q,
                  const ConstVectorRef& qd, double command) noexcept {
  return detail::spring_pull(model, cable, q.data(), qd.data(), command);
}

void tensions_along(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                    const ConstVectorRef& command, MatrixRef tension) noexcept {
  double unused[2 * max_sections] = {};
  tension.setZero();
  for (Index j = 0; j < model.num_cables(); ++j) {
    tension(0, j) = detail::base_tension(model, j, q.data(), qd.data(), command[j]);
    detail::add_rubbing_cable(model, j, q.data(), qd.data(), double{tension(0, j)}, unused,
                              &tension(1, j));
  }
}

double friction_power(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                      const ConstVectorRef& command) noexcept {
  if (!model.has_friction()) return 0.0;
  double lost = 0.0, force[2 * max_sections] = {};
  for (Index j = 0; j < model.num_cables(); ++j) {
    const double tension = detail::base_tension(model, j, q.data(), qd.data(), command[j]);
    lost += tension * model.actuation_matrix().col(j).dot(qd);
    detail::add_rubbing_cable(model, j, q.data(), qd.data(), tension, force);
  }
  return lost - Eigen::Map<const VectorXd>(force, qd.size()).dot(qd);
}

double cable_energy(const Model& model, const ConstVectorRef& q,
                    const ConstVectorRef& command) noexcept {
  double energy = 0.0;
  for (Index j = 0; j < model.num_cables(); ++j) {
    const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
    if (!cable.length_driven()) continue;
    const double stretch = detail::cable_stretch(model, j, q.data(), double{command[j]});
    if (stretch > 0.0) energy += 0.5 * cable.stiffness * stretch * stretch;
  }
  return energy;
}

void rest_command(const Model& model, VectorRef command) noexcept {
  for (Index j = 0; j < model.num_cables(); ++j) {
    const bool by_length = model.cables()[static_cast<std::size_t>(j)].length_driven();
    command[j] = by_length ? model.straight_lengths()[j] : 0.0;
  }
}

}  // namespace cdcr
