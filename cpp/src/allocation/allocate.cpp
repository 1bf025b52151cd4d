#include <limits>
#include <string>

#include "base/arguments.hpp"
#include "base/sizes.hpp"
#include "cdcr/allocation.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/kinematics.hpp"

namespace cdcr {
namespace {

// Share of the missing force along a cable that is zero but for rounding: it would not help.
constexpr double indifferent = 1e-6;

}  // namespace

void require_constant_actuation(const Model& model) {
  detail::require(
      model.has_constant_actuation(),
      "q must be given: the actuation matrix of this robot depends on it, since a cable "
      "winds or converges, or runs through a section that twists");
}

Allocation allocate(const Model& model, const VectorXd& force, const TensionLimits& limits) {
  require_constant_actuation(model);
  return allocate_at(model, model.rest(), force, limits);
}

Allocation allocate_at(const Model& model, const VectorXd& q, const VectorXd& force,
                       const TensionLimits& limits) {
  detail::require_finite("force", force, model.num_coordinates());
  detail::require_finite("q", q, model.num_coordinates());
  Allocator allocator(model, limits);
  allocator.set_shape(q);
  MatrixXd B(model.num_coordinates(), model.num_cables());
  actuation_matrix(model, q, B);
  Allocation result;
  result.feasible = allocator.solve(force);
  // A force on short arms may ask for more than the largest double, which is not feasible.
  constexpr double most = std::numeric_limits<double>::max();
  result.tension = allocator.tension().cwiseMin(most).cwiseMax(-most);
  result.force = allocator.force();
  const VectorXd missing = force - result.force;
  result.distance = missing.stableNorm();  // whose squares do not overflow
  for (Index j = 0; j < model.num_cables() && !result.feasible; ++j) {
    if (!allocator.at_limit(j)) continue;
    const double wanted = B.col(j).dot(missing);
    const double tension = result.tension[j];
    const bool lower = tension == allocator.lower()[j], upper = tension == allocator.upper()[j];
    const double least = indifferent * B.col(j).norm() * result.distance;
    if (!(lower && wanted < -least) && !(upper && wanted > least)) continue;
    result.limiting.push_back(j);
    result.limits.push_back(detail::sentence(cable_name(model, j), " at ", tension, " N (",
                                             wanted < 0.0 ? "min" : "max", ")"));
  }
  return result;
}

std::string cable_name(const Model& model, Index cable) {
  detail::require(detail::is_cable(model, cable), "cable must be an index from 0 to ",
                  model.num_cables() - 1, ", got ", cable);
  const int section = model.cables()[static_cast<std::size_t>(cable)].end_section;
  int number = 0;
  for (Index j = 0; j <= cable; ++j) {
    if (model.cables()[static_cast<std::size_t>(j)].end_section == section) ++number;
  }
  return "cable " + std::to_string(number) + " of section " + std::to_string(section + 1);
}

void cable_commands(const Model& model, const ConstVectorRef& q, const ConstVectorRef& tension,
                    VectorRef command) noexcept {
  assert(detail::of_coordinates(model, q) && detail::of_cables(model, tension, command));
  cable_lengths(model, q, command);
  for (Index j = 0; j < model.num_cables(); ++j) {
    const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
    command[j] = cable.length_driven()
                     ? command[j] - tension[j] / cable.stiffness - model.slack_offset()[j]
                     : tension[j];
  }
}

}  // namespace cdcr
