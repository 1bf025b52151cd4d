// Closed forms of the origin: Amouri, Mahfoudi, Zaatri, IJETI 2020, doi 10.46604/ijeti.2020.4422.
//
// Each factor H_i multiplies one mass or moment of inertia in M11 (of theta) or M22 (of phi).
// Robots that have nothing but that mass bring it out alone.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "cdcr/dynamics.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

using std::cos;
using std::sin;

/// So thin that its turning inertia vanishes beside its mass.
constexpr double hair = 1e-12;
const std::vector<double> angles = {0.3, 0.6 * pi, 1.0, 2.0, pi, 4.0, 2.0 * pi};

Robot empty_robot() {
  Robot robot = amouri2020();
  robot.sections[0].backbone_mass = robot.sections[0].disk_mass = 0.0;
  robot.sections[0].backbone_diameter = hair;
  return robot;
}

struct Inertia {
  double M11, M22;
};

/// Mass matrix in theta and phi: with q = (theta, 0), M11 = M_xx and M22 = theta^2 M_yy.
Inertia polar_inertia(const Robot& robot, double theta) {
  const Model model(robot);
  Data data(model);
  MatrixXd M(2, 2);
  mass_matrix(model, data, Eigen::Vector2d(theta, 0.0), M);
  return {M(0, 0), theta * theta * M(1, 1)};
}

TEST_SUITE_BEGIN("paper");

TEST_CASE("translation of the backbone: H1/3 and H2/4, equations 9 to 11") {
  Robot robot = empty_robot();
  Section& section = robot.sections[0];
  section.backbone_mass = 0.0326;
  const double m_l2 = section.backbone_mass * section.length * section.length;
  for (const double t : angles) {
    INFO("theta = ", t);
    const double H1 = (t * t * t + 6.0 * t - 12.0 * sin(t) + 6.0 * t * cos(t)) / std::pow(t, 5);
    const double H2 = (6.0 * t - 8.0 * sin(t) + sin(2.0 * t)) / std::pow(t, 3);
    const Inertia inertia = polar_inertia(robot, t);
    // H1 and H2 cancel at small theta; the scales are their values near the straight robot.
    CHECK(residual(inertia.M11, m_l2 * H1 / 3.0, m_l2 / 20.0) <= tolerance::printed);
    CHECK(residual(inertia.M22, m_l2 * H2 / 4.0, m_l2 / 20.0) <= tolerance::printed);
  }
}

TEST_CASE("turning of the backbone: 1/3 and H4, equations 14 and 26, and its spin") {
  Robot robot = empty_robot();
  Section& section = robot.sections[0];
  section.backbone_mass = 0.0326;
  const auto thin = [&](double t) {
    section.backbone_diameter = hair;
    return polar_inertia(robot, t);
  };
  const auto thick = [&](double t) {
    section.backbone_diameter = 2.0;
    return polar_inertia(robot, t);
  };
  // Rotary inertia m d^2/16 in place of the printed l I_b; axial inertia twice that.
  const double transverse = section.backbone_mass * 2.0 * 2.0 / 16.0, axial = 2.0 * transverse;
  for (const double t : angles) {
    INFO("theta = ", t);
    const double H4 = 0.5 - t * sin(2.0 * t) / (4.0 * t * t);
    // int (1 - cos x t)^2 dx: the frame of eq. (2) also turns about its own tangent.
    const double spin = 1.5 - 2.0 * sin(t) / t + sin(2.0 * t) / (4.0 * t);
    const Inertia with = thick(t), without = thin(t);
    CHECK(residual(with.M11 - without.M11, transverse / 3.0) <= tolerance::printed);
    CHECK(residual(with.M22 - without.M22 - axial * spin, transverse * H4, axial) <=
          tolerance::printed);
  }
}

TEST_CASE("translation of the disks: twice the printed H5 and H6, equations 15, 27, 28") {
  Robot robot = empty_robot();
  Section& section = robot.sections[0];
  section.disk_mass = 0.0082;
  section.disk_diameter = 0.0;
  const double m_l2 = section.disk_mass * section.length * section.length;
  for (const double t : angles) {
    INFO("theta = ", t);
    double H5 = 400.0 + 77.0 * t * t, H6 = 30.0;
    for (int k = 1; k <= 10; ++k) {
      H5 -= 40.0 * cos(0.1 * k * t) + 4.0 * k * t * sin(0.1 * k * t);
      // In H6 the cosines of even tenths meet those of the doubled angles: -4 + 1 = -3.
      H6 += cos(0.2 * k * t) - 4.0 * cos(0.1 * k * t);
    }
    H5 /= 40.0 * std::pow(t, 4);
    H6 /= 4.0 * t * t;
    const Inertia inertia = polar_inertia(robot, t);
    CHECK(residual(inertia.M11, m_l2 * 2.0 * H5, m_l2) <= tolerance::printed);
    CHECK(residual(inertia.M22, m_l2 * 2.0 * H6, m_l2) <= tolerance::printed);
  }
}

TEST_CASE("turning of the disks: 77/20 and H8, equations 16 and 30, and their spin") {
  Robot robot = empty_robot();
  Section& section = robot.sections[0];
  section.disk_mass = 0.0082;
  const auto with_diameter = [&](double d, double t) {
    section.disk_diameter = d;
    return polar_inertia(robot, t);
  };
  constexpr double d = 2.0;
  const double I_xx = section.disk_mass * d * d / 16.0, I_zz = 2.0 * I_xx;
  for (const double t : angles) {
    INFO("theta = ", t);
    double H8 = 0.0, spin = 0.0;
    for (int k = 1; k <= 10; ++k) {
      H8 += sin(0.1 * k * t) * sin(0.1 * k * t);
      spin += (1.0 - cos(0.1 * k * t)) * (1.0 - cos(0.1 * k * t));
    }
    const Inertia with = with_diameter(d, t), without = with_diameter(0.0, t);
    CHECK(residual(with.M11 - without.M11, I_xx * 77.0 / 20.0) <= tolerance::printed);
    CHECK(residual(with.M22 - without.M22 - I_zz * spin, I_xx * H8, 10.0 * I_xx) <=
          tolerance::printed);
  }
}

TEST_CASE("the inertia of the straight robot does not depend on the direction") {
  constexpr double theta = 1e-4;  // what remains is of the order of theta^2
  const Inertia inertia = polar_inertia(amouri2020(), theta);
  CHECK(residual(inertia.M11, inertia.M22 / (theta * theta)) <= theta * theta);
}

TEST_CASE("elastic energy and stiffness, equations 18 and 23") {
  const Model model(amouri2020());
  Data data(model);
  const double EI = 9.5e9 * pi * std::pow(0.005, 4) / 64.0;
  CHECK(std::abs(EI - 0.291456) <= 0.5e-6);  // to the digits given
  CHECK(residual(model.stiffness()[0], EI / 0.802) <= tolerance::rounding);
  const Eigen::Vector2d q(0.3, -1.1);
  CHECK(residual(potential_energy(model, data, q), 0.5 * EI / 0.802 * q.squaredNorm()) <=
        tolerance::rounding);
}

TEST_CASE("generalised forces in theta and phi, equations 19 and 24") {
  const Model model(amouri2020());
  const double r = 0.019, t = 0.8;
  const Eigen::Vector3d F(3.0, 2.0, 0.0);
  for (const double phi : {0.0, 0.5, 2.0 * pi / 3.0}) {
    const Eigen::Vector2d Q = model.actuation_matrix() * F;
    const double Q1 = Q[0] * cos(phi) + Q[1] * sin(phi);
    const double Q2 = t * (Q[1] * cos(phi) - Q[0] * sin(phi));
    const double gamma = 2.0 * pi / 3.0;
    CHECK(residual(Q1, F[0] * r * cos(phi) + F[1] * r * cos(gamma - phi), r) <=
          tolerance::rounding);
    CHECK(residual(Q2, -F[0] * r * t * sin(phi) + F[1] * r * t * sin(gamma - phi), r) <=
          tolerance::rounding);
  }
}

TEST_CASE("the share of gravity is far above the printed 0.27 per cent") {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  const Model upright(robot);
  Data data(upright);
  const auto share = [&](double t) {
    const Eigen::Vector2d q(t, 0.0), straight(0.0, 0.0);
    const double elastic = 0.5 * upright.stiffness()[0] * t * t;
    const double weight = potential_energy(upright, data, q) - elastic;
    return std::abs(weight - potential_energy(upright, data, straight)) / elastic;
  };
  CHECK(residual(share(0.01), 0.238) <= 0.02);
  CHECK(residual(share(0.6 * pi), 0.210) <= 0.02);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
