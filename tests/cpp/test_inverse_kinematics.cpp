// From a tip back to bending vectors, and to the nearest ones where there are none.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "cdcr/inverse_kinematics.hpp"
#include "support/allocations.hpp"
#include "support/cases.hpp"
#include "support/inverse_checks.hpp"
#include "support/residual.hpp"
#include "support/throws.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

/// Targets of a round trip for each number of sections.
constexpr int num_targets = 2000;
/// Sections of round-trip targets bend by no more than this [rad].
constexpr double usual_bending = 2.5;
/// Slope of the squared distance where a search ends, in units of the residual and the length:
/// it stops at 1e-13, or where steps of this size are lost in rounding.
constexpr double at_rest = 1e-7;

/// n sections, each shorter than the one before, on a base that is turned.
Robot arm(Index n) {
  Robot robot = amouri2020();
  robot.sections.resize(static_cast<std::size_t>(n), robot.sections[0]);
  for (Index i = 0; i < n; ++i) robot.sections[i].length = 0.25 - 0.02 * static_cast<double>(i);
  robot.base_orientation =
      Eigen::AngleAxisd(0.7, Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  return robot;
}

/// Evenly spread over the disks |q_i| <= max_theta.
VectorXd random_bending(Random& random, Index n, double max_theta) {
  VectorXd q(2 * n);
  for (Index i = 0; i < n; ++i) {
    const double theta = max_theta * std::sqrt(random.uniform(0.0, 1.0));
    const double phi = random.uniform(-pi, pi);
    q.segment<2>(2 * i) << theta * std::cos(phi), theta * std::sin(phi);
  }
  return q;
}

/// Share of random targets that are reached from where the search starts by itself.
double success(const Model& model, bool with_rotation, const InverseKinematicsOptions& options = {},
               double max_theta = usual_bending) {
  Random random;
  InverseSolver solver(model, options);
  int reached = 0;
  for (int i = 0; i < num_targets; ++i) {
    const Pose at = tip(model, random_bending(random, model.num_sections(), max_theta));
    const std::optional<Matrix3d> R = with_rotation ? std::optional(at.R) : std::nullopt;
    const InverseKinematics& answer = solver.solve(at.p, R);
    if (!answer.reachable) continue;
    ++reached;
    const Pose found = tip(model, answer.q);
    const double error = std::hypot((found.p - at.p).norm(), with_rotation ? answer.angle : 0.0);
    REQUIRE(error <= 1e-8 * total_length(model));
  }
  return static_cast<double>(reached) / num_targets;
}

TEST_SUITE_BEGIN("inverse_kinematics");

TEST_CASE("one section: with an orientation that belongs to the point") {
  Random random;
  const Model model(arm(1));
  CHECK(success(model, false, {}, full_circle) == 1.0);
  CHECK(success(model, true) == 1.0);
}

TEST_CASE("round trip through tip positions") {
  for (const Index n : {2, 3, 5, 8}) {
    CAPTURE(n);
    CHECK(success(Model(arm(n)), false) == 1.0);
  }
}

TEST_CASE("round trip through tip poses") {
  // Three sections have as many coordinates as a pose; 0.05 % are let go.
  CHECK(success(Model(arm(3)), true) >= 0.9995);
  CHECK(success(Model(arm(5)), true) == 1.0);
  CHECK(success(Model(arm(8)), true) == 1.0);
}

TEST_CASE("round trip within tight limits") {
  for (const double max_theta : {1.0, 0.3}) {
    InverseKinematicsOptions options;
    options.max_theta = VectorXd::Constant(1, max_theta);
    for (const Index n : {2, 3, 5}) {
      INFO("n = ", n, ", max_theta = ", max_theta);
      const Model model(arm(n));
      CHECK(success(model, false, options, max_theta) == 1.0);
    }
  }
}

TEST_CASE("a point out of reach gives a point where nothing leads nearer, limits or none") {
  Random random;
  for (const Index n : {2, 3, 5}) {
    const Model model(arm(n));
    const double length = total_length(model);
    for (const double max_theta : {full_circle, 0.4}) {
      InverseKinematicsOptions options;
      options.max_theta = VectorXd::Constant(n, max_theta);
      options.seeds = 20;
      for (int i = 0; i < 4 * test_count(); ++i) {
        Vector3d p = random.vector(3, 1.0);
        p *= length * random.uniform(1.1, 3.0) / p.norm();
        INFO(random, ", n = ", n, ", max_theta = ", max_theta, ", p = ", p.transpose());
        const InverseKinematics answer = inverse_kinematics(model, p, {}, {}, options);
        check_consistent(model, p, answer, max_theta);
        CHECK(answer.reach == IkStatus::too_far);
        for (Index k = 0; k < n; ++k) {
          const Pull towards = pull(model, answer, p, k);
          CHECK(residual(towards.across, 0.0, length * p.norm()) <= at_rest);
          if (answer.q.segment<2>(2 * k).norm() >= max_theta * (1.0 - 1e-12)) {
            CHECK(towards.outward >= 0.0);
          } else {
            CHECK(residual(towards.outward, 0.0, length * p.norm()) <= at_rest);
          }
        }
      }
    }
  }
}

TEST_CASE("every section keeps a limit of its own") {
  Random random;
  const Model model(arm(3));
  const Vector3d limits(0.2, 1.0, 2.5);
  InverseKinematicsOptions options;
  options.max_theta = limits;
  options.seeds = 5;
  InverseSolver solver(model, options);
  for (int i = 0; i < 50 * test_count(); ++i) {
    const Vector3d p = total_length(model) * random.vector(3, 1.0);
    const VectorXd& q = solver.solve(p, {}, random_bending(random, 3, 9.0)).q;
    for (Index k = 0; k < 3; ++k) {
      CHECK(q.segment<2>(2 * k).norm() <= limits[k]);
      CHECK(std::hypot(q[2 * k], q[2 * k + 1]) <= limits[k]);
    }
  }
}

TEST_CASE("the start that is given is tried first") {
  Random random;
  const Model model(arm(3));
  InverseSolver solver(model);
  for (int i = 0; i < test_count(); ++i) {
    const VectorXd q = random_bending(random, 3, usual_bending);
    const Pose at = tip(model, q);
    const InverseKinematics& answer = solver.solve(at.p, at.R, q);
    CHECK(answer.reachable);
    CHECK(answer.q == q);
    CHECK(answer.seeds == 1);
    CHECK(answer.iterations == 0);
  }
}

TEST_CASE("the orientation weight tells position and orientation apart") {
  // Two sections meet a position or an orientation, not both of any pose.
  const Model model(arm(2));
  const Vector3d p = tip(model, Eigen::Vector4d(0.3, 0.1, -0.2, 0.4)).p;
  const Matrix3d R = model.robot().base_orientation;
  InverseKinematicsOptions options;
  options.orientation_weight = 1e-3;
  const InverseKinematics near = inverse_kinematics(model, p, R, {}, options);
  options.orientation_weight = 10.0;
  const InverseKinematics aligned = inverse_kinematics(model, p, R, {}, options);
  CHECK(near.distance < 0.1 * aligned.distance);
  CHECK(aligned.angle < 0.1 * near.angle);
  CHECK(residual(aligned.residual, std::hypot(aligned.distance, 10.0 * aligned.angle)) <=
        tolerance::rounding);
  CHECK(near.reach == IkStatus::too_few_sections);
}

TEST_CASE("any finite point gives finite bending vectors, the same each time") {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double huge = std::numeric_limits<double>::max();
  for (const Index n : {1, 2, 3}) {
    const Model model(arm(n));
    const double length = total_length(model);
    InverseKinematicsOptions options;
    options.seeds = 10;
    InverseSolver solver(model, options), another(model, options);
    const Matrix3d R = model.robot().base_orientation;
    for (const double x : {0.0, tiny, -1e-9, 0.5 * length, -length, 1e8, -1e300, huge}) {
      for (const double z : {0.0, -tiny, 1e-9, -0.5 * length, length, -1e8, 1e300, huge}) {
        INFO("n = ", n, ", x = ", x, ", z = ", z);
        const Vector3d p(x, x, z);
        CHECK(solver.solve(p).q.allFinite());
        CHECK_FALSE(std::isnan(solver.solve(R * Vector3d(0.0, 0.0, z)).residual));
        const VectorXd q = solver.solve(p, R).q;
        CHECK(q.allFinite());
        CHECK(q == another.solve(p, R).q);
      }
    }
  }
}

TEST_CASE("a far point points the robot towards itself") {
  const Model model(arm(3));
  const Vector3d near = inverse_kinematics(model, {1e5, 2e5, 3e5}).position;
  const Vector3d far = inverse_kinematics(model, {1e300, 2e300, 3e300}).position;
  CHECK(residual(near, far, total_length(model)) <= 1e-5);
}

TEST_CASE("why not, in a sentence") {
  const auto message = [](Index n, const Vector3d& p, const std::optional<Matrix3d>& R,
                          double max_theta) {
    Robot robot = arm(n);
    robot.base_orientation.setIdentity();
    InverseKinematicsOptions options;
    options.max_theta = VectorXd::Constant(1, max_theta);
    options.seeds = 3;
    return inverse_kinematics(Model(robot), p, R, {}, options).message;
  };
  const std::optional<Matrix3d> upright = Matrix3d::Identity();
  CHECK(message(1, {0.0, 0.0, 0.25}, {}, pi) == "");
  CHECK(message(2, {0.0, 0.0, 1.0}, {}, pi) ==
        "p is 1 m from the base, farther than the robot's 0.48 m; the nearest found is 0.52 m off");
  CHECK(message(1, {0.2, 0.0, 0.1}, upright, 0.5)
            .find("section 1 stands at its max_theta of "
                  "0.5 rad; the nearest found is") == 0);
  CHECK(message(1, {0.1, 0.0, 0.1}, {}, pi)
            .find("the tip of one section moves on a surface, and p "
                  "is not on it; the nearest") == 0);
  CHECK(message(2, {0.1, 0.0, 0.3}, upright, pi)
            .find("2 sections have 4 coordinates, too few for the 6 of a position and an "
                  "orientation; the nearest found is") == 0);
  const std::optional<Matrix3d> upside_down = Matrix3d(Vector3d(1.0, -1.0, -1.0).asDiagonal());
  CHECK(message(3, {0.0, 0.0, 0.6}, upside_down, full_circle)
            .find("none of 3 starts led there, more seeds may; the nearest found is") == 0);
}

TEST_CASE("bad input is refused") {
  const Model model(arm(2));
  const Vector3d p(0.1, 0.0, 0.3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_SENTENCE(inverse_kinematics(model, {0.1, nan, 0.0}),
                        "p must be finite, got [0.1 nan   0]");
  CHECK_THROWS_SENTENCE(inverse_kinematics(model, p, Matrix3d::Constant(nan)), "R must be finite");
  CHECK_THROWS_SENTENCE(inverse_kinematics(model, p, Matrix3d(2.0 * Matrix3d::Identity())),
                        "R must be a rotation matrix, but R^T R differs from the unit matrix by 3");
  CHECK_THROWS_SENTENCE(inverse_kinematics(model, p, Matrix3d(-Matrix3d::Identity())),
                        "R must be a rotation matrix, but its determinant is -1: it mirrors");
  CHECK_THROWS_SENTENCE(inverse_kinematics(model, p, {}, Vector3d::Zero()),
                        "q0 must be 4 finite angles, got [0 0 0]");
  const auto with = [&](auto change) {
    InverseKinematicsOptions options;
    change(options);
    return inverse_kinematics(model, p, {}, {}, options);
  };
  CHECK_THROWS_SENTENCE(with([](auto& o) { o.max_theta = Vector3d::Ones(); }),
                        "max_theta must be one angle or one for each of the 2 sections, got 3");
  CHECK_THROWS_SENTENCE(with([](auto& o) { o.max_theta = Eigen::Vector2d(1.0, 0.0); }),
                        "max_theta[1] (section 2) must be > 0 and at most 3 pi rad, got 0");
  CHECK_THROWS_SENTENCE(with([](auto& o) { o.orientation_weight = 0.0; }),
                        "orientation_weight must be > 0 m and finite, got 0");
  CHECK_THROWS_SENTENCE(with([&](auto& o) { o.tolerance = nan; }),
                        "tolerance must be > 0 m and finite, got nan");
  CHECK_THROWS_SENTENCE(with([](auto& o) { o.seeds = 0; }), "seeds must be 1 to 100000, got 0");
  CHECK_THROWS_SENTENCE(with([](auto& o) { o.iterations = -1; }),
                        "iterations must be 1 to 100000, got -1");
}

TEST_CASE("a solver's solve allocates nothing and says what is not finite") {
  Random random;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Index n : {1, 2, 5, 32}) {
    Robot robot = arm(2);
    robot.sections.resize(static_cast<std::size_t>(n), robot.sections[0]);
    const Model model(robot);
    InverseKinematicsOptions options;
    options.max_theta = VectorXd::Constant(1, 0.3);
    options.seeds = 3;
    InverseSolver solver(model, options);
    const VectorXd q = random_bending(random, n, 0.3);
    const Pose at = tip(model, q);
    const std::optional<Matrix3d> R = at.R;
    const Vector3d far(9.0, 1.0, 2.0);
    CHECK(allocations_of([&] { static_cast<void>(solver.solve(at.p)); }) == 0);
    CHECK(allocations_of([&] { static_cast<void>(solver.solve(at.p, R, q)); }) == 0);
    CHECK(allocations_of([&] { static_cast<void>(solver.solve(far, R)); }) == 0);
    const InverseKinematics& answer = solver.solve({nan, 0.0, 0.0});
    CHECK(answer.reach == IkStatus::not_finite);
    CHECK(answer.q == VectorXd::Zero(2 * n));
    CHECK(solver.message() == "p, R and q0 must be finite");
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
