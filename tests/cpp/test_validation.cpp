// Every sentence that refuses bad input, word by word.
#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "cdcr/model.hpp"
#include "cdcr/simulate.hpp"
#include "support/cases.hpp"
#include "support/runs.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

using Sentences = std::vector<std::string>;

Sentences violations_after(const std::function<void(Section&)>& change) {
  Section section = amouri2020().sections[0];
  change(section);
  return violations(section);
}

/// One wrong field gives one sentence; in a robot it names the section, and a model refuses it.
void check_section(const std::function<void(Section&)>& change, const std::string& sentence,
                   const std::string& in_robot) {
  CHECK(violations_after(change) == Sentences{sentence});
  Robot robot = amouri2020();
  change(robot.sections[0]);
  CHECK(violations(robot) == Sentences{in_robot});
  CHECK_THROWS_SENTENCE(Model{robot}, in_robot.c_str());
}

void check_section(const std::function<void(Section&)>& change, const std::string& sentence) {
  check_section(change, sentence, "sections[0]." + sentence);
}

void check_robot(const std::function<void(Robot&)>& change, const std::string& sentence) {
  Robot robot = amouri2020();
  change(robot);
  CHECK(violations(robot) == Sentences{sentence});
  CHECK_THROWS_SENTENCE(validate(robot), sentence.c_str());
}

TEST_SUITE_BEGIN("validation");

TEST_CASE("sound robots have no violations") {
  Random random;
  for (const NamedRobot& sample : sample_robots(random)) {
    INFO(random, ", robot: ", sample.name);
    CHECK(violations(sample.robot).empty());
    CHECK_NOTHROW(Model{sample.robot});
  }
}

TEST_CASE("fields that must be positive") {
  check_section([](Section& s) { s.length = 0.0; }, "length must be > 0 m and finite, got 0");
  check_section([](Section& s) { s.length = -1.5; }, "length must be > 0 m and finite, got -1.5");
  check_section([](Section& s) { s.length = nan; }, "length must be > 0 m and finite, got nan");
  check_section([](Section& s) { s.length = inf; }, "length must be > 0 m and finite, got inf");
  check_section([](Section& s) { s.backbone_diameter = 0.0; },
                "backbone_diameter must be > 0 m and finite, got 0");
  check_section([](Section& s) { s.youngs_modulus = -9.5e9; },
                "youngs_modulus must be > 0 Pa and finite, got -9500000000");
  check_section([](Section& s) { s.cable_radius = 0.0; },
                "cable_radius must be > 0 m and finite, got 0");
}

TEST_CASE("fields that must not be negative") {
  check_section([](Section& s) { s.backbone_mass = -0.01; },
                "backbone_mass must be >= 0 kg and finite, got -0.01");
  check_section([](Section& s) { s.disk_mass = -0.01; },
                "disk_mass must be >= 0 kg and finite, got -0.01");
  check_section([](Section& s) { s.disk_mass = inf; },
                "disk_mass must be >= 0 kg and finite, got inf");
  check_section([](Section& s) { s.disk_diameter = -0.04; },
                "disk_diameter must be >= 0 m and finite, got -0.04");
  check_section([](Section& s) { s.damping = -1e-3; },
                "damping must be >= 0 N m s/rad and finite, got -0.001");
  check_section(
      [](Section& s) {
        s.cable_angles.clear();
        s.cable_radius = -0.019;
      },
      "cable_radius must be >= 0 m and finite, got -0.019");
}

TEST_CASE("counts") {
  check_section([](Section& s) { s.num_disks = -1; }, "num_disks must be 0 to 64, got -1");
  check_section([](Section& s) { s.num_disks = 65; }, "num_disks must be 0 to 64, got 65");
  check_section([](Section& s) { s.cable_angles.assign(17, 0.0); },
                "the number of cable_angles must be 0 to 16, got 17",
                "the number of sections[0].cable_angles must be 0 to 16, got 17");
  check_robot([](Robot& r) { r.sections.clear(); },
              "the number of sections must be 1 to 32, got 0");
  check_robot([](Robot& r) { r.sections.resize(33, r.sections[0]); },
              "the number of sections must be 1 to 32, got 33");
}

TEST_CASE("fields that must be finite") {
  check_section([](Section& s) { s.cable_angles[1] = inf; },
                "cable_angles[1] must be a finite number of rad, got inf");
  check_robot([](Robot& r) { r.gravity[2] = nan; },
              "gravity[2] must be a finite number of m/s^2, got nan");
}

TEST_CASE("the robot's own fields") {
  check_robot([](Robot& r) { r.payload = -1.0; }, "payload must be >= 0 kg and finite, got -1");
  check_robot([](Robot& r) { r.sections.push_back(r.sections[0]), r.sections[1].damping = -1.0; },
              "sections[1].damping must be >= 0 N m s/rad and finite, got -1");
}

TEST_CASE("every violation has its own sentence, one a line") {
  Robot robot = amouri2020();
  robot.sections[0] = Section();
  robot.sections[0].cable_angles = {0.0};
  robot.payload = -1.0;
  CHECK_THROWS_SENTENCE(validate(robot),
                        "sections[0].length must be > 0 m and finite, got 0\n"
                        "sections[0].backbone_diameter must be > 0 m and finite, got 0\n"
                        "sections[0].youngs_modulus must be > 0 Pa and finite, got 0\n"
                        "sections[0].cable_radius must be > 0 m and finite, got 0\n"
                        "payload must be >= 0 kg and finite, got -1");
}

TEST_CASE("limits themselves are allowed") {
  CHECK(violations_after([](Section& s) { s.num_disks = 0; }).empty());
  CHECK(violations_after([](Section& s) { s.num_disks = 64; }).empty());
  CHECK(violations_after([](Section& s) { s.cable_angles.assign(16, 1.0); }).empty());
  CHECK(violations_after([](Section& s) {
          s.cable_angles.clear();
          s.cable_radius = 0.0;
        }).empty());
  CHECK(violations_after([](Section& s) { s.backbone_mass = s.disk_diameter = 0.0; }).empty());
}

TEST_CASE("more than one section is refused for now") {
  Robot robot = amouri2020();
  robot.sections.push_back(robot.sections[0]);
  CHECK_THROWS_SENTENCE(Model{robot},
                        "Model takes a robot of exactly one section for now, got 2 sections");
}

TEST_CASE("a robot without inertia has no dynamics") {
  Robot robot = amouri2020();
  robot.sections[0].backbone_mass = robot.sections[0].disk_mass = 0.0;
  const Model model(robot);
  CHECK_FALSE(model.has_inertia());
  CHECK_THROWS_SENTENCE(simulate(model, VectorXd::Zero(2), VectorXd::Zero(2),
                                 even_times(0.0, 1.0, 2), no_tension(model)),
                        "the robot has no inertia, so it has no dynamics: give sections[0] a "
                        "backbone_mass or disks with a disk_mass, or the robot a payload");
  robot.payload = 0.1;
  CHECK(Model(robot).has_inertia());
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
