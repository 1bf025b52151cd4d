// The closed form of one section: from a tip position back to the bending vector, and to the
// nearest one where there is none.
#include <doctest/doctest.h>

#include <cmath>

#include "cdcr/inverse_kinematics.hpp"
#include "support/cases.hpp"
#include "support/inverse_checks.hpp"
#include "support/residual.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

/// Smallest distance from p to a tip position, on a grid of theta as fine as `num_points`.
double nearest_on_grid(const Model& model, const Vector3d& p, int num_points) {
  const double phi = std::atan2(p[1], p[0]);
  double nearest = (tip(model, Eigen::Vector2d::Zero()).p - p).norm();
  for (int i = 1; i <= num_points; ++i) {
    const double theta = full_circle * i / num_points;
    const Eigen::Vector2d q(theta * std::cos(phi), theta * std::sin(phi));
    nearest = std::min(nearest, (tip(model, q).p - p).norm());
  }
  return nearest;
}

TEST_SUITE_BEGIN("inverse_one_section");

TEST_CASE("round trip through reachable points") {
  Random random;
  for_each_case(full_circle, [&](const Model& model, Data&, const State& state) {
    const double length = model.robot().sections[0].length;
    const Vector3d p = tip(model, state.q).p;
    const InverseKinematics answer = inverse_kinematics(model, p);
    check_consistent(model, p, answer);
    CHECK(answer.reachable);
    CHECK(residual(answer.position, p, length) <= tolerance::rounding);
    // The tip moves by l/(2 theta) and more for each radian, so q is known as well as p.
    CHECK(residual(answer.q, state.q, full_circle * full_circle) <= tolerance::rounding);
  });
}

TEST_CASE("a point off the surface gives the nearest point of it") {
  Random random;
  const Model model(amouri2020());
  const double length = model.robot().sections[0].length;
  constexpr int num_points = 20000;
  // Between grid points, the distance can be smaller than on them by the sagitta of the spacing.
  const double spacing = full_circle / num_points;
  for (int i = 0; i < 10 * test_count(); ++i) {
    const Vector3d p = 1.5 * length * random.vector(3, 1.0);
    INFO(random, ", p = ", p.transpose());
    const InverseKinematics answer = inverse_kinematics(model, p);
    check_consistent(model, p, answer);
    CHECK_FALSE(answer.reachable);
    const double nearest = nearest_on_grid(model, p, num_points);
    CHECK(answer.distance <= nearest + tolerance::rounding * length);
    CHECK(answer.distance >= nearest - spacing * length);
    // Bent in the plane of the point, towards it.
    const double cross = answer.q[0] * p[1] - answer.q[1] * p[0];
    CHECK(residual(cross, 0.0, p.norm()) <= tolerance::rounding);
    CHECK(answer.q.dot(p.head<2>()) >= 0.0);
  }
}

TEST_CASE("the nearest point is stationary or at the end of the range") {
  Random random;
  const Model model(amouri2020());
  for (const double max_theta : {full_circle, 1.0}) {
    InverseKinematicsOptions options;
    options.max_theta = VectorXd::Constant(1, max_theta);
    for (int i = 0; i < 10 * test_count(); ++i) {
      const Vector3d p = random.vector(3, 1.0);
      INFO(random, ", p = ", p.transpose());
      const InverseKinematics answer = inverse_kinematics(model, p, {}, {}, options);
      check_consistent(model, p, answer, max_theta);
      const double theta = answer.q.norm();
      if (theta == 0.0) continue;
      const Pull towards = pull(model, answer, p, 0);
      if (theta >= max_theta * (1.0 - 1e-12)) {
        CHECK(towards.outward >= 0.0);
      } else {
        CHECK(residual(towards.outward, 0.0, 1.0) <= tolerance::stationary);
      }
    }
  }
}

TEST_CASE("points on the Z axis take phi = 0") {
  const Model model(amouri2020());
  const double length = model.robot().sections[0].length;

  SUBCASE("the straight tip") {
    const InverseKinematics answer = inverse_kinematics(model, {0.0, 0.0, length});
    CHECK(answer.reachable);
    CHECK(answer.q == Eigen::Vector2d::Zero());
  }
  SUBCASE("above it") {
    const InverseKinematics answer = inverse_kinematics(model, {0.0, 0.0, 2.0 * length});
    CHECK_FALSE(answer.reachable);
    CHECK(answer.q == Eigen::Vector2d::Zero());
    CHECK(residual(answer.distance, length) <= tolerance::rounding);
  }
  SUBCASE("the base, where a full circle ends") {
    const InverseKinematics answer = inverse_kinematics(model, Vector3d::Zero());
    CHECK(answer.reachable);
    CHECK(residual(answer.q, Eigen::Vector2d(full_circle, 0.0)) <= tolerance::rounding);
  }
  SUBCASE("half way up and below the base") {
    for (const double z : {0.5 * length, -0.1 * length, -2.0 * length}) {
      INFO("z = ", z);
      const Vector3d p(0.0, 0.0, z);
      const InverseKinematics answer = inverse_kinematics(model, p);
      check_consistent(model, p, answer);
      CHECK_FALSE(answer.reachable);
      CHECK(answer.q[1] == 0.0);
      CHECK(answer.distance <= nearest_on_grid(model, p, 5000) + tolerance::rounding * length);
    }
  }
}

TEST_CASE("a point below the base that the tip can touch") {
  const Model model(amouri2020());
  const Eigen::Vector2d q(0.0, 1.4 * pi);
  const Vector3d p = tip(model, q).p;
  REQUIRE(p[2] < 0.0);
  const InverseKinematics answer = inverse_kinematics(model, p);
  CHECK(answer.reachable);
  CHECK(residual(answer.q, q) <= tolerance::rounding);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
