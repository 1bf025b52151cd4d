// Questions a planner asks: where the robot rests, and which tensions give a force.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "harness.hpp"
#include "scenario.hpp"

namespace cdcr::bench {
namespace {

Robot four_cable_robot() {
  Robot four = robot(true);
  four.sections[0].cable_angles = {0.0, 1.2, 2.9, 4.4};
  return four;
}

/// The robot of Rao et al. (2021), or with weight: a backbone of Nitinol, disks of one gram and a
/// payload of 20 g, standing.
Robot two_section_robot(bool weight) {
  Section section;
  section.length = 0.2;
  section.backbone_diameter = 0.0014;
  section.youngs_modulus = 54e9;
  section.num_disks = 10;
  section.disk_diameter = 0.02;
  section.cable_radius = 0.01;
  section.cable_angles = {0.0, 2.0943951023931953, 4.1887902047863905};
  if (weight) {
    section.backbone_mass = 1.986e-3;
    section.disk_mass = 1e-3;
  }
  Robot robot;
  robot.sections = {section, section};
  if (weight) {
    robot.gravity = {0.0, 0.0, -9.81};
    robot.payload = 0.02;
  }
  return robot;
}

/// Tensions of 0 to 8 N, each another draw.
std::vector<VectorXd> drawn_tensions() {
  std::mt19937_64 engine(2021);
  std::uniform_real_distribution<double> uniform(0.0, 8.0);
  std::vector<VectorXd> draws(1024, VectorXd(6));
  for (VectorXd& draw : draws) {
    for (double& tension : draw) tension = uniform(engine);
  }
  return draws;
}

void measure_sections(const Harness& harness) {
  const Model light(two_section_robot(false)), heavy(two_section_robot(true));
  const std::vector<VectorXd> draws = drawn_tensions();
  const auto draw = [&](long i) -> const VectorXd& {
    return draws[static_cast<std::size_t>(i) % 1024];
  };
  const auto nothing = [] {};
  // A block is one draw after the other: its time is the mean over all.
  harness.run({"equilibrium, two sections", "us", 1024, 100}, nothing,
              [&](long i) { keep(equilibrium(light, draw(i))); });
  harness.run({"equilibrium, two sections, gravity", "us", 1024, 100}, nothing,
              [&](long i) { keep(equilibrium(heavy, draw(i))); });
  // The same call by call: the median over draws, reading the clock included.
  long next = 0;
  harness.run({"equilibrium, two sections, gravity, each draw", "us", 1, 10240}, nothing,
              [&](long /*i*/) { keep(equilibrium(heavy, draw(next++))); });
  const VectorXd q = equilibrium(heavy, draws[0]).q;
  harness.run({"modes, two sections", "us", 100, 200}, nothing,
              [&](long /*i*/) { keep(modes(heavy, q, draws[0])); });
  const VectorXd force = heavy.actuation_matrix() * draws[0];
  TensionLimits limits;
  Allocator sections(heavy, limits);
  limits.method = AllocationMethod::search;
  Allocator search(heavy, limits);
  harness.run({"Allocator.solve, two sections", "ns", 100}, nothing,
              [&](long /*i*/) { keep(sections.solve(force)); });
  harness.run({"Allocator.solve, two sections, search", "ns", 100}, nothing,
              [&](long /*i*/) { keep(search.solve(force)); });
}

/// How cables of the three sections are driven and rub, and how commands go.
struct SlowWay {
  const char* name;
  double holes, entry, stiffness;  // friction, friction at the entry [N]; by length [N/m]
  bool jumps = false;
};

/// A thousand poses, so that a millisecond is a microsecond each.
void measure_slow_ways(const Harness& harness) {
  const SlowWay ways[] = {
      {"no friction", 0.0, 0.0, 0.0},
      {"friction 0.1 in the holes", 0.1, 0.0, 0.0},
      {"friction 0.3 in the holes", 0.3, 0.0, 0.0},
      {"friction 0.3 in the holes, jumps", 0.3, 0.0, 0.0, true},
      {"friction 0.1 N at the entry", 0.0, 0.1, 0.0},
      {"by length, friction 0.1 in the holes", 0.1, 0.0, 2e4},
      {"by length, friction 0.1 N at the entry", 0.0, 0.1, 2e4},
  };
  for (const SlowWay& way : ways) {
    Robot robot = arm(3);
    for (Section& section : robot.sections) {
      section.cable_friction = way.holes;
      section.cable_entry_friction = way.entry;
      section.cable_stiffness = way.stiffness;
    }
    const Model model(robot);
    VectorXd straight = VectorXd::Zero(model.num_cables());
    if (way.stiffness > 0.0) cable_lengths(model, model.rest(), straight);
    std::mt19937_64 engine(2021);
    std::uniform_real_distribution<double> uniform(0.0, 2.0);
    RowMatrixXd commands(1000, model.num_cables());
    for (Index i = 0; i < commands.rows(); ++i) {
      for (Index j = 0; j < commands.cols(); ++j) {
        const double turns = static_cast<double>((1 + j % 3) * i) / 1000.0;
        const double smooth = 1.0 + std::sin(2.0 * M_PI * turns + static_cast<double>(j));
        const double pull = way.jumps ? uniform(engine) : smooth;  // 0 to 2
        commands(i, j) = straight[j] + (way.stiffness > 0.0 ? -2e-3 : 2.0) * pull;
      }
    }
    harness.run(
        {std::string("quasi_static, 1000 poses, ") + way.name, "ms", 1, 50}, [] {},
        [&](long /*i*/) { keep(quasi_static(model, commands)); });
  }
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
  measure_sections(harness);
  measure_slow_ways(harness);
}

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  cdcr::bench::measure(cdcr::bench::Harness(argc, argv));
}
