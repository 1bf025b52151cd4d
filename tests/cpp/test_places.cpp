// Where a robot stands, what its tip carries, and places given by arc length.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "cdcr/dynamics.hpp"
#include "cdcr/inverse_kinematics.hpp"
#include "cdcr/kinematics.hpp"
#include "support/chain_cases.hpp"
#include "support/differences.hpp"
#include "support/residual.hpp"
#include "support/split.hpp"
#include "support/throws.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

Transform random_frame(Random& random, double reach) {
  Transform frame = Transform::Identity();
  frame.topLeftCorner<3, 3>() =
      Eigen::AngleAxisd(random.uniform(-pi, pi), random.vector(3, 1.0).normalized())
          .toRotationMatrix();
  frame.topRightCorner<3, 1>() = random.vector(3, reach);
  return frame;
}

/// The same robot elsewhere, with a tool.
Robot equipped(Robot robot, Random& random) {
  robot.base_position = random.vector(3, 2.0);
  robot.tool = random_frame(random, 0.3 * total_length(robot));
  return robot;
}

TEST_SUITE_BEGIN("places");

TEST_CASE("the base moves the robot, and the tip is the tool's frame") {
  Random random;
  for_each_chain({1, 2, 3, 8}, [&](const Model& model, Data&, const ChainState& state) {
    const Model other(equipped(model.robot(), random));
    const Index last = model.num_sections() - 1;
    const double length = total_length(model.robot()) + 2.0;
    const Vector3d& base = other.robot().base_position;
    for (const double x : {0.0, 0.4, 1.0}) {
      const Pose here = pose(model, state.q, last, x), there = pose(other, state.q, last, x);
      CHECK(there.R == here.R);
      CHECK(residual(there.p, here.p + base, length) <= tolerance::rounding);
    }
    const Pose end = pose(other, state.q, last, 1.0), found = tip(other, state.q);
    Transform frame = Transform::Identity();
    frame.topLeftCorner<3, 3>() = end.R;
    frame.topRightCorner<3, 1>() = end.p;
    frame = frame * other.robot().tool;
    CHECK(residual(found.R, frame.topLeftCorner<3, 3>()) <= tolerance::rounding);
    CHECK(residual(found.p, frame.topRightCorner<3, 1>(), length) <= tolerance::rounding);
  });
}

TEST_CASE("the Jacobian of the tip by differences") {
  Random random;
  for_each_chain({1, 3}, [&](const Model& model, Data&, const ChainState& state) {
    const Model other(equipped(model.robot(), random));
    const Matrix3d R = tip(other, state.q).R;
    MatrixXd J(6, state.q.size());
    tip_jacobian(other, state.q, J);
    for (Index k = 0; k < state.q.size(); ++k) {
      const auto at = [&](double s) {
        VectorXd q = state.q;
        q[k] += s;
        return tip(other, q);
      };
      const Vector3d v = difference([&](double s) -> Vector3d { return at(s).p; }, 0.02);
      const Matrix3d spin =
          difference([&](double s) -> Matrix3d { return at(s).R; }, 0.02) * R.transpose();
      const Vector3d omega(spin(2, 1), spin(0, 2), spin(1, 0));
      CHECK(residual(J.col(k).head<3>(), v, 2.0) <= tolerance::recursion_differences);
      CHECK(residual(J.col(k).tail<3>(), omega, 1.0) <= tolerance::recursion_differences);
    }
  });
}

TEST_CASE("without a tool the Jacobian of the tip is that of the last section's end") {
  for_each_chain({1, 3}, [](const Model& model, Data&, const ChainState& state) {
    MatrixXd J(6, state.q.size()), same(6, state.q.size());
    tip_jacobian(model, state.q, J);
    jacobian(model, state.q, model.num_sections() - 1, 1.0, same);
    CHECK(J == same);
    CHECK(!model.has_tool());
  });
}

TEST_CASE("neither base nor tool changes the motion; the weight's energy counts from the origin") {
  Random random;
  for_each_chain({1, 3}, [&](const Model& model, Data& data, const ChainState& state) {
    const Model other(equipped(model.robot(), random));
    Data other_data(other);
    VectorXd qdd(state.q.size()), same(state.q.size());
    const Wrenches wrenches = random_wrenches(model, 2, random);
    forward_dynamics(model, data, state.q, state.qd, state.tension, wrenches, qdd);
    forward_dynamics(other, other_data, state.q, state.qd, state.tension, wrenches, same);
    CHECK(qdd == same);
    double mass = model.robot().payload;
    for (const Section& section : model.robot().sections) {
      mass += section.backbone_mass;
      for (const Disk& disk : section.disks()) mass += disk.mass;
    }
    const double raised = -mass * model.robot().gravity.dot(other.robot().base_position);
    const double U = potential_energy(model, data, state.q);
    CHECK(residual(potential_energy(other, other_data, state.q), U + raised,
                   std::abs(U) + std::abs(raised)) <= tolerance::rounding);
    const Model floating = other.with_gravity(Vector3d::Zero());
    CHECK(floating.base_energy() == 0.0);
    CHECK(floating.has_tool());
  });
}

TEST_CASE("inverse kinematics brings the tool where it should be") {
  Random random;
  for (const int n : {1, 2, 3, 4}) {
    const Model model(equipped(random_chain(random, n), random));
    InverseSolver solver(model);
    const double length = total_length(model.robot());
    int reached = 0;
    constexpr int count = 50;
    for (int i = 0; i < count; ++i) {
      INFO(random, ", sections: ", n);
      const Pose goal = tip(model, random_bending(n, 2.0, random));
      const auto R = n == 1 || n > 2 ? std::optional<Matrix3d>(goal.R) : std::nullopt;
      const InverseKinematics& answer = solver.solve(goal.p, R);
      if (!answer.reachable) continue;
      ++reached;
      const Pose found = tip(model, answer.q);
      CHECK((found.p - goal.p).norm() <= 1e-8 * length);
      if (R) CHECK((found.R - goal.R).norm() <= 1e-7);
    }
    CHECK(reached >= 0.9 * count);
  }
}

TEST_CASE("a tool's point beside the surface of one section's tip is reached too") {
  Random random;
  Robot robot = amouri2020();
  robot.tool(0, 3) = 0.1;
  const Model model(robot);
  InverseSolver solver(model);
  for (int i = 0; i < test_count(); ++i) {
    const Vector3d p = tip(model, random_bending(1, 2.5, random)).p;
    CHECK(solver.solve(p).reachable);
  }
  robot.base_position = {0.0, 0.0, 5.0};
  CHECK(inverse_kinematics(Model(robot), {0.0, 0.0, 6.0}).message.substr(0, 84) ==
        "p is 1 m from the base, farther than the robot's 0.802 m and its tool's 0.1 m; the n");
}

TEST_CASE("places by arc length") {
  Random random;
  Robot robot = random_chain(random, 4);
  double begin = 0.0;
  for (Index i = 0; i < 4; ++i) {
    const double length = robot.sections[i].length;
    for (const double x : {0.25, 0.5, 1.0}) {
      const Place place = robot.locate(begin + x * length);
      CHECK(place.section == i);
      CHECK(residual(place.fraction, x) <= tolerance::cancelled);
    }
    begin += length;
  }
  CHECK(robot.locate(0.0).section == 0);
  CHECK(robot.locate(0.0).fraction == 0.0);
  robot = amouri2020();
  CHECK(robot.locate(0.802 * (1.0 + 2e-16)).fraction == 1.0);
  const std::string sentence = "s must be 0 to 0.802 m, the length of the robot, got ";
  CHECK_THROWS_SENTENCE(robot.locate(0.803), (sentence + "0.803").c_str());
  CHECK_THROWS_SENTENCE(robot.locate(-1e-9), (sentence + "-1e-09").c_str());
  CHECK_THROWS_SENTENCE(robot.locate(std::numeric_limits<double>::quiet_NaN()),
                        (sentence + "nan").c_str());
}

TEST_CASE("coordinates have names") {
  Random random;
  const Model model(random_chain(random, 2));
  CHECK(model.coordinate_names() == std::vector<std::string>{"q1_x", "q1_y", "q2_x", "q2_y"});
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
