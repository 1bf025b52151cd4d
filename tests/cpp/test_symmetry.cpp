// The section is round: turning or mirroring everything turns or mirrors the answer.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "cdcr/dynamics.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

using Matrix2d = Eigen::Matrix2d;

/// The robot in a world transformed by `change` of the X-Y plane.
Model transformed(const Model& model, const Matrix2d& change) {
  Robot robot = model.robot();
  robot.gravity.head<2>() = change * Eigen::Vector2d(robot.gravity.head<2>());
  return Model(robot);
}

VectorXd acceleration(const Model& model, const VectorXd& q, const VectorXd& qd,
                      const VectorXd& force) {
  Data data(model);
  VectorXd qdd(2);
  forward_dynamics_force(model, data, q, qd, force, qdd);
  return qdd;
}

TEST_SUITE_BEGIN("symmetry");

TEST_CASE("turning state, force and gravity about Z turns the acceleration") {
  Random random;
  for_each_case(2.0 * pi, [&](const Model& model, Data&, const State& state) {
    const Matrix2d turn = Eigen::Rotation2Dd(random.uniform(-pi, pi)).toRotationMatrix();
    const VectorXd force = model.actuation_matrix() * state.tension;
    const VectorXd expected = turn * acceleration(model, state.q, state.qd, force);
    const VectorXd actual =
        acceleration(transformed(model, turn), turn * state.q, turn * state.qd, turn * force);
    CHECK(residual(actual, expected) <= tolerance::cancelled);
  });
}

TEST_CASE("mirroring state, force and gravity mirrors the acceleration, to the last bit") {
  for_each_case(2.0 * pi, [](const Model& model, Data&, const State& state) {
    const Matrix2d mirror = Eigen::Vector2d(1.0, -1.0).asDiagonal();
    const VectorXd force = model.actuation_matrix() * state.tension;
    const VectorXd expected = mirror * acceleration(model, state.q, state.qd, force);
    const VectorXd actual = acceleration(transformed(model, mirror), mirror * state.q,
                                         mirror * state.qd, mirror * force);
    CHECK(actual == expected);
  });
}

TEST_CASE("motion in a plane of symmetry stays in it, to the last bit") {
  for_each_case(2.0 * pi, [](const Model& model, Data&, const State& state) {
    Robot robot = model.robot();
    robot.gravity[1] = 0.0;
    const Eigen::Vector2d q(state.theta, 0.0), qd(state.qd[0], 0.0), force(1.0, 0.0);
    CHECK(acceleration(Model(robot), q, qd, force)[1] == 0.0);
  });
}

TEST_CASE("time reversal: without damping the acceleration is even in qd") {
  for_each_case(2.0 * pi, [](const Model& model, Data&, const State& state) {
    Robot robot = model.robot();
    robot.sections[0].damping = 0.0;
    const Model undamped(robot);
    const VectorXd force = VectorXd::Zero(2);
    CHECK(acceleration(undamped, state.q, state.qd, force) ==
          acceleration(undamped, state.q, -state.qd, force));
  });
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
