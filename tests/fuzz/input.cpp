#include "input.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace cdcr::fuzz {

double Input::wild(double usual) {
  using Limits = std::numeric_limits<double>;
  wild_ = true;
  const double values[] = {-usual,
                           1e-12 * usual,
                           1e12 * usual,
                           1e-150,
                           1e150,
                           1e-300,
                           1e300,
                           Limits::max(),
                           Limits::lowest(),
                           Limits::min(),
                           Limits::denorm_min(),
                           Limits::infinity(),
                           -1e-3 * usual,
                           Limits::quiet_NaN(),
                           -Limits::infinity(),
                           Limits::epsilon()};
  const int b = byte();
  if (b < 192) return values[b % 16];
  std::uint8_t bits[sizeof(double)];
  for (std::uint8_t& part : bits) part = byte();
  double value = 0.0;
  std::memcpy(&value, bits, sizeof value);
  return value;
}

Section Input::section() {
  Section s = amouri2020().sections[0];
  const int parts = byte();
  if ((parts & 1) != 0) {
    s.length = positive(s.length);
    s.backbone_mass = positive(s.backbone_mass);
    s.backbone_diameter = positive(s.backbone_diameter);
    s.youngs_modulus = positive(s.youngs_modulus);
  }
  if ((parts & 2) != 0) {
    s.disk_mass = positive(s.disk_mass);
    s.disk_diameter = positive(s.disk_diameter);
    s.num_disks = integer(-1, 65);
  }
  if ((parts & 4) != 0) {
    s.cable_radius = positive(s.cable_radius);
    s.cable_angles.clear();
    for (int j = integer(0, rare() ? 17 : 5); j > 0; --j) s.cable_angles.push_back(number(2.0));
  }
  if ((parts & 8) != 0) s.damping = positive(1e-3);
  if ((parts & 16) != 0) {
    s.cable_stiffness = positive(1e3);
    s.cable_damping = positive(1.0);
  }
  if ((parts & 32) != 0) s.cable_friction = positive(0.1);
  if ((parts & 64) != 0) {
    s.num_disks = 0;
    for (int k = integer(0, 6); k > 0; --k) {
      s.disk_positions.push_back(number(0.2));
      s.disk_masses.push_back(positive(s.disk_mass));
      if (coin()) s.disk_diameters.push_back(positive(s.disk_diameter));
    }
  }
  if ((parts & 128) != 0) s.backbone_mass = s.disk_mass = 0.0;
  return s;
}

Cable Input::cable(int num_sections) {
  Cable cable;
  cable.radius = positive(0.01);
  cable.angle = number(1.0);
  cable.end_section = integer(rare() ? -1 : 0, std::max(0, num_sections - (rare() ? 0 : 1)));
  if (coin()) cable.stiffness = positive(1e3);
  if (coin()) cable.damping = positive(1.0);
  if (coin()) cable.friction = positive(0.1);
  return cable;
}

void Input::add_payload(Robot& robot) {
  robot.payload = positive(0.1);
  robot.payload_position = vector3(0.01);
  const int kind = byte();
  if (kind % 4 == 1) robot.payload_inertia = positive(1e-5) * Matrix3d::Identity();
  if (kind % 4 == 2) robot.payload_inertia = vector3(1e-5).asDiagonal();
  if (kind % 4 == 3) robot.payload_inertia = vector(9, 1e-5).reshaped(3, 3);
}

Robot Input::robot() {
  constexpr int rare_numbers[] = {0, 4, 5, 8, 16, 32, 33};
  Robot robot;
  const int b = byte();
  const int n = b < 249 ? 1 + b % 3 : rare_numbers[b - 249];
  for (int i = 0; i < n; ++i) {
    robot.sections.push_back(i > 0 && coin() ? robot.sections[0] : section());
  }
  const int parts = byte();
  if ((parts & 1) != 0) robot.gravity = vector3(10.0);
  if ((parts & 2) != 0) add_payload(robot);
  if ((parts & 4) != 0) {
    for (int j = integer(0, 4); j > 0; --j) robot.cables.push_back(cable(n));
  }
  if ((parts & 8) != 0) {
    robot.base_orientation =
        Eigen::AngleAxisd(number(1.0), vector3(1.0).normalized()).toRotationMatrix();
  }
  if ((parts & 16) != 0) robot.base_orientation = vector(9, 1.0).reshaped(3, 3);
  if ((parts & 32) != 0) robot.sliding_speed = positive(1e-3);
  if ((parts & 64) != 0) robot.base_position = vector3(1.0);
  if ((parts & 128) != 0) robot.tool.topRightCorner<3, 1>() = vector3(0.1);
  return robot;
}

std::optional<Model> Input::model() {
  const Robot made = robot();
  const auto formulation = rare() ? static_cast<Formulation>(integer(0, 3)) : Formulation::exact;
  std::optional<Model> model;
  attempt([&] { model.emplace(made, formulation); });
  demand(!model || violations(made).empty(), "a model of a robot with violations");
  return model;
}

Wrenches Input::wrenches(const Model& model, int most) {
  Wrenches wrenches;
  for (int k = integer(0, most); k > 0; --k) {
    Wrench wrench;
    const auto beyond = static_cast<int>(model.num_sections());
    wrench.section = integer(rare() ? -1 : 0, rare() ? beyond : beyond - 1);
    wrench.fraction = coin() ? 1.0 : number(0.2);
    wrench.force = vector3(1.0);
    if (coin()) wrench.moment = vector3(0.1);
    wrench.frame = coin() ? Wrench::Frame::local : Wrench::Frame::base;
    wrenches.push_back(wrench);
  }
  return wrenches;
}

}  // namespace cdcr::fuzz
