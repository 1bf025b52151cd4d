// The straight configuration, where the paper's own equations divide 0 by 0, is like any other.
#include <doctest/doctest.h>

#include <cmath>

#include "cdcr/coordinates.hpp"
#include "cdcr/simulate.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

constexpr int num_directions = 12;

Eigen::Vector2d direction(int k) {
  return bending(1.0, 2.0 * pi * k / num_directions);
}

TEST_SUITE_BEGIN("straight");

TEST_CASE("released from rest the robot swings through straight in every direction alike") {
  const Model model(amouri2020());
  const VectorXd times = even_times(0.0, 5.0, 501);
  const Trajectory reference = simulate(model, 0.8 * direction(0), VectorXd::Zero(2), times,
                                        no_tension(model), Method::dopri5, tightest());
  REQUIRE(reference.q.col(0).minCoeff() < -0.79);
  for (int k = 0; k < num_directions; ++k) {
    INFO("direction ", k);
    const Eigen::Vector2d along = direction(k), across(-along[1], along[0]);
    for (const Method method : {Method::dopri5, Method::dop853, Method::rk4}) {
      const Options options = method == Method::rk4 ? fixed_step(1e-3) : tightest();
      const Trajectory run = simulate(model, 0.8 * along, VectorXd::Zero(2), times,
                                      no_tension(model), method, options);
      REQUIRE(run.status == Status::ok);
      CHECK(residual(run.q * across, VectorXd::Zero(501), 1.0) <= tolerance::run);
      const double limit = method == Method::rk4      ? tolerance::rk4_run
                           : method == Method::dop853 ? tolerance::dop853_run
                                                      : tolerance::run;
      CHECK(residual(run.q * along, reference.q.col(0), 1.0) <= limit);
    }
  }
}

TEST_CASE("a run back in time hits straight exactly and goes on through it") {
  const Model model(amouri2020());
  const double speed = 6.0;
  for (int k = 0; k < num_directions; ++k) {
    INFO("direction ", k);
    const Eigen::Vector2d away = speed * direction(k);
    const Trajectory out = simulate(model, VectorXd::Zero(2), away, even_times(0.0, 0.1, 2),
                                    no_tension(model), Method::dopri5, tightest());
    REQUIRE(out.status == Status::ok);
    const VectorXd turned = -out.qd.row(1).transpose();
    const Trajectory back =
        simulate(model, out.q.row(1).transpose(), turned, Eigen::Vector3d(0.0, 0.1, 0.2),
                 no_tension(model), Method::dopri5, tightest());
    REQUIRE(back.status == Status::ok);
    CHECK(residual(back.q.row(1), VectorXd::Zero(2).transpose(), 1.0) <= tolerance::run);
    CHECK(residual(back.qd.row(1).transpose(), -away) <= tolerance::run);
    CHECK(residual(back.q.row(2), -out.q.row(1)) <= tolerance::run);
  }
}

TEST_CASE("through straight with a side wind of gravity") {
  Robot robot = amouri2020();
  robot.gravity = {1.0, -2.0, -9.0};
  const Model model(robot);
  const VectorXd times = even_times(0.0, 2.0, 401);
  const Trajectory run = simulate(model, VectorXd::Zero(2), VectorXd::Zero(2), times,
                                  no_tension(model), Method::dopri5, tightest());
  REQUIRE(run.status == Status::ok);
  const double first = total_energy(model, VectorXd::Zero(2), VectorXd::Zero(2));
  const VectorXd energies = total_energies(model, run);
  CHECK(residual(energies, VectorXd::Constant(401, first)) <= tolerance::run);
  // Gravity is the only direction there is, so the motion stays in its plane.
  const Eigen::Vector2d across(2.0, 1.0);
  CHECK(residual(run.q * across, VectorXd::Zero(401), 1.0) <= tolerance::run);
  CHECK(run.q.rowwise().norm().maxCoeff() > 0.1);
}

TEST_CASE("starting straight at rest with cables 1 and 2 pulled") {
  const Model model(amouri2020());
  const Eigen::Vector3d tension(5.0, 5.0, 0.0);
  const VectorXd times = even_times(0.0, 3.0, 301);
  const Trajectory run = simulate(model, VectorXd::Zero(2), VectorXd::Zero(2), times,
                                  CommandInput::constant(tension), Method::dopri5, tightest());
  REQUIRE(run.status == Status::ok);
  CHECK(run.q.allFinite());
  // Equal pulls at 0 and 120 degrees bend it towards 60 degrees, as one pull of 5 N would.
  const Eigen::Vector2d along = bending(1.0, pi / 3.0), across(-along[1], along[0]);
  CHECK(residual(run.q * across, VectorXd::Zero(301), 1.0) <= tolerance::run);
  const Trajectory single =
      simulate(model, VectorXd::Zero(2), VectorXd::Zero(2), times,
               CommandInput::constant(Eigen::Vector3d(5.0, 0.0, 0.0)), Method::dopri5, tightest());
  CHECK(residual(run.q * along, single.q.col(0), 1.0) <= tolerance::run);
  // An undamped step response swings to about twice the static angle and back to straight.
  const double theta_static = 5.0 * 0.019 / model.stiffness()[0];
  CHECK(run.q.rowwise().norm().maxCoeff() > 1.9 * theta_static);
  CHECK(run.q.rowwise().norm().maxCoeff() < 2.1 * theta_static);
}

TEST_CASE("straight at rest without any pull stays straight, to the last bit") {
  const Model model(amouri2020());
  for (const Method method : {Method::dopri5, Method::dop853, Method::rk4}) {
    const Trajectory run = simulate(model, VectorXd::Zero(2), VectorXd::Zero(2),
                                    even_times(0.0, 1.0, 11), no_tension(model), method);
    REQUIRE(run.status == Status::ok);
    CHECK(run.q == RowMatrixXd::Zero(11, 2));
    CHECK(run.qd == RowMatrixXd::Zero(11, 2));
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
