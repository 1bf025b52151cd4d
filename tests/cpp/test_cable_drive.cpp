// Generalised forces as commands of the cables: pretensions, lengths.
#include <doctest/doctest.h>

#include "cdcr/cdcr.hpp"
#include "support/controlled_robots.hpp"
#include "support/residual.hpp"

namespace cdcr::test {
namespace {

TEST_SUITE_BEGIN("cable_drive");

TEST_CASE("every cable keeps its own pretension, and the force is met") {
  const Model model(upright(2));
  TensionLimits limits;
  limits.pretension = VectorXd::LinSpaced(6, 0.5, 3.0);
  CableDrive drive(model, limits, 1e9, 1e-3);
  Random random;
  INFO(random);
  for (int round = 0; round < 20; ++round) {
    const VectorXd q = random.vector(4, 0.3), force = random.vector(4, 0.1);
    CHECK(drive.solve(q, q, force));
    CHECK((drive.command() - limits.pretension).minCoeff() >= 0.0);
    CHECK(residual(model.actuation_matrix() * drive.command(), force, 0.1) <= 1e-12);
    // Tensions that keep the limits already are taken as they are.
    const VectorXd wanted = limits.pretension + VectorXd::Constant(6, 0.2);
    CHECK(drive.solve(q, q, model.actuation_matrix() * wanted, wanted));
    CHECK(residual(drive.tension(), wanted) <= 1e-12);
  }
  CHECK(drive.is_fully_actuated());
  CHECK_FALSE(CableDrive(Model(slender()), {}, 1.0, 1e-3).is_fully_actuated());
}

TEST_CASE("lengths pull as the tensions that were found") {
  const Model model(by_length(2));
  TensionLimits limits;
  limits.min_tension = 1.0;
  CableDrive drive(model, limits, 1e9, 1e-3);
  Random random;
  INFO(random);
  VectorXd tension(6), force(4);
  for (int round = 0; round < 20; ++round) {
    const VectorXd q = random.vector(4, 0.3), qd = random.vector(4, 1.0);
    const VectorXd wanted = random.vector(4, 0.05);
    CHECK(drive.solve(q, qd, wanted));
    cable_tensions(model, q, qd, drive.command(), tension);
    CHECK(residual(tension, drive.tension(), 1.0) <= 1e-10);
    cable_force(model, q, qd, drive.command(), force);
    CHECK(residual(force, wanted, 0.1) <= 1e-10);
    drive.reset();
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
