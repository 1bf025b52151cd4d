// Wrenches over time: both sides of every jump, frames, energy, controllers and the simulator.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "cdcr/pid.hpp"
#include "cdcr/simulate.hpp"
#include "cdcr/simulator.hpp"
#include "support/cable_robots.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/throws.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
/// Runs glued at the break points: the same steps, but for how times are rounded.
constexpr double glued = 1e-12;
constexpr double slope_of_run = 1e-8;  // differences over 1e-4 s divide its error

const std::vector<Method> own_methods = {Method::rk4, Method::dopri5, Method::dop853};

/// Two sections of Table 1, damped, with weight.
Robot two_sections() {
  Robot robot = parts_with_cables(2, 0.0, 0.0);
  robot.gravity = {0.0, 0.0, 9.81};
  for (Section& section : robot.sections) section.damping = 5e-3;
  return robot;
}

Wrench side_force() {
  Wrench wrench;
  wrench.section = 1;
  wrench.fraction = 0.7;
  wrench.force = {0.3, -0.1, 0.2};
  wrench.moment = {0.02, 0.05, -0.03};
  return wrench;
}

VectorXd start_q() {
  return Eigen::Vector4d(0.3, -0.2, 0.1, 0.4);
}
VectorXd start_qd() {
  return Eigen::Vector4d(1.0, 0.5, -2.0, 1.0);
}

Options options_for(Method method) {
  return method == Method::rk4 ? fixed_step(1.0 / 2048.0) : tolerances(1e-12, 1e-14);
}

Trajectory go(const Model& model, const VectorXd& q, const VectorXd& qd, const VectorXd& times,
              const WrenchInput& loads, Method method) {
  Trajectory run = simulate(model, q, qd, times, no_tension(model), method, options_for(method),
                            make_integrator, {}, loads);
  REQUIRE(run.status == Status::ok);
  return run;
}

WrenchInput with_profile(const Wrench& wrench, Profile profile) {
  WrenchInput loads;
  loads.add(wrench, std::move(profile));
  return loads;
}

WrenchInput scaled(Wrench wrench, double factor) {
  wrench.force *= factor;
  wrench.moment *= factor;
  return WrenchInput({wrench});
}

double factor_at(const WrenchInput& loads, double t, double start) {
  Wrenches now = loads.wrenches();
  loads.evaluate(t, start, now);
  return now[0].force[0] / loads.wrenches()[0].force[0];
}

void check_same(const Trajectory& run, const Trajectory& other, double tolerance) {
  const Index last = run.t.size() - 1, end = other.t.size() - 1;
  CHECK(residual(run.q.row(last), other.q.row(end)) <= tolerance);
  CHECK(residual(run.qd.row(last), other.qd.row(end)) <= tolerance);
}

TEST_SUITE_BEGIN("loads");

TEST_CASE("a table is held or connected, and its ends hold outside") {
  const WrenchInput held =
      with_profile(side_force(), {{1.0, 2.0, 4.0}, {3.0, -1.0, 2.0}, false, {}});
  const WrenchInput linear =
      with_profile(side_force(), {{1.0, 2.0, 4.0}, {3.0, -1.0, 2.0}, true, {}});
  CHECK(held.hold());
  CHECK(!linear.hold());
  CHECK(held.break_points() == std::vector<double>{1.0, 2.0, 4.0});
  const double rounding = tolerance::rounding;
  for (const double t : {0.0, 0.999}) {
    CHECK(residual(factor_at(held, t, 0.0), 3.0) <= rounding);
    CHECK(residual(factor_at(linear, t, 0.0), 3.0) <= rounding);
  }
  // At a break point the stretch decides: the one that ends there, then the one that starts.
  CHECK(residual(factor_at(held, 2.0, 1.0), 3.0) <= rounding);
  CHECK(residual(factor_at(held, 2.0, 2.0), -1.0) <= rounding);
  CHECK(residual(factor_at(held, 4.0, 4.0), 2.0) <= rounding);
  CHECK(residual(factor_at(linear, 1.25, 1.0), 2.0) <= rounding);
  CHECK(residual(factor_at(linear, 2.0, 1.0), -1.0) <= rounding);
  CHECK(residual(factor_at(linear, 3.0, 2.0), 0.5) <= rounding);
  CHECK(residual(factor_at(linear, 9.0, 4.0), 2.0) <= rounding);
  CHECK(factor_at(WrenchInput({side_force()}), 5.0, 0.0) == 1.0);
}

TEST_CASE("a function does not see the far side of its break points") {
  Profile profile;
  profile.times = {1.0};
  profile.function = [](double t) { return t < 1.0 ? 2.0 : -3.0; };
  const WrenchInput loads = with_profile(side_force(), profile);
  const double rounding = tolerance::rounding;
  CHECK(!loads.hold());
  CHECK(residual(factor_at(loads, 1.0, 0.0), 2.0) <= rounding);
  CHECK(residual(factor_at(loads, std::nextafter(1.0, 2.0), 0.0), 2.0) <= rounding);
  CHECK(residual(factor_at(loads, 1.0, 1.0), -3.0) <= rounding);
}

TEST_CASE("break points of several wrenches are sorted, each once") {
  WrenchInput loads;
  loads.add(side_force(), {{0.5, 2.0}, {1.0, 0.0}, false, {}});
  loads.add(side_force());
  loads.add(side_force(), {{0.25, 0.5}, {1.0, 0.0}, true, {}});
  CHECK(loads.break_points() == std::vector<double>{0.25, 0.5, 2.0});
  CHECK(loads.wrenches().size() == 3);
  CHECK(!loads.hold());
}

TEST_CASE("a run across jumps is that of its pieces, glued by hand") {
  const Model model(two_sections());
  const std::vector<double> times = {0.25, 0.40625, 0.75}, factors = {0.0, 1.0, -2.0};
  Profile as_function;
  as_function.times = times;
  as_function.function = [&](double t) {
    return t < times[1] ? factors[0] : t < times[2] ? factors[1] : factors[2];
  };
  for (const Method method : own_methods) {
    VectorXd q = start_q(), qd = start_qd();
    Trajectory piece;
    const std::vector<double> ends = {0.0, times[1], times[2], 1.0};
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      piece = go(model, q, qd, Eigen::Vector2d(ends[i], ends[i + 1]),
                 scaled(side_force(), factors[i]), method);
      q = piece.q.row(1).transpose();
      qd = piece.qd.row(1).transpose();
    }
    const VectorXd span = Eigen::Vector2d(0.0, 1.0);
    const WrenchInput table = with_profile(side_force(), {times, factors, false, {}});
    check_same(go(model, start_q(), start_qd(), span, table, method), piece, glued);
    const WrenchInput function = with_profile(side_force(), as_function);
    check_same(go(model, start_q(), start_qd(), span, function, method), piece, glued);
  }
}

TEST_CASE("a linear table is the function of the same slope, in pieces") {
  const Model model(two_sections());
  const std::vector<double> times = {0.25, 0.5, 1.0}, factors = {0.0, 2.0, -1.0};
  Profile function;
  function.times = times;
  function.function = [](double t) {
    if (t < 0.25) return 0.0;
    return t < 0.5 ? 8.0 * (t - 0.25) : 2.0 - 6.0 * (t - 0.5);
  };
  for (const Method method : own_methods) {
    const VectorXd span = Eigen::Vector2d(0.0, 1.0);
    const WrenchInput table = with_profile(side_force(), {times, factors, true, {}});
    check_same(go(model, start_q(), start_qd(), span, table, method),
               go(model, start_q(), start_qd(), span, with_profile(side_force(), function), method),
               glued);
  }
}

TEST_CASE("switched on and off: nothing before, the free motion after") {
  const Model model(two_sections());
  WrenchInput loads = with_profile(side_force(), {{0.0, 0.25, 0.5}, {0.0, 1.0, 0.0}, false, {}});
  const VectorXd times = even_times(0.0, 1.0, 9);
  const Trajectory run = go(model, start_q(), start_qd(), times, loads, Method::dopri5);
  const Trajectory free = go(model, start_q(), start_qd(), times, {}, Method::dopri5);
  CHECK(residual(run.q.row(2), free.q.row(2)) <= tolerance::run);
  CHECK((run.q.row(4) - free.q.row(4)).norm() > 1e-3);
  const Trajectory after = go(model, run.q.row(4).transpose(), run.qd.row(4).transpose(),
                              Eigen::Vector2d(0.5, 1.0), {}, Method::dopri5);
  check_same(run, after, glued);
}

TEST_CASE("a local wrench is the base one that turns with the backbone at every time") {
  const Model model(two_sections());
  Wrench local = side_force();
  local.frame = Wrench::Frame::local;
  const Trajectory run = go(model, start_q(), start_qd(), even_times(0.0, 1.0, 11),
                            WrenchInput({local}), Method::dopri5);
  // The slope of the run's own rates, by differences over samples 1e-4 s apart.
  Data data(model);
  for (Index i = 1; i < 10; ++i) {
    const double h = 1e-4;
    const Trajectory near = go(model, run.q.row(i).transpose(), run.qd.row(i).transpose(),
                               even_times(0.0, 4.0 * h, 5), WrenchInput({local}), Method::dopri5);
    const VectorXd slope =
        (8.0 * (near.qd.row(3) - near.qd.row(1)) - (near.qd.row(4) - near.qd.row(0))).transpose() /
        (12.0 * h);
    const VectorXd q = near.q.row(2).transpose(), qd = near.qd.row(2).transpose();
    Wrench turned = local;
    const Matrix3d R = pose(model, q, local.section, local.fraction).R;
    turned.frame = Wrench::Frame::base;
    turned.force = R * local.force;
    turned.moment = R * local.moment;
    VectorXd expected(4);
    forward_dynamics(model, data, q, qd, VectorXd::Zero(6), {turned}, expected);
    CHECK(residual(slope, expected) <= slope_of_run);
  }
}

TEST_CASE("energy less the work of a dead force is conserved") {
  Robot robot = two_sections();
  for (Section& section : robot.sections) section.damping = 0.0;
  const Model model(robot);
  Wrench dead = side_force();
  dead.moment.setZero();
  const Trajectory run = go(model, start_q(), start_qd(), even_times(0.0, 10.0, 101),
                            WrenchInput({dead}), Method::dopri5);
  VectorXd energy = total_energies(model, run);
  double work = 0.0;
  for (Index i = 0; i < energy.size(); ++i) {
    const Pose at = pose(model, run.q.row(i).transpose(), dead.section, dead.fraction);
    const double done = dead.force.dot(at.p);
    work = std::max(work, std::abs(done));
    energy[i] -= done;
  }
  const double drift = (energy.array() - energy[0]).abs().maxCoeff();
  MESSAGE("T + U - f.p off by " << drift << " J in 10 s; work of the force up to " << work << " J");
  CHECK(residual(drift, 0.0, work) <= tolerance::conserved);
}

TEST_CASE("an impulse changes the momentum by its moment") {
  // A force so short that the robot does not move meanwhile: d(M qd) = J^T f dt.
  const Model model(two_sections());
  Data data(model);
  for (const double span : {1e-5, 1e-6}) {
    const WrenchInput blow = scaled(side_force(), 0.1 / span);
    const VectorXd zero = VectorXd::Zero(4), q = start_q();
    const Trajectory run = go(model, q, zero, Eigen::Vector2d(0.0, span), blow, Method::dopri5);
    MatrixXd M(4, 4);
    mass_matrix(model, data, q, M);
    VectorXd impulse = VectorXd::Zero(4);
    add_wrench_force(model, q, blow.wrenches(), impulse);
    impulse *= span;
    CHECK(residual(M * run.qd.row(1).transpose(), impulse) <= 100.0 * span / 0.1);
  }
}

TEST_CASE("a controller and wrenches in one run") {
  const Model model(two_sections());
  PidOptions options;
  options.kp = 0.2;
  options.period = 1.0 / 64.0;
  const WrenchInput loads =
      with_profile(side_force(), {{0.0, 0.3, 0.6}, {0.0, 1.0, 0.5}, false, {}});
  for (const Method method : own_methods) {
    Pid pid(model, options);
    const Trajectory run = simulate(model, start_q(), start_qd(), Eigen::Vector2d(0.0, 1.0), pid,
                                    method, options_for(method), make_integrator, {}, loads);
    REQUIRE(run.status == Status::ok);
    // By hand: one run a period, and one more where the wrench jumps within a period.
    Pid other(model, options);
    VectorXd q = start_q(), qd = start_qd(), tension(model.num_cables());
    for (int k = 0; k < 64; ++k) {
      const double t = k / 64.0, end = (k + 1) / 64.0;
      REQUIRE(other.update(t, q, qd, tension) == Status::ok);
      const Trajectory piece =
          simulate(model, q, qd, Eigen::Vector2d(t, end), CommandInput::constant(tension), method,
                   options_for(method), make_integrator, {}, loads);
      q = piece.q.row(1).transpose();
      qd = piece.qd.row(1).transpose();
    }
    CHECK(residual(run.q.row(1).transpose(), q) <= glued);
    CHECK(residual(run.qd.row(1).transpose(), qd) <= glued);
  }
}

TEST_CASE("the simulator's steps under wrenches, springs and friction are those of rk4") {
  Robot robot = parts_with_cables(3, 2e3, 1.0);
  robot.gravity = {0.0, 0.0, 9.81};
  for (Section& section : robot.sections) section.cable_friction = 0.2;
  const Model model(robot);
  const VectorXd q0 = VectorXd::Constant(6, 0.1), qd0 = VectorXd::Constant(6, 0.5);
  const VectorXd command = rest_command_of(model).array() - 1e-3;
  Wrench local = side_force();
  local.frame = Wrench::Frame::local;
  const Wrenches wrenches = {side_force(), local};
  const double period = 1.0 / 1024.0;
  Simulator sim(model, period, 4);
  sim.reset(q0, qd0);
  const Trajectory run =
      simulate(model, q0, qd0, even_times(0.0, 0.125, 129), CommandInput::constant(command),
               Method::rk4, fixed_step(period / 4), make_integrator, {}, WrenchInput(wrenches));
  REQUIRE(run.status == Status::ok);
  for (Index i = 1; i <= 128; ++i) {
    REQUIRE(sim.step(command, wrenches) == Status::ok);
    REQUIRE(sim.q() == run.q.row(i).transpose());
    REQUIRE(sim.qd() == run.qd.row(i).transpose());
  }
}

TEST_CASE("wrong profiles and wrenches are refused with a sentence") {
  const Wrench wrench = side_force();
  WrenchInput loads;
  CHECK_THROWS_SENTENCE(
      loads.add(wrench, {{0.0, 1.0}, {1.0}, false, {}}),
      "a wrench's profile needs one row of values for each time, got 2 times and 1 rows");
  CHECK_THROWS_SENTENCE(loads.add(wrench, {{0.0, 1.0, 0.5}, {1.0, 1.0, 1.0}, false, {}}),
                        "the times of a wrench's profile must be finite and strictly increasing, "
                        "got 0.5 s at index 2 after 1 s");
  CHECK_THROWS_SENTENCE(loads.add(wrench, {{nan}, {1.0}, false, {}}),
                        "the times of a wrench's profile must be finite and strictly increasing, "
                        "got nan s at index 0");
  CHECK_THROWS_SENTENCE(loads.add(wrench, {{0.0, 1.0}, {1.0, infinity}, true, {}}),
                        "the factors of a wrench's profile must be finite, got inf at index 1");
  CHECK(loads.empty());
  CHECK(loads.break_points().empty());

  const Model model(two_sections());
  Wrench beyond = wrench;
  beyond.section = 2;
  const auto run_with = [&](const WrenchInput& some) {
    return simulate(model, start_q(), start_qd(), Eigen::Vector2d(0.0, 0.1), no_tension(model),
                    Method::dopri5, {}, make_integrator, {}, some);
  };
  CHECK_THROWS_SENTENCE(run_with(WrenchInput({wrench, beyond})),
                        "wrenches[1].section must be 0 to 1, got 2");
  Profile bad;
  bad.function = [](double t) { return t > 0.05 ? nan : 1.0; };
  CHECK_THROWS_AS(static_cast<void>(run_with(with_profile(wrench, bad))), std::invalid_argument);
  bad.function = [](double) -> double { throw std::logic_error("no idea"); };
  CHECK_THROWS_WITH_AS(static_cast<void>(run_with(with_profile(wrench, bad))), "no idea",
                       std::logic_error);
  CHECK(run_with(WrenchInput({wrench})).status == Status::ok);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
