// Tensions for the force of rods that stretch, whose moments and forces are of different units.
#include <doctest/doctest.h>

#include "cdcr/allocation.hpp"
#include "cdcr/dynamics.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

/// Two rods that stretch, with three cables each, of this size against 0.6 m.
Robot rods_of_size(double size) {
  Section section;
  section.length = 0.3 * size;
  section.backbone_mass = 4e-3 * size * size * size;
  section.backbone_diameter = 1e-3 * size;
  section.youngs_modulus = 60e9;
  section.cable_radius = 8e-3 * size;
  section.cable_angles = {0.0, 2.0, 4.0};
  section.stretch_order = 0;
  Robot robot;
  robot.sections = {section, section};
  return robot;
}

TEST_SUITE_BEGIN("allocation_rods");

TEST_CASE("forces of cables are met whatever the robot's size") {
  Random random;
  INFO(random);
  for (const double size : {1e4, 1.0, 1e-2, 1e-4, 1e-6}) {
    CAPTURE(size);
    const Model model(rods_of_size(size));
    for (int i = 0; i < 20; ++i) {
      const VectorXd F = size * size * random.vector(model.num_cables(), 5.0).cwiseAbs();
      const VectorXd Q = model.actuation_matrix() * F;
      const Allocation found = allocate(model, Q);
      CHECK(found.feasible);
      // Of three cables a section one tension more is free, which the least ones leave out.
      CHECK(found.tension.norm() <= F.norm() * (1.0 + tolerance::cancelled));
      const VectorXd scale = model.actuation_matrix().cwiseAbs() * F;
      for (Index k = 0; k < Q.size(); ++k) {
        CHECK(residual(found.force[k], Q[k], scale[k]) <= 1e-11);
      }
    }
  }
}

TEST_CASE("a moment that no cable gives is told at every size") {
  for (const double size : {1.0, 1e-6}) {
    const Model model(rods_of_size(size));
    VectorXd Q = model.actuation_matrix() * VectorXd::Constant(model.num_cables(), size * size);
    Q[2] = size * size;  // to be longer: cables pull
    const Allocation found = allocate(model, Q);
    CHECK_FALSE(found.feasible);
    CHECK(found.tension.minCoeff() >= 0.0);
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
