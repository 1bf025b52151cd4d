// Questions a planner asks: where the robot rests, and which tensions give a force.
#include "harness.hpp"
#include "scenario.hpp"

namespace cdcr::bench {
namespace {

Robot four_cable_robot() {
  Robot four = robot(true);
  four.sections[0].cable_angles = {0.0, 1.2, 2.9, 4.4};
  return four;
}

void measure(const Harness& harness) {
  const Model free(robot(false)), heavy(robot(true)), four(four_cable_robot());
  const VectorXd tension = Eigen::Vector3d(5.0, 1.0, 0.0);
  const VectorXd force = Eigen::Vector2d(0.05, -0.03);  // [N m], of some 3 N in a cable
  const auto nothing = [] {};

  harness.run({"equilibrium", "ns", 100}, nothing,
              [&](long /*i*/) { keep(equilibrium(free, tension)); });
  harness.run({"equilibrium, gravity", "ns", 100}, nothing,
              [&](long /*i*/) { keep(equilibrium(heavy, tension)); });
  TensionLimits limits;
  limits.min_tension = 0.5;
  limits.max_tension = 50.0;
  harness.run({"allocate", "ns", 100}, nothing,
              [&](long /*i*/) { keep(allocate(free, force, limits)); });
  Allocator three_cables(free, limits), four_cables(four, limits);
  harness.run({"Allocator.solve, 3 cables", "ns", 100}, nothing,
              [&](long /*i*/) { keep(three_cables.solve(force)); });
  harness.run({"Allocator.solve, 4 cables", "ns", 100}, nothing,
              [&](long /*i*/) { keep(four_cables.solve(force)); });
}

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  cdcr::bench::measure(cdcr::bench::Harness(argc, argv));
}
