// Frames, their Jacobian and the cables, against the paper's trigonometric formulas.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "cdcr/kinematics.hpp"
#include "support/cases.hpp"
#include "support/element_sum.hpp"
#include "support/residual.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

/// Paper eqs. (1), (2) as printed; theta must not be zero.
Frame printed_frame(Real length, Real x, Real theta, Real phi) {
  const Real s = x * length, theta_s = x * theta;
  Frame frame;
  frame.r << s / theta_s * (1.0L - std::cos(theta_s)) * std::cos(phi),
      s / theta_s * (1.0L - std::cos(theta_s)) * std::sin(phi), s / theta_s * std::sin(theta_s);
  const auto about_z = [](Real angle) {
    return Eigen::AngleAxis<Real>(angle, Real3::UnitZ()).toRotationMatrix();
  };
  const Real33 about_y = Eigen::AngleAxis<Real>(theta_s, Real3::UnitY()).toRotationMatrix();
  frame.R = about_z(phi) * about_y * about_z(-phi);
  return frame;
}

void check_frame(const Pose& pose, const Frame& expected, double length) {
  CHECK(residual(pose.p, expected.r, length) <= tolerance::rounding);
  CHECK(residual(pose.R, expected.R) <= tolerance::rounding);
}

TEST_SUITE_BEGIN("kinematics");

TEST_CASE("the frame is that of the paper's equations 1 and 2") {
  Random random;
  for_each_case(3.0 * pi, [&](const Model& model, Data&, const State& state) {
    if (state.theta < 0.01) return;
    const double length = model.robot().sections[0].length, x = random.uniform(0.1, 1.0);
    const Real2 q = state.q.cast<Real>();
    const Frame expected = printed_frame(length, x, std::hypot(q[0], q[1]), std::atan2(q[1], q[0]));
    check_frame(pose(model, state.q, 0, x), expected, length);
  });
}

TEST_CASE("the frame is smooth through the straight section") {
  const Model model(amouri2020());
  const double length = model.robot().sections[0].length;
  for (const double theta : {0.0, 1e-300, 1e-160, 1e-9, 1e-4, 1e-2, 0.5, 0.7071, 0.7072, 1.0}) {
    for (const double phi : {0.0, 0.3, 2.0, -2.5}) {
      for (const double x : {1e-6, 0.25, 1.0}) {
        INFO("theta = ", theta, ", phi = ", phi, ", fraction = ", x);
        const Eigen::Vector2d q(theta * std::cos(phi), theta * std::sin(phi));
        check_frame(pose(model, q, 0, x), frame_at(length, x, q.cast<Real>()), length);
      }
    }
  }
}

TEST_CASE("the base does not move and the tip is the end of the last section") {
  for_each_case(3.0 * pi, [](const Model& model, Data&, const State& state) {
    const Pose base = pose(model, state.q, 0, 0.0);
    CHECK(base.p == Vector3d::Zero());
    CHECK(base.R == Matrix3d::Identity());
    const Pose end = pose(model, state.q, 0, 1.0);
    CHECK(tip(model, state.q).p == end.p);
    CHECK(tip(model, state.q).R == end.R);
  });
}

TEST_CASE("rotations are orthonormal and right-handed") {
  Random random;
  for_each_case(3.0 * pi, [&](const Model& model, Data&, const State& state) {
    const Matrix3d R = pose(model, state.q, 0, random.uniform(0.0, 1.0)).R;
    CHECK(residual(R.transpose() * R, Matrix3d::Identity()) <= tolerance::rounding);
    CHECK(residual(R.determinant(), 1.0) <= tolerance::rounding);
  });
}

TEST_CASE("the Jacobian is the derivative of the frame") {
  Random random;
  for_each_case(3.0 * pi, [&](const Model& model, Data&, const State& state) {
    const double length = model.robot().sections[0].length, x = random.uniform(0.0, 1.0);
    MatrixXd J(6, 2);
    jacobian(model, state.q, 0, x, J);
    const Real2 q = state.q.cast<Real>();
    const Real33 R = frame_at(length, x, q).R;
    for (int k = 0; k < 2; ++k) {
      const auto moved = [&](Real step) { return frame_at(length, x, q + step * Real2::Unit(k)); };
      const Real3 v = derivative<Real3>([&](Real step) -> Real3 { return moved(step).r; });
      const Real33 rate =
          derivative<Real33>([&](Real step) -> Real33 { return moved(step).R; }) * R.transpose();
      const Real3 omega(rate(2, 1), rate(0, 2), rate(1, 0));
      CHECK(residual(J.col(k).head<3>(), v, length) <= tolerance::rounding);
      CHECK(residual(J.col(k).tail<3>(), omega, 1.0) <= tolerance::rounding);
    }
  });
}

TEST_CASE("a cable is shorter than the backbone by r theta cos(gamma - phi)") {
  for_each_case(3.0 * pi, [](const Model& model, Data&, const State& state) {
    const Section& section = model.robot().sections[0];
    VectorXd lengths(model.num_cables());
    cable_lengths(model, state.q, lengths);
    const double phi = std::atan2(state.q[1], state.q[0]);
    for (Index j = 0; j < lengths.size(); ++j) {
      const double gamma = section.cable_angles[j];
      const double expected =
          section.length - section.cable_radius * state.theta * std::cos(gamma - phi);
      CHECK(residual(lengths[j], expected, section.length) <= tolerance::rounding);
      CHECK(model.straight_lengths()[j] == section.length);
    }
  });
}

TEST_CASE("a cable length is the length of its path through the bent section") {
  const Model model(amouri2020());
  const Section& section = model.robot().sections[0];
  const Eigen::Vector2d q(1.1, -0.7);
  VectorXd lengths(3);
  cable_lengths(model, q, lengths);
  for (Index j = 0; j < 3; ++j) {
    const Real gamma = section.cable_angles[j], r = section.cable_radius;
    const Real3 hole(r * std::cos(gamma), r * std::sin(gamma), 0.0L);
    Real path = 0.0L;
    for (int i = 0; i < num_gauss; ++i) {
      const auto point = [&](Real step) -> Real3 {
        const Frame at = frame_at(section.length, gauss().node[i] + step, q.cast<Real>());
        return at.r + at.R * hole;
      };
      path += gauss().weight[i] * derivative<Real3>(point, 1e-3L).norm();
    }
    CHECK(residual(lengths[j], path) <= tolerance::rounding);
  }
}

TEST_CASE("tensions give the generalised force that their cables' power asks for") {
  for_each_case(3.0 * pi, [](const Model& model, Data&, const State& state) {
    const Index num_cables = model.num_cables();
    VectorXd ahead(num_cables), behind(num_cables);
    cable_lengths(model, state.q + state.qd, ahead);
    cable_lengths(model, state.q - state.qd, behind);
    const VectorXd rate = 0.5 * (ahead - behind);  // lengths are linear in q
    const VectorXd expected = -model.actuation_matrix().transpose() * state.qd;
    const double scale = model.robot().sections[0].length + largest(expected);
    CHECK(residual(rate, expected, scale) <= tolerance::rounding);
  });
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
