#include "base/magnitudes.hpp"

#include <cmath>

#include "base/arguments.hpp"

namespace cdcr::detail {

void require_magnitudes(const Model& model) {
  constexpr double shortest = 1e-150, longest = 1e150;  // [m]
  const Robot& robot = model.robot();
  double length = 0.0, mass = robot.payload, size = robot.payload_position.norm();
  for (const Section& section : robot.sections) {
    length += section.length;
    mass += section.backbone_mass;
    size += section.length + section.backbone_diameter;
    for (const Disk& disk : section.disks()) {
      mass += disk.mass;
      size = std::fmax(size, disk.diameter);
    }
  }
  require(length >= shortest && length <= longest, "the robot must be ", shortest, " to ", longest,
          " m long in all, got ", length);
  const VectorXd stiffness = model.elastic_stiffness().diagonal();
  for (Index i = 0; i < stiffness.size(); ++i) {
    require(stiffness[i] > 0.0 && std::isfinite(stiffness[i]),
            "the stiffness of the robot must be > 0 and finite, got ", stiffness[i]);
  }
  require(std::isfinite(mass * size * size),
          "the inertia of the robot must be finite, got a mass of ", mass, " kg and a size of ",
          size, " m");
}

}  // namespace cdcr::detail
