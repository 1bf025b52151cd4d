#pragma once

#include <vector>

#include "cdcr/cdcr.hpp"

namespace cdcr::bench {

inline constexpr double quarter_pi = 0.78539816339744831;

/// The robot cdcr.robots.three_sections() of Python for n = 3: Nitinol, 2 mm, printed disks 36 mm
/// wide, three cables a section; for other n as many sections like its first. Upright.
inline Robot arm(Index n) {
  Robot robot;
  robot.gravity = {0.0, 0.0, -9.81};
  for (Index i = 0; i < n; ++i) {
    Section s;
    const int shorter = n == 3 ? static_cast<int>(i) : 0;
    s.num_disks = 6 - shorter;
    s.length = 0.05 * s.num_disks;
    s.backbone_diameter = 0.002;
    s.backbone_mass = 6450.0 * quarter_pi * s.backbone_diameter * s.backbone_diameter * s.length;
    s.youngs_modulus = 60e9;
    s.disk_diameter = 0.036;
    s.disk_mass = 1040.0 * quarter_pi * s.disk_diameter * s.disk_diameter * 0.002;
    s.cable_radius = 0.015;
    for (int k = 0; k < 3; ++k) {  // 120 degrees apart, each section turned by 40
      s.cable_angles.push_back(quarter_pi * (8.0 * k / 3.0 + 8.0 * static_cast<double>(i) / 9.0));
    }
    s.damping = 1e-3;
    robot.sections.push_back(s);
  }
  return robot;
}

/// A point of a run.
struct State {
  VectorXd q, qd;
};

/// Table 1, with gravity as if the base were tilted by 30 degrees, so that no term vanishes.
inline Robot robot(bool gravity) {
  Robot robot = amouri2020();
  if (gravity) robot.gravity = {4.905, 0.0, -8.496};
  return robot;
}

/// Table 1, damped, upright, cut into n equal parts, a disk at the end of each.
inline Robot in_parts(int n) {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  const Section whole = robot.sections[0];
  Section part = whole;
  part.length /= n;
  part.backbone_mass /= n;
  part.disk_mass *= static_cast<double>(whole.num_disks) / n;
  part.num_disks = 1;
  part.damping = 0.02 * n;
  part.cable_angles.clear();
  robot.sections.assign(static_cast<std::size_t>(n), part);
  robot.sections.back().cable_angles = whole.cable_angles;
  return robot;
}

/// The start of every run here: bent by pi/4 towards phi = 0, at rest.
inline State bent() {
  return {bending(quarter_pi, 0.0), VectorXd::Zero(2)};
}

/// States of a spatial swing of 10 s, each another point of it. Their number divides 1024.
inline std::vector<State> swing(const Model& model) {
  constexpr Index num_states = 64;
  const VectorXd times = VectorXd::LinSpaced(num_states, 0.0, 10.0);
  const VectorXd rate = bending(2.0, 2.0);
  const Trajectory run = simulate(model, bent().q, rate, times,
                                  CommandInput::constant(VectorXd::Zero(model.num_cables())));
  std::vector<State> states;
  for (Index i = 0; i < num_states; ++i) {
    states.push_back({run.q.row(i).transpose(), run.qd.row(i).transpose()});
  }
  return states;
}

}  // namespace cdcr::bench
