#include "cases.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace cdcr::test {
namespace {

constexpr int num_random_states = 3;

Robot upright(double g) {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, -g};
  return robot;
}

/// A robot changed in place by `change(robot, its section)`.
template <class Change>
Robot changed(Robot robot, Change change) {
  change(robot, robot.sections[0]);
  return robot;
}

std::vector<double> spread_angles(int count) {
  std::vector<double> angles;
  for (int j = 0; j < count; ++j) angles.push_back(2.0 * pi * j / count);
  return angles;
}

bool coin(Random& random) {
  return random.uniform(0.0, 1.0) < 0.5;
}

Matrix3d random_rotation(Random& random) {
  const Vector3d axis = random.vector(3, 1.0);
  return Eigen::AngleAxisd(random.uniform(-pi, pi), axis.normalized()).toRotationMatrix();
}

/// A section about as long, heavy and stiff as the model one.
Section varied(const Section& model, Random& random) {
  const auto near = [&](double value) { return value * random.logarithmic(0.5, 2.0); };
  Section s = model;
  s.length = near(s.length);
  s.backbone_mass = near(s.backbone_mass);
  s.backbone_diameter = near(s.backbone_diameter);
  s.youngs_modulus = near(s.youngs_modulus);
  s.disk_mass = near(s.disk_mass);
  s.disk_diameter = near(s.disk_diameter);
  s.num_disks = random.integer(0, 8);
  s.cable_radius = 0.4 * s.disk_diameter;
  s.damping = near(s.damping);
  for (int j = random.integer(0, 4); j > 0; --j) s.cable_angles.push_back(random.uniform(-7, 7));
  if (coin(random)) return s;
  s.num_disks = 0;
  for (int k = random.integer(1, 6); k > 0; --k) {
    s.disk_positions.push_back(random.uniform(0.0, 1.0));
    s.disk_masses.push_back(near(s.disk_mass));
    s.disk_diameters.push_back(near(s.disk_diameter));
  }
  std::sort(s.disk_positions.begin(), s.disk_positions.end());
  return s;
}

/// A box of any size and attitude, its centre up to `reach` from the tip.
void add_payload(Robot& robot, double mass, double reach, Random& random) {
  robot.payload = mass;
  robot.payload_position = random.vector(3, reach);
  const Vector3d squares = random.vector(3, reach).cwiseAbs2();
  const Vector3d inertia = mass / 12.0 * (Vector3d::Constant(squares.sum()) - squares);
  const Matrix3d R = random_rotation(random);
  const Matrix3d turned = R * inertia.asDiagonal() * R.transpose();
  robot.payload_inertia = 0.5 * (turned + turned.transpose());
}

}  // namespace

double Random::logarithmic(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

int Random::integer(int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(engine_);
}

VectorXd Random::vector(Index size, double magnitude) {
  VectorXd v(size);
  for (Index i = 0; i < size; ++i) v[i] = uniform(-magnitude, magnitude);
  return v;
}

Robot random_robot(Random& random) {
  Section s;
  s.length = random.logarithmic(0.02, 3.0);
  s.backbone_mass = random.logarithmic(1e-4, 1.0);
  s.backbone_diameter = s.length * random.logarithmic(1e-3, 0.1);
  s.youngs_modulus = random.logarithmic(1e6, 2e11);
  s.disk_mass = random.logarithmic(1e-4, 0.1);
  s.disk_diameter = s.length * random.logarithmic(0.01, 0.5);
  s.num_disks = random.integer(0, 64);
  s.cable_radius = 0.4 * s.disk_diameter;
  for (int j = random.integer(0, 16); j > 0; --j) s.cable_angles.push_back(random.uniform(-7, 7));
  s.damping = random.uniform(0.0, 1.0) < 0.5 ? 0.0 : random.logarithmic(1e-5, 1e-1);
  Robot robot;
  robot.sections = {s};
  robot.gravity = random.vector(3, 10.0);
  robot.payload = random.uniform(0.0, 1.0) < 0.5 ? 0.0 : random.logarithmic(1e-3, 1.0);
  return robot;
}

Robot random_chain(Random& random, int n) {
  Section model;
  model.length = random.logarithmic(0.05, 1.0);
  model.backbone_mass = random.logarithmic(1e-3, 0.1);
  model.backbone_diameter = model.length * random.logarithmic(5e-3, 0.05);
  model.youngs_modulus = random.logarithmic(1e6, 2e11);
  model.disk_mass = model.backbone_mass * random.logarithmic(0.1, 3.0);
  model.disk_diameter = model.length * random.logarithmic(0.05, 0.4);
  model.damping = coin(random) ? 0.0 : random.logarithmic(1e-5, 1e-2);
  Robot robot;
  for (int i = 0; i < n; ++i) robot.sections.push_back(varied(model, random));
  robot.gravity = random.vector(3, 10.0);
  robot.base_orientation = random_rotation(random);
  const double mass = model.backbone_mass * random.logarithmic(0.1, 5.0);
  if (coin(random)) add_payload(robot, mass, 0.3 * model.length, random);
  for (int j = random.integer(0, 3); j > 0; --j) {
    robot.cables.push_back({0.2 * model.disk_diameter, random.uniform(-7, 7),
                            random.integer(0, n - 1), 0.0, 0.0, std::nullopt});
  }
  return robot;
}

std::vector<NamedRobot> sample_robots(Random& random) {
  const Robot table_1 = amouri2020();
  std::vector<NamedRobot> robots = {
      {"Table 1", table_1},
      {"upright", upright(9.81)},
      {"hanging", upright(-9.81)},
      {"tilted, damped, with payload", changed(upright(9.81),
                                               [](Robot& robot, Section& section) {
                                                 robot.gravity = {3.0, -4.0, -8.0};
                                                 robot.payload = 0.05;
                                                 section.damping = 1e-3;
                                               })},
      {"massless backbone",
       changed(upright(9.81), [](Robot&, Section& section) { section.backbone_mass = 0.0; })},
      {"no disks", changed(upright(9.81), [](Robot&, Section& section) { section.num_disks = 0; })},
      {"payload only", changed(upright(9.81),
                               [](Robot& robot, Section& section) {
                                 section.backbone_mass = section.disk_mass = 0.0;
                                 robot.payload = 0.1;
                               })},
      {"16 cables",
       changed(table_1,
               [](Robot&, Section& section) { section.cable_angles = spread_angles(16); })},
      {"no cables",
       changed(table_1, [](Robot&, Section& section) { section.cable_angles.clear(); })},
      {"64 disks",
       changed(upright(9.81), [](Robot&, Section& section) { section.num_disks = 64; })},
      {"one wide disk", changed(table_1,
                                [](Robot&, Section& section) {
                                  section.num_disks = 1;
                                  section.disk_diameter = 1.0;
                                })},
  };
  for (int i = 0; i < test_count(); ++i) {
    robots.push_back({"random " + std::to_string(i), random_robot(random)});
  }
  return robots;
}

std::vector<State> sample_states(const Model& model, double max_theta, Random& random) {
  std::vector<double> thetas = {0.0, 1e-9, 1e-4};
  for (int i = 0; i < num_random_states; ++i) thetas.push_back(random.uniform(0.0, max_theta));
  std::vector<State> states;
  for (const double theta : thetas) {
    const double phi = random.uniform(-pi, pi);
    State state;
    state.theta = theta;
    state.q = Eigen::Vector2d(theta * std::cos(phi), theta * std::sin(phi));
    state.qd = random.vector(model.num_coordinates(), 10.0);
    // Tensions that alone would bend the section by up to about a turn.
    const Section& section = model.robot().sections[0];
    const double strong =
        section.cable_radius > 0.0 ? model.stiffness()[0] / section.cable_radius : 0.0;
    state.tension = random.vector(model.num_cables(), 3.0 * strong).cwiseAbs();
    states.push_back(state);
  }
  return states;
}

}  // namespace cdcr::test
