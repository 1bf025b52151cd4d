// Every sentence that refuses bad input, word by word.
#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <sstream>
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
  check_section(change, sentence, "section 1: " + sentence);
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

TEST_CASE("cable fields that must not be negative") {
  check_section([](Section& s) { s.cable_stiffness = -1.0; },
                "cable_stiffness must be >= 0 N/m and finite, got -1");
  check_section([](Section& s) { s.cable_stiffness = inf; },
                "cable_stiffness must be >= 0 N/m and finite, got inf");
  check_section([](Section& s) { s.cable_damping = -0.5; },
                "cable_damping must be >= 0 N s/m and finite, got -0.5");
  check_section([](Section& s) { s.cable_friction = -0.1; },
                "cable_friction must be >= 0 and finite, got -0.1");
}

TEST_CASE("disks one by one") {
  check_section([](Section& s) { s.disk_masses.assign(3, 0.01); },
                "the number of disk_masses must be 0 or the number of disks, 10, got 3",
                "section 1: the number of disk_masses must be 0 or the number of disks, 10, got 3");
  check_section(
      [](Section& s) { s.disk_diameters.assign(1, 0.01); },
      "the number of disk_diameters must be 0 or the number of disks, 10, got 1",
      "section 1: the number of disk_diameters must be 0 or the number of disks, 10, got 1");
  check_section([](Section& s) { s.disk_positions = {0.0, 0.5, 1.0}; },
                "num_disks must be 0 or the number of disk_positions, 3, got 10");
  check_section(
      [](Section& s) {
        s.num_disks = 0;
        s.disk_positions.assign(65, 0.5);
      },
      "the number of disk_positions must be 0 to 64, got 65",
      "section 1: the number of disk_positions must be 0 to 64, got 65");
  for (const double wrong : {-1e-12, 1.5, nan, inf}) {
    Section section = amouri2020().sections[0];
    section.num_disks = 2;
    section.disk_positions = {0.5, wrong};
    std::ostringstream text;
    text << "disk_positions[1] must be 0 to 1, got " << wrong;
    CHECK(violations(section) == Sentences{text.str()});
  }
  check_section(
      [](Section& s) {
        s.disk_masses.assign(10, 0.01);
        s.disk_masses[9] = -0.01;
      },
      "disk_masses[9] must be >= 0 kg and finite, got -0.01");
  check_section(
      [](Section& s) {
        s.disk_diameters.assign(10, 0.01);
        s.disk_diameters[0] = nan;
      },
      "disk_diameters[0] must be >= 0 m and finite, got nan");
}

TEST_CASE("counts") {
  check_section([](Section& s) { s.num_disks = -1; }, "num_disks must be 0 to 64, got -1");
  check_section([](Section& s) { s.num_disks = 65; }, "num_disks must be 0 to 64, got 65");
  check_section([](Section& s) { s.cable_angles.assign(17, 0.0); },
                "the number of cable_angles must be 0 to 16, got 17",
                "section 1: the number of cable_angles must be 0 to 16, got 17");
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
              "section 2: damping must be >= 0 N m s/rad and finite, got -1");
}

TEST_CASE("cables of the robot") {
  const Cable good{0.02, 0.5, 0, 1e4, 1.0, 0.1};
  const auto check = [&](const std::function<void(Cable&)>& change, const std::string& sentence) {
    check_robot(
        [&](Robot& r) {
          r.cables = {good, good};
          change(r.cables[1]);
        },
        "cable 2 of cables: " + sentence);
  };
  check([](Cable& c) { c.radius = 0.0; }, "radius must be > 0 m and finite, got 0");
  check([](Cable& c) { c.angle = inf; }, "angle must be a finite number of rad, got inf");
  check([](Cable& c) { c.end_section = 1; }, "end_section must be 0 to 0, got 1");
  check([](Cable& c) { c.end_section = -1; }, "end_section must be 0 to 0, got -1");
  check([](Cable& c) { c.stiffness = -1.0; }, "stiffness must be >= 0 N/m and finite, got -1");
  check([](Cable& c) { c.damping = nan; }, "damping must be >= 0 N s/m and finite, got nan");
  check([](Cable& c) { c.friction = -0.1; }, "friction must be >= 0 and finite, got -0.1");
  check_robot([&](Robot& r) { r.cables.assign(65, good); },
              "the number of cables must be 0 to 64, got 65");
  check_robot(
      [&](Robot& r) {
        r.sections.resize(2, r.sections[0]);
        r.cables = {good};
        r.cables[0].end_section = 2;
      },
      "cable 1 of cables: end_section must be 0 to 1, got 2");
}

TEST_CASE("base orientation") {
  const std::string sentence = "base_orientation must be a right-handed rotation matrix, to 1e-5, ";
  check_robot([](Robot& r) { r.base_orientation(2, 2) = 1.0001; },
              sentence + "got [[1, 0, 0], [0, 1, 0], [0, 0, 1.0001]]");
  check_robot([](Robot& r) { r.base_orientation(2, 2) = -1.0; },
              sentence + "got [[1, 0, 0], [0, 1, 0], [0, 0, -1]]");
  check_robot([](Robot& r) { r.base_orientation.setConstant(1e200); },
              sentence +
                  "got [[1e+200, 1e+200, 1e+200], [1e+200, 1e+200, 1e+200], "
                  "[1e+200, 1e+200, 1e+200]]");
  check_robot([](Robot& r) { r.base_orientation(1, 2) = nan; },
              "base_orientation[1][2] must be a finite number, got nan");
  Robot robot = amouri2020();
  robot.base_orientation(2, 2) += 4e-6;
  CHECK(violations(robot).empty());
}

TEST_CASE("magnitudes that float64 cannot hold") {
  const auto refuses = [](const std::function<void(Robot&)>& change, const std::string& sentence) {
    Robot robot = amouri2020();
    change(robot);
    CHECK_THROWS_SENTENCE(Model{robot}, doctest::Contains(sentence.c_str()));
  };
  refuses([](Robot& r) { r.sections[0].length = 1.7e308; },
          "the robot must be 1e-150 to 1e+150 m long in all, got 1.7e+308");
  refuses([](Robot& r) { r.sections[0].backbone_diameter = 1e-90; },
          "the stiffness of the robot must be > 0 and finite, got 0");
  refuses([](Robot& r) { r.payload = 1e308, r.sections[0].length = 10.0; },
          "the inertia of the robot must be finite, got a mass of 1e+308 kg");
}

TEST_CASE("base position and tool") {
  check_robot([](Robot& r) { r.base_position[1] = inf; },
              "base_position[1] must be a finite number of m, got inf");
  check_robot([](Robot& r) { r.tool(0, 3) = nan; }, "tool[0][3] must be a finite number, got nan");
  const std::string sentence =
      "tool must be a frame: a right-handed rotation matrix, to 1e-5, with a position beside it "
      "and 0, 0, 0, 1 below, got ";
  check_robot([](Robot& r) { r.tool(2, 2) = -1.0; },
              sentence + "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]]");
  check_robot([](Robot& r) { r.tool(3, 2) = 0.5; },
              sentence + "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0.5, 1]]");
  Robot robot = amouri2020();
  robot.tool(2, 2) += 4e-6;
  CHECK(violations(robot).empty());
  const Matrix3d R = Model(robot).robot().tool.topLeftCorner<3, 3>();
  CHECK((R.transpose() * R - Matrix3d::Identity()).norm() <= 1e-15);
}

TEST_CASE("payload with a body") {
  const auto check = [](const Vector3d& position, const Matrix3d& inertia,
                        const std::string& sentence) {
    check_robot(
        [&](Robot& r) {
          r.payload = 0.1;
          r.payload_position = position;
          r.payload_inertia = inertia;
        },
        sentence);
  };
  const Matrix3d ball = 1e-5 * Matrix3d::Identity();
  check({0.0, inf, 0.0}, ball, "payload_position[1] must be a finite number of m, got inf");
  Matrix3d wrong = ball;
  wrong(0, 2) = nan;
  check(Vector3d::Zero(), wrong,
        "payload_inertia[0][2] must be a finite number of kg m^2, got nan");
  wrong(0, 2) = 2e-14;
  check(Vector3d::Zero(), wrong,
        "payload_inertia must be symmetric, to 1e-9 of its largest entry, got "
        "[[1e-05, 0, 2e-14], [0, 1e-05, 0], [0, 0, 1e-05]]");
  const std::string body =
      "payload_inertia must be that of a body: principal moments >= 0, none above the sum of the "
      "others, got ";
  check(Vector3d::Zero(), Vector3d(1.0, 2.0, 3.5).asDiagonal(), body + "[1, 2, 3.5]");
  check(Vector3d::Zero(), Vector3d(1.0, -1.0, 1.0).asDiagonal(), body + "[-1, 1, 1]");
  Robot robot = amouri2020();
  robot.payload = 0.1;
  for (const double scale : {1e-320, 1e-5, 1e300}) {  // a rod has the limit: 0, 1, 1
    robot.payload_inertia = Vector3d(scale, 0.0, scale).asDiagonal();
    CHECK(violations(robot).empty());
  }
}

TEST_CASE("no payload, nothing that belongs to one") {
  check_robot([](Robot& r) { r.payload_position = {0.0, 0.0, 0.01}; },
              "payload_position must be zero where the payload is zero, got [0, 0, 0.01]");
  check_robot([](Robot& r) { r.payload_inertia.setIdentity(); },
              "payload_inertia must be zero where the payload is zero, got "
              "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
}

TEST_CASE("sliding speed") {
  check_robot([](Robot& r) { r.sliding_speed = 0.0; },
              "sliding_speed must be > 0 m/s and finite, got 0");
}

TEST_CASE("every violation has its own sentence, one a line") {
  Robot robot = amouri2020();
  robot.sections[0] = Section();
  robot.sections[0].cable_angles = {0.0};
  robot.payload = -1.0;
  CHECK_THROWS_SENTENCE(validate(robot),
                        "section 1: length must be > 0 m and finite, got 0\n"
                        "section 1: backbone_diameter must be > 0 m and finite, got 0\n"
                        "section 1: youngs_modulus must be > 0 Pa and finite, got 0\n"
                        "section 1: cable_radius must be > 0 m and finite, got 0\n"
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
  CHECK(violations_after([](Section& s) {
          s.disk_positions.assign(10, 1.0);
          s.disk_positions[4] = 0.0;
        }).empty());
}

TEST_CASE("a robot without inertia has no dynamics") {
  Robot robot = amouri2020();
  robot.sections[0].backbone_mass = robot.sections[0].disk_mass = 0.0;
  const Model model(robot);
  CHECK_FALSE(model.has_inertia());
  CHECK_THROWS_SENTENCE(simulate(model, VectorXd::Zero(2), VectorXd::Zero(2),
                                 even_times(0.0, 1.0, 2), no_tension(model)),
                        "the robot has no dynamics, because section 1 can bend without moving "
                        "any mass: give it a backbone_mass or disks with a disk_mass, or the robot "
                        "a payload");
  robot.payload = 0.1;
  CHECK(Model(robot).has_inertia());
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
