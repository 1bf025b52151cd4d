#include "control/same_robot.hpp"

#include "base/arguments.hpp"

namespace cdcr::detail {

void require_sizes(const char* who, Index num_coordinates, Index num_cables, const Model& model) {
  require(num_coordinates == model.num_coordinates() && num_cables == model.num_cables(), who,
          " was made for a robot of ", num_coordinates, " coordinates and ", num_cables,
          " cables, but the model has ", model.num_coordinates(), " coordinates and ",
          model.num_cables(), " cables");
}

void require_drives(const char* who, const Model& made_for, const Model& model) {
  const std::vector<Cable>&drives = made_for.cables(), &cables = model.cables();
  for (std::size_t j = 0; j < cables.size(); ++j) {
    if (drives[j].length_driven() == cables[j].length_driven()) continue;
    const bool by_length = cables[j].length_driven();
    refuse(who, by_length ? "tension" : "length", ", but cable ", j + 1,
           " of the robot is driven by ",
           by_length ? "length (its stiffness is not 0)" : "tension (its stiffness is 0)");
  }
}

}  // namespace cdcr::detail
