#pragma once

#include <string>
#include <vector>

#include "cases.hpp"
#include "cdcr/cdcr.hpp"
#include "rod_robots.hpp"

// Robots that every controller drives: arcs and rods, by tension and by length.

namespace cdcr::test {

/// n sections like Table 1, each turned a little against the one before, under their weight.
inline Robot upright(int n, double damping = 0.02) {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  robot.sections[0].damping = damping;
  for (int i = 1; i < n; ++i) {
    robot.sections.push_back(robot.sections[0]);
    for (double& angle : robot.sections.back().cable_angles) angle += 0.4 * i;
  }
  return robot;
}

/// The same driven by length.
inline Robot by_length(int n) {
  Robot robot = upright(n);
  for (Section& section : robot.sections) {
    section.cable_stiffness = 2e3;
    section.cable_damping = 1.0;
  }
  return robot;
}

/// Rods of second order, with cables of their own.
inline Robot slender() {
  Robot robot;
  robot.sections = {rod_section(1, locked, locked), rod_section(2, locked, locked)};
  robot.gravity = {0.0, 0.0, -9.81};
  for (Section& section : robot.sections) section.damping = 0.02;
  return robot;
}

inline std::vector<NamedRobot> controlled_robots() {
  return {{"one section", upright(1)},
          {"three sections", upright(3)},
          {"by length", by_length(2)},
          {"rods", slender()},
          {"rods, cables of all kinds", rod_robot()}};
}

}  // namespace cdcr::test
