// The method that chooses: dop853, and bdf from where on it pays.
#include <doctest/doctest.h>

#include <cmath>

#include "support/cases.hpp"
#include "support/cvode_runs.hpp"
#include "support/split.hpp"

namespace cdcr::test {
namespace {

// Errors of a second or two at the default tolerances, and of times of events [rad], [s].
constexpr double by_default = 1e-6;

/// Table 1 in parts: at eight, explicit steps have to be of some 0.1 ms.
Model cut(int parts, double damping = 0.01) {
  Robot robot = amouri2020();
  robot.sections[0].damping = damping;
  return Model(split(robot, parts));
}

VectorXd bent(const Model& model) {
  return spread(Eigen::Vector2d(0.8, 0.2), static_cast<int>(model.num_sections()));
}

/// From t = 2 s on, pulled by a cable.
Trajectory go(const Model& model, Method method, const CommandInput& input, double duration = 1.0,
              const Options& options = {}, IntegratorFactory factory = make_cvode_integrator,
              const Events& events = {}) {
  return simulate(model, bent(model), VectorXd::Zero(model.num_coordinates()),
                  even_times(2.0, 2.0 + duration, 101), input, method, options, factory, {}, {},
                  events);
}

/// Tensions that jump.
CommandInput jumps(double end) {
  MatrixXd rows = MatrixXd::Zero(3, 3);
  rows(0, 0) = 2.0;
  rows(1, 1) = 3.0;
  return CommandInput::table(Eigen::Vector3d(2.0, 2.3, end), rows,
                             CommandInput::Interpolation::previous);
}

TEST_SUITE_BEGIN("cvode_automatic");

TEST_CASE("where nothing is stiff it is dop853, to the last bit") {
  const Model model = cut(1);
  const Trajectory chosen = go(model, Method::automatic, jumps(2.8), 5.0);
  const Trajectory explicit_run = go(model, Method::dop853, jumps(2.8), 5.0);
  CHECK(chosen.q == explicit_run.q);
  CHECK(chosen.qd == explicit_run.qd);
  CHECK(chosen.stats.evaluations == explicit_run.stats.evaluations);
  CHECK(chosen.stats.method == Method::dop853);
  CHECK(chosen.stats.switches == 0);
  CHECK(!chosen.stats.stiff);
}

TEST_CASE("where stability holds dop853 back it goes on with bdf") {
  const Model model = cut(8);
  const CommandInput input = pull(2.0);
  const Trajectory chosen = go(model, Method::automatic, input);
  const Trajectory explicit_run = go(model, Method::dop853, input);
  const Trajectory truth = go(model, Method::bdf, input, 1.0, tight);
  CHECK(chosen.stats.method == Method::bdf);
  CHECK(chosen.stats.switches == 1);
  REQUIRE(chosen.stats.stiff);
  CHECK(*chosen.stats.stiff > 2.0);
  CHECK(*chosen.stats.stiff < 2.1);
  CHECK(chosen.stats.evaluations < explicit_run.stats.evaluations / 5);
  CHECK(distance(chosen, truth) <= by_default);
}

TEST_CASE("jumps, events and stop conditions are found on both sides of the switch") {
  const Model model = cut(8);
  const auto falls_below = [](double level) {
    return [level](double, const ConstVectorRef& q, const ConstVectorRef&) { return q[0] - level; };
  };
  // The first in the steps of dop853, the others in those of bdf.
  const Events events = {
      {falls_below(0.09999), -1, 0}, {falls_below(0.05), -1, 0}, {falls_below(0.0), 0, 2}};
  const Trajectory chosen =
      go(model, Method::automatic, jumps(2.8), 3.0, {}, make_cvode_integrator, events);
  const Trajectory truth =
      go(model, Method::bdf, jumps(2.8), 3.0, tight, make_cvode_integrator, events);
  REQUIRE(truth.status == Status::event);
  REQUIRE(chosen.status == Status::event);
  CHECK(chosen.message == truth.message);
  REQUIRE(chosen.events.size() == truth.events.size());
  REQUIRE(chosen.stats.stiff);
  CHECK(chosen.events.front().time < *chosen.stats.stiff);
  CHECK(chosen.events.back().time > *chosen.stats.stiff);
  for (std::size_t i = 0; i < truth.events.size(); ++i) {
    CHECK(chosen.events[i].event == truth.events[i].event);
    CHECK(std::abs(chosen.events[i].time - truth.events[i].time) < by_default);
  }
  REQUIRE(chosen.t == truth.t);
  CHECK(largest(chosen.q - truth.q) < by_default);
  CHECK(chosen.tension == truth.tension);
}

TEST_CASE("in stretches too short for a start of bdf it stays explicit") {
  const Model model = cut(8);
  const Index count = 251;  // a stretch of 4 ms is some forty steps of dop853
  MatrixXd rows = MatrixXd::Zero(count, 3);
  for (Index i = 0; i < count; i += 2) rows(i, 0) = 1.0;
  const CommandInput input =
      CommandInput::table(even_times(2.0, 3.0, count), rows, CommandInput::Interpolation::previous);
  const Trajectory chosen = go(model, Method::automatic, input);
  CHECK(chosen.status == Status::ok);
  CHECK(chosen.stats.stiff);
  CHECK(chosen.stats.method == Method::dop853);
  CHECK(chosen.stats.switches == 0);
}

TEST_CASE("where friction makes a robot stiffer later on, bdf is taken in short stretches too") {
  Robot robot = amouri2020();
  robot.sections[0].cable_friction = 0.3;
  robot.sliding_speed = 1e-6;
  const Model model(robot);
  const Index count = 201;  // stretches of 0.05 s
  const VectorXd times = even_times(2.0, 12.0, count);
  MatrixXd rows = MatrixXd::Zero(count, 3);
  for (Index i = 0; i < count; ++i) rows(i, 0) = 4.0 - 4.0 * std::cos(1.25 * (times[i] - 2.0));
  const CommandInput input = CommandInput::table(times, rows, CommandInput::Interpolation::linear);
  const auto run = [&](Method method) {
    const Trajectory found = simulate(model, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                      times, input, method, {}, make_cvode_integrator);
    REQUIRE(found.status == Status::ok);
    return found;
  };
  const Trajectory chosen = run(Method::automatic), implicit_run = run(Method::bdf);
  CHECK(chosen.stats.method == Method::bdf);
  CHECK(chosen.stats.evaluations < 2 * implicit_run.stats.evaluations);
  CHECK(distance(chosen, implicit_run) <= by_default);
}

TEST_CASE("cables that stick and slip by a memory are left to bdf") {
  Robot robot;
  Section section;
  section.length = 0.05;
  section.backbone_mass = 3e-4;
  section.backbone_diameter = 1e-3;
  section.youngs_modulus = 5e10;
  section.damping = 1e-4;
  section.cable_radius = 0.01;
  section.cable_angles = {0.0, 2.0 * pi / 3.0, 4.0 * pi / 3.0};
  section.cable_stiffness = 5e4;
  section.cable_damping = 1.0;
  section.cable_friction = 0.7;
  robot.sections = {section};
  robot.presliding_stiffness = 1e4;
  const Model model(robot);
  MatrixXd rows = MatrixXd::Constant(3, 3, section.length);
  rows(1, 2) -= 2e-3;
  const CommandInput input =
      CommandInput::table(Vector3d(0.0, 2.0, 4.0), rows, CommandInput::Interpolation::linear);
  const auto run = [&](Method method) {
    const Trajectory found =
        simulate(model, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), even_times(0.0, 4.0, 41),
                 input, method, {}, make_cvode_integrator);
    REQUIRE(found.status == Status::ok);
    return found;
  };
  const Trajectory chosen = run(Method::automatic), implicit_run = run(Method::bdf);
  CHECK(chosen.stats.stiff);
  CHECK(chosen.stats.evaluations < 2 * implicit_run.stats.evaluations);
  CHECK(distance(chosen, implicit_run) <= by_default);
}

TEST_CASE("without an implicit method it stays explicit, and tells that this is dear") {
  const Model model = cut(8);
  const Trajectory chosen = go(model, Method::automatic, pull(2.0), 0.2, {}, make_integrator);
  const Trajectory explicit_run = go(model, Method::dop853, pull(2.0), 0.2);
  CHECK(chosen.q == explicit_run.q);
  CHECK(chosen.stats.method == Method::dop853);
  CHECK(chosen.stats.stiff);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
