#include "cdcr/controller.hpp"

#include "base/sizes.hpp"

namespace cdcr {

void require_fit(const Controller& controller, const Model& model) {
  const Index d = controller.num_coordinates(), c = controller.num_cables();
  const bool fits = (d == Controller::any_size || d == model.num_coordinates()) &&
                    (c == Controller::any_size || c == model.num_cables());
  detail::require(fits, "the controller was made for a robot of ", d, " coordinates and ", c,
                  " cables, but the model has ", model.num_coordinates(), " coordinates and ",
                  model.num_cables(), " cables");
  detail::require_positive("the controller's period", controller.period(), "s");
  if (controller.gives_tensions()) detail::require_tension_drive("the controller", model);
  if (controller.reckons_with() == nullptr) return;
  const std::vector<Cable>&drives = controller.reckons_with()->cables(), &cables = model.cables();
  for (std::size_t j = 0; j < cables.size(); ++j) {
    if (drives[j].length_driven() == cables[j].length_driven()) continue;
    const bool by_length = cables[j].length_driven();
    detail::refuse("the controller drives cables by ", by_length ? "tension" : "length",
                   ", but cable ", j + 1, " of the robot is driven by ",
                   by_length ? "length (its stiffness is not 0)" : "tension (its stiffness is 0)");
  }
}

}  // namespace cdcr
