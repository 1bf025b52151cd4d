#include "loads/friction_memory.hpp"

#include <algorithm>
#include <cmath>

#include "base/sizes.hpp"
#include "cdcr/cable_friction.hpp"

namespace cdcr {

using detail::of_cables, detail::of_coordinates;

void cable_force(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const ConstVectorRef& command, const ConstVectorRef& deflection, VectorRef force,
                 VectorRef deflection_rate) noexcept {
  assert(of_coordinates(model, q, qd, force) && of_cables(model, command));
  assert(of_cables(model, deflection, deflection_rate));
  detail::memory_force(model, q.data(), qd.data(), command.data(), deflection.data(), force.data(),
                       deflection_rate.data());
}

double friction_power(const Model& model, const ConstVectorRef& q, const ConstVectorRef& qd,
                      const ConstVectorRef& command, const ConstVectorRef& deflection) noexcept {
  assert(of_coordinates(model, q, qd) && of_cables(model, command, deflection));
  double heat = 0.0, force[max_coordinates] = {}, rate = 0.0;
  detail::CableGeometry<double> geometry(model, q.data());
  for (Index j = 0; j < model.num_cables(); ++j) {
    geometry.set_cable(j);
    heat += detail::add_memory_force(model, geometry, j, qd.data(), double{command[j]},
                                     double{deflection[j]}, force, rate)
                .heat;
  }
  return heat;
}

double deflection_energy(const Model& model, const ConstVectorRef& deflection) noexcept {
  return 0.5 * model.robot().presliding_stiffness * deflection.squaredNorm();
}

void follow_with_play(const Model& model, const ConstVectorRef& command, VectorRef felt) noexcept {
  assert(of_cables(model, command, felt));
  for (Index j = 0; j < model.num_cables(); ++j) {
    const double half = 0.5 * model.cables()[static_cast<std::size_t>(j)].backlash;
    felt[j] = std::clamp(double{felt[j]}, command[j] - half, command[j] + half);
  }
}

}  // namespace cdcr
