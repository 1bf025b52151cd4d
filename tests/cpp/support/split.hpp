#pragma once

#include <algorithm>
#include <cmath>

#include "cdcr/robot.hpp"
#include "cdcr/types.hpp"

// A robot with every section cut into equal parts, written down from what a section is: disks stay
// where they are, cables end where they did, stiffness and damping add up as springs in a row.

namespace cdcr::test {

inline Robot split(const Robot& robot, int parts) {
  Robot fine = robot;
  fine.sections.clear();
  for (const Section& whole : robot.sections) {
    Section part = whole;
    part.length = whole.length / parts;
    part.backbone_mass = whole.backbone_mass / parts;
    part.damping = whole.damping * parts;
    part.num_disks = 0;
    part.cable_angles.clear();
    part.disk_positions.clear();
    part.disk_masses.clear();
    part.disk_diameters.clear();
    const std::size_t first = fine.sections.size();
    fine.sections.insert(fine.sections.end(), static_cast<std::size_t>(parts), part);
    for (const Disk& disk : whole.disks()) {
      const double along = disk.position * parts;
      const int index = std::clamp(static_cast<int>(std::ceil(along)) - 1, 0, parts - 1);
      Section& owner = fine.sections[first + static_cast<std::size_t>(index)];
      owner.disk_positions.push_back(along - index);
      owner.disk_masses.push_back(disk.mass);
      owner.disk_diameters.push_back(disk.diameter);
    }
    fine.sections.back().cable_angles = whole.cable_angles;
  }
  for (Cable& cable : fine.cables) cable.end_section = (cable.end_section + 1) * parts - 1;
  return fine;
}

/// Every part gets its share of the section's bending vector, or of its rate.
inline VectorXd spread(const VectorXd& whole, int parts) {
  VectorXd fine(whole.size() * parts);
  for (Index i = 0; i < whole.size(); i += 2) {
    fine.segment(i * parts, 2 * parts) = whole.segment(i, 2).replicate(parts, 1) / parts;
  }
  return fine;
}

/// Generalised force on the sections from that on their parts: the transpose of spread().
inline VectorXd gathered(const VectorXd& fine, int parts) {
  VectorXd whole = VectorXd::Zero(fine.size() / parts);
  for (Index k = 0; k < fine.size(); ++k) {
    whole[2 * (k / (2 * parts)) + k % 2] += fine[k] / parts;
  }
  return whole;
}

inline double total_length(const Robot& robot) {
  double sum = 0.0;
  for (const Section& section : robot.sections) sum += section.length;
  return sum;
}

}  // namespace cdcr::test
