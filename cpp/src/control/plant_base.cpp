#include "control/plant_base.hpp"

#include "cdcr/base_wrench.hpp"
#include "cdcr/cable_friction.hpp"
#include "loads/total_force.hpp"

namespace cdcr::detail {

PlantBase::PlantBase(const Model& model)
    : data_(model),
      felt_(VectorXd::Zero(model.num_cables())),
      force_(VectorXd::Zero(model.num_coordinates())),
      rate_(VectorXd::Zero(model.num_deflections())),
      qdd_(force_) {}

void PlantBase::feel(const Simulator& plant, const VectorXd& command, const Wrenches& wrenches,
                     VectorRef on_base) noexcept {
  const Model& model = plant.model();
  const VectorXd &q = plant.q(), &qd = plant.qd();
  felt_ = plant.felt();
  follow_with_play(model, command, felt_);
  if (model.num_deflections() > 0) {
    total_force(model, q.data(), qd.data(), felt_.data(), plant.deflection().data(), wrenches,
                force_.data(), rate_.data());
  } else {
    cdcr::total_force(model, q, qd, felt_, wrenches, force_);
  }
  forward_dynamics_force(model, data_, q, qd, force_, qdd_);
  base_wrench(model, q, qd, qdd_, wrenches, on_base);
}

}  // namespace cdcr::detail
