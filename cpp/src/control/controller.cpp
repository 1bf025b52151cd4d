#include "cdcr/controller.hpp"

#include "base/sizes.hpp"
#include "control/same_robot.hpp"

namespace cdcr {

void require_fit(const Controller& controller, const Model& model) {
  const Index d = controller.num_coordinates(), c = controller.num_cables();
  detail::require_sizes("the controller", d == Controller::any_size ? model.num_coordinates() : d,
                        c == Controller::any_size ? model.num_cables() : c, model);
  detail::require_positive("the controller's period", controller.period(), "s");
  if (controller.gives_tensions()) detail::require_tension_drive("the controller", model);
  if (controller.reckons_with() == nullptr) return;
  detail::require_drives("the controller drives cables by ", *controller.reckons_with(), model);
}

}  // namespace cdcr
