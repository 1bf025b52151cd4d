#pragma once

#include "cases.hpp"
#include "cdcr/cdcr.hpp"

// Robots of rods, as Model takes them.

namespace cdcr::test {

/// Table 1 with bending, twist and stretch of these orders, made of one metal.
inline Section rod_section(int bending_order, int twist_order, int stretch_order) {
  Section section = amouri2020().sections[0];
  section.bending_order = bending_order;
  section.twist_order = twist_order;
  section.stretch_order = stretch_order;
  section.shear_modulus = section.youngs_modulus / 2.6;
  section.damping = 1e-3;
  section.twist_damping = 5e-4;
  section.stretch_damping = 1.0;
  section.material_damping = 1e-3;
  return section;
}

/// An arc and a tapered tube that bends, twists and stretches, bent at rest; cables that run
/// straight, wind, converge, begin in the middle, and one that is driven by length.
inline Robot rod_robot() {
  Robot robot;
  robot.sections = {rod_section(0, locked, locked), rod_section(2, 1, 0)};
  Section& outer = robot.sections[1];
  outer.length = 0.5;
  outer.cable_angles.clear();
  outer.backbone_tip_diameter = 0.003;
  outer.backbone_inner_diameter = 0.001;
  outer.rest_bending = {0.3, -0.2};
  outer.rest_twist = 0.4;
  robot.gravity = {0.5, 0.0, -9.81};
  robot.payload = 0.02;
  Cable straight;
  straight.radius = 0.015;
  straight.angle = 0.3;
  straight.end_section = 1;
  Cable helix = straight;
  helix.angles = {{0.0, 2.0}, {2.0, 5.0}};
  Cable cone = straight;
  cone.radii = {{0.018, 0.012}, {0.012, 0.006}};
  Cable late = helix;
  late.start_section = 1;
  late.angles = {{1.0, -1.0}};
  Cable drive = straight;
  drive.angle = 4.0;
  drive.stiffness = 2e3;
  drive.damping = 1.0;
  robot.cables = {straight, helix, cone, late, drive};
  return robot;
}

/// A state of a robot of rods, bent and twisted by about `size` [rad], stretched by little.
struct RodState {
  VectorXd q, qd, command;

  RodState(const Model& model, double size, Random& random)
      : q(model.rest() + random.vector(model.num_coordinates(), size)),
        qd(random.vector(model.num_coordinates(), 3.0)),
        command(model.num_cables()) {
    const std::vector<std::string> names = model.coordinate_names();
    for (Index i = 0; i < q.size(); ++i) {
      if (names[static_cast<std::size_t>(i)][0] != 'e') continue;
      q[i] *= 1e-2;
      qd[i] *= 1e-2;
    }
    cable_lengths(model, q, command);
    for (Index j = 0; j < command.size(); ++j) {
      const bool by_length = model.cables()[static_cast<std::size_t>(j)].length_driven();
      command[j] = by_length ? command[j] - 1e-3 : random.uniform(0.0, 5.0);
    }
  }
};

}  // namespace cdcr::test
