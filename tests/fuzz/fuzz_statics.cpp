// Equilibria, modes, tensions for a force, and inverse kinematics of any robot.
#include <cmath>

#include "cdcr/allocation.hpp"
#include "cdcr/inverse_kinematics.hpp"
#include "cdcr/modes.hpp"
#include "cdcr/statics.hpp"
#include "input.hpp"

namespace cdcr::fuzz {
namespace {

/// Bending angles of all sections stay below `limit`, up to rounding.
bool within(const Model& model, const VectorXd& q, double limit) {
  for (Index i = 0; i < model.num_sections(); ++i) {
    if (!(q.segment(2 * i, 2).norm() <= limit * (1.0 + 1e-12))) return false;
  }
  return true;
}

void check_equilibrium(const Model& model, Input& input) {
  const VectorXd command = input.magnitudes(input.size_near(model.num_cables()), 1.0);
  const Index d = model.num_coordinates();
  const VectorXd q0 = input.coin() ? input.vector(input.size_near(d), 1.0) : VectorXd();
  const Wrenches wrenches = input.wrenches(model, 2);
  attempt([&] {
    const Equilibrium found = equilibrium(model, command, q0, wrenches);
    if (found.status != Status::ok) return;
    demand(within(model, found.q, max_bending), "an equilibrium beyond the bending limit");
    demand(found.tension.allFinite() && (found.tension.array() >= 0.0).all(),
           "an equilibrium with tensions that no cable has");
    demand(found.eigenvalues.allFinite() && std::isfinite(found.residual),
           "an equilibrium that is not finite");
  });
  attempt([&] {
    const Modes found = modes(model, q0.size() == 0 ? VectorXd::Zero(d) : q0, command, wrenches);
    demand(found.squared_frequency.allFinite() && found.frequency.allFinite() &&
               found.shape.allFinite() && found.damping_ratio.allFinite() &&
               found.eigenvalues.allFinite(),
           "modes that are not finite");
  });
}

TensionLimits limits(const Model& model, Input& input) {
  TensionLimits limits;
  if (input.coin()) limits.min_tension = input.number(1.0);
  if (input.coin()) limits.max_tension = input.positive(10.0);
  const auto beyond = static_cast<int>(model.num_cables());
  if (input.rare()) {
    for (int k = input.integer(0, 3); k > 0; --k) {
      limits.cables.push_back(input.integer(0, beyond));
    }
  }
  limits.method = static_cast<AllocationMethod>(input.integer(0, 2));
  return limits;
}

void check_allocation(const Model& model, Input& input) {
  const TensionLimits allowed = limits(model, input);
  const VectorXd force = input.vector(input.size_near(model.num_coordinates()), 1.0);
  attempt([&] {
    const Allocation found = allocate(model, force, allowed);
    demand(found.tension.allFinite(), "tensions that are not finite");
    demand(!found.feasible || (found.force.allFinite() && std::isfinite(found.distance)),
           "a feasible force that is not finite");
    for (Index j = 0; j < model.num_cables(); ++j) {
      const double F = found.tension[j];
      const bool unused = !allowed.cables.empty() && F == 0.0;
      demand(unused || (F >= allowed.min_tension && F <= allowed.max_tension),
             "a tension beyond its limits");
    }
  });
}

void check_inverse(const Model& model, Input& input) {
  InverseKinematicsOptions options;
  const int parts = input.byte();
  if ((parts & 1) != 0) options.max_theta = input.magnitudes(input.integer(0, 3), 3.0);
  if ((parts & 2) != 0) options.orientation_weight = input.positive(0.1);
  if ((parts & 4) != 0) options.tolerance = input.positive(1e-3);
  options.seeds = input.integer(input.rare() ? 0 : 1, 6);
  options.iterations = input.integer(input.rare() ? 0 : 1, 30);
  const Vector3d p = input.vector3(0.5);
  std::optional<Matrix3d> R;
  if ((parts & 8) != 0) R = Matrix3d::Identity();
  if ((parts & 16) != 0) R = input.vector(9, 1.0).reshaped(3, 3);
  const VectorXd q0 =
      (parts & 32) != 0 ? input.vector(input.size_near(model.num_coordinates()), 1.0) : VectorXd();
  attempt([&] {
    const InverseKinematics found = inverse_kinematics(model, p, R, q0, options);
    demand(found.reachable == (found.reach == IkStatus::reached), "two answers about the reach");
    demand(found.reachable == found.message.empty(), "a message that does not fit the answer");
    if (!found.reachable) return;
    demand(within(model, found.q, max_bending), "a shape beyond the bending limit");
    demand(found.position.allFinite() && std::isfinite(found.residual),
           "a shape that is not finite");
    demand(!options.tolerance || found.residual <= *options.tolerance * (1.0 + 1e-12),
           "a shape farther away than the tolerance");
  });
}

void check(Input input) {
  const std::optional<Model> model = input.model();
  if (!model) return;
  const int parts = input.byte();
  if (parts % 4 == 0 || parts % 4 == 1) check_equilibrium(*model, input);
  if (parts % 4 == 0 || parts % 4 == 2) check_allocation(*model, input);
  if (parts % 4 == 0 || parts % 4 == 3) check_inverse(*model, input);
}

}  // namespace
}  // namespace cdcr::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cdcr::fuzz::check({data, size});
  return 0;
}
