// Vectors of the wrong size, indices out of range and what was made for another model: a Status
// where there is one to return, elsewhere an assertion of debug builds.
#include <doctest/doctest.h>

#include <csignal>
#include <limits>
#include <utility>

#include "cdcr/cdcr.hpp"
#include "support/allocations.hpp"
#include "support/cases.hpp"
#include "support/child.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

#ifdef NDEBUG
constexpr bool asserted = false;
#else
constexpr bool asserted = true;
#endif

/// Whether a call ends the program by an assertion.
template <class Call>
bool stops(Call&& call) {
  return signal_of(std::forward<Call>(call)) == SIGABRT;
}

Robot two_sections() {
  Robot robot = amouri2020();
  robot.sections.push_back(robot.sections[0]);
  robot.sections[0].cable_friction = 0.1;
  return robot;
}

/// Right and wrong arguments of one model of two sections, six cables.
struct Arguments {
  const Model model = Model(two_sections()), other = Model(amouri2020());
  Data data = Data(model), data_of_other = Data(other);
  VectorXd q = VectorXd::Zero(4), qd = q, qdd = q, out = q, F = VectorXd::Zero(6), out_F = F;
  VectorXd short_q = VectorXd::Zero(2), short_F = VectorXd::Zero(3), long_q = VectorXd::Zero(6);
  MatrixXd M = MatrixXd::Zero(4, 4), A = MatrixXd::Zero(8, 8), B = MatrixXd::Zero(8, 6);
  MatrixXd J = MatrixXd::Zero(6, 4), along = MatrixXd::Zero(3, 6), small = MatrixXd::Zero(2, 2);
  Wrenches beyond = Wrenches(1), before = Wrenches(1), outside = Wrenches(1);

  Arguments() {
    beyond[0].section = 2;
    before[0].section = -1;
    outside[0].fraction = 1.5;
  }
};

TEST_SUITE_BEGIN("assertions");

TEST_CASE("debug builds assert sizes of the dynamics") {
  if (!asserted) return;
  Arguments a;
  const Model& m = a.model;
  CHECK_FALSE(stops([&] { forward_dynamics(m, a.data, a.q, a.qd, a.F, a.out); }));
  for (const VectorXd& wrong : {a.short_q, a.long_q}) {
    CHECK(stops([&] { mass_matrix(m, a.data, wrong, a.M); }));
    CHECK(stops([&] { bias(m, a.data, wrong, a.qd, a.out); }));
    CHECK(stops([&] { bias(m, a.data, a.q, wrong, a.out); }));
    CHECK(stops([&] { forward_dynamics(m, a.data, wrong, a.qd, a.F, a.out); }));
    CHECK(stops([&] { forward_dynamics_force(m, a.data, a.q, a.qd, wrong, a.out); }));
    CHECK(stops([&] { inverse_dynamics(m, a.data, a.q, a.qd, wrong, a.out); }));
    CHECK(stops([&] { (void)kinetic_energy(m, a.data, a.q, wrong); }));
    CHECK(stops([&] { (void)potential_energy(m, a.data, wrong); }));
    CHECK(stops([&] { potential_gradient(m, a.data, wrong, a.out); }));
    CHECK(stops([&] { potential_hessian(m, a.data, wrong, a.M); }));
    CHECK(stops([&] { total_force(m, wrong, a.qd, a.F, no_wrenches(), a.out); }));
    CHECK(stops([&] { linearize(m, a.data, a.q, wrong, a.F, a.A, a.B); }));
  }
  CHECK(stops([&] { mass_matrix(m, a.data, a.q, a.small); }));
  CHECK(stops([&] { bias(m, a.data, a.q, a.qd, a.short_q); }));
  CHECK(stops([&] { potential_gradient(m, a.data, a.q, a.short_q); }));
  CHECK(stops([&] { potential_hessian(m, a.data, a.q, a.small); }));
  CHECK(stops([&] { forward_dynamics(m, a.data, a.q, a.qd, a.short_F, a.out); }));
  CHECK(stops([&] { forward_dynamics(m, a.data, a.q, a.qd, a.F, a.short_q); }));
  CHECK(stops([&] { inverse_dynamics(m, a.data, a.q, a.qd, a.qdd, a.short_q); }));
  CHECK(stops([&] { linearize(m, a.data, a.q, a.qd, a.F, a.small, a.B); }));
  CHECK(stops([&] { linearize(m, a.data, a.q, a.qd, a.F, a.A, a.small); }));
  CHECK(stops([&] { linearize(m, a.data, a.q, a.qd, a.short_F, a.A, a.B); }));
  CHECK(stops([&] { state_jacobian(m, a.data, a.q, a.qd, a.F, no_wrenches(), a.small); }));
  CHECK(stops([&] { static_stiffness(m, a.q, a.F, no_wrenches(), a.small); }));
  CHECK(stops([&] { static_stiffness(m, a.q, a.short_F, no_wrenches(), a.M); }));
}

TEST_CASE("debug builds assert that data belongs to the model") {
  if (!asserted) return;
  Arguments a;
  CHECK(stops([&] { mass_matrix(a.model, a.data_of_other, a.q, a.M); }));
  CHECK(stops([&] { forward_dynamics(a.model, a.data_of_other, a.q, a.qd, a.F, a.out); }));
  CHECK(stops(
      [&] { forward_dynamics(a.model, a.data_of_other, a.q, a.qd, a.F, no_wrenches(), a.out); }));
  CHECK(stops([&] { linearize(a.model, a.data_of_other, a.q, a.qd, a.F, a.A, a.B); }));
  const Model copy = a.model;
  CHECK_FALSE(stops([&] { mass_matrix(copy, a.data, a.q, a.M); }));
}

TEST_CASE("debug builds assert sizes and indices of cables, places and wrenches") {
  if (!asserted) return;
  Arguments a;
  const Model& m = a.model;
  CHECK(stops([&] { actuation_force(m, a.short_F, a.out); }));
  CHECK(stops([&] { actuation_force(m, a.F, a.short_q); }));
  CHECK(stops([&] { cable_tensions(m, a.q, a.qd, a.short_F, a.out_F); }));
  CHECK(stops([&] { cable_tensions(m, a.q, a.qd, a.F, a.short_F); }));
  CHECK(stops([&] { cable_force(m, a.short_q, a.qd, a.F, a.out); }));
  CHECK(stops([&] { cable_force(m, a.q, a.qd, a.F, a.short_q); }));
  CHECK(stops([&] { tensions_along(m, a.q, a.qd, a.F, a.small); }));
  CHECK(stops([&] { (void)friction_power(m, a.short_q, a.qd, a.F); }));
  CHECK(stops([&] { (void)cable_energy(m, a.q, a.short_F); }));
  CHECK(stops([&] { rest_command(m, a.short_F); }));
  CHECK(stops([&] { cable_lengths(m, a.short_q, a.out_F); }));
  CHECK(stops([&] { cable_commands(m, a.q, a.F, a.short_F); }));
  CHECK_FALSE(stops([&] { tensions_along(m, a.q, a.qd, a.F, a.along); }));
  CHECK_FALSE(stops([&] { jacobian(m, a.q, 1, 0.5, a.J); }));
  for (const Index wrong : {-1, 6}) {
    CHECK(stops([&] { (void)cable_pull(m, wrong, a.q, a.qd, 0.0); }));
    CHECK(stops([&] { (void)Allocator(m).at_limit(wrong); }));
  }
  for (const Index wrong : {-1, 2}) {
    CHECK(stops([&] { (void)pose(m, a.q, wrong, 0.5); }));
    CHECK(stops([&] { jacobian(m, a.q, wrong, 0.5, a.J); }));
  }
  for (const Index wrong : {-1, 3}) CHECK(stops([&] { (void)m.first_coordinate(wrong); }));
  CHECK(stops([&] { (void)pose(m, a.q, 0, 1.5); }));
  CHECK(stops([&] { (void)tip(m, a.short_q); }));
  CHECK(stops([&] { jacobian(m, a.q, 0, 0.5, a.small); }));
  CHECK(stops([&] { tip_jacobian(m, a.q, a.small); }));
  CHECK(stops([&] { actuation_matrix(m, a.q, a.small); }));
  for (const Wrenches& wrong : {a.beyond, a.before, a.outside}) {
    CHECK(stops([&] { add_wrench_force(m, a.q, wrong, a.out); }));
    CHECK(stops([&] { total_force(m, a.q, a.qd, a.F, wrong, a.out); }));
    CHECK(stops([&] { static_stiffness(m, a.q, a.F, wrong, a.M); }));
    CHECK(stops([&] { state_jacobian(m, a.data, a.q, a.qd, a.F, wrong, a.A); }));
  }
}

TEST_CASE("debug builds assert sizes and segments of inputs") {
  if (!asserted) return;
  Arguments a;
  const auto table = CommandInput::table(Eigen::Vector2d(0.0, 1.0), MatrixXd::Ones(2, 6),
                                         CommandInput::Interpolation::linear);
  CHECK_FALSE(stops([&] { table.evaluate(0.5, 1, a.q, a.qd, a.F); }));
  CHECK(stops([&] { table.evaluate(0.5, 1, a.q, a.qd, a.short_F); }));
  for (const Index wrong : {-1, 3}) {
    CHECK(stops([&] { table.evaluate(0.5, wrong, a.q, a.qd, a.F); }));
    CHECK(stops([&] { (void)table.is_constant(wrong); }));
  }
  WrenchInput loads(Wrenches(2));
  CHECK(stops([&] {
    Wrenches one(1);
    loads.evaluate(0.0, 0.0, one);
  }));
  const auto input = CommandInput::constant(a.F);
  CHECK(stops([&] { RobotOde(a.model, input).start_segment(0.0, a.q); }));
}

TEST_CASE("what returns a status tells of wrong sizes, without allocating") {
  Arguments a;
  Pid pid(a.model, PidOptions{});
  Allocator allocator(a.model);
  InverseSolver solver(a.model);
  const VectorXd force = VectorXd::Ones(2);
  Status status = Status::ok;
  bool met = true;
  const InverseKinematics* answer = nullptr;
  const Vector3d p(0.1, 0.0, 0.3);
  for (const VectorXd& wrong : {a.short_q, a.long_q}) {
    const auto check_update = [&](Index allocated) {
      CHECK(allocated == 0);
      CHECK(status == Status::wrong_size);
    };
    check_update(allocations_of([&] { status = pid.update(0.0, wrong, a.qd, a.F); }));
    check_update(allocations_of([&] { status = pid.update(0.0, a.q, wrong, a.F); }));
    check_update(allocations_of([&] { status = check_state(a.model, wrong); }));
    CHECK(allocations_of([&] { answer = &solver.solve(p, {}, wrong); }) == 0);
    CHECK(answer->reach == IkStatus::wrong_size);
    CHECK_FALSE(answer->reachable);
    CHECK(answer->q == VectorXd::Zero(4));
    CHECK(solver.message().find("q0 must have a value for each of the 4 coordinates") == 0);
  }
  CHECK(allocations_of([&] { status = pid.update(0.0, a.q, a.qd, a.short_F); }) == 0);
  CHECK(status == Status::wrong_size);
  CHECK(pid.integral() == VectorXd::Zero(4));
  CHECK(allocations_of([&] { met = allocator.solve(force); }) == 0);
  CHECK_FALSE(met);
}

TEST_CASE("set up refuses what does not fit by a sentence") {
  Arguments a;
  CHECK_THROWS_SENTENCE((void)cable_name(a.model, 6), "cable must be an index from 0 to 5, got 6");
  CHECK_THROWS_SENTENCE((void)cable_name(a.model, -1),
                        "cable must be an index from 0 to 5, got -1");
  const auto input = CommandInput::constant(a.F);
  for (const Method method : {Method::rk4, Method::dopri5, Method::dop853}) {
    RobotOde ode(a.model, input);
    const auto integrator = make_integrator(ode, method, Options());
    CHECK_THROWS_SENTENCE((void)integrator->restart(0.0, a.q, 1.0),
                          "restart takes 8 states and t_stop > t, got 4 states, t = 0 s and "
                          "t_stop = 1 s");
  }
}

TEST_CASE("a simulator tells of a wrench that it cannot take, and stays where it is") {
  Arguments a;
  Simulator simulator(a.model);
  simulator.reset(a.q, a.qd);
  Wrenches infinite(1);
  infinite[0].force[2] = nan;
  for (const Wrenches& wrong : {a.beyond, a.before, a.outside, infinite}) {
    Status status = Status::ok;
    CHECK(allocations_of([&] { status = simulator.step(a.F, wrong); }) == 0);
    CHECK(status == Status::invalid_wrench);
    CHECK(simulator.time() == 0.0);
  }
  CHECK(simulator.step(a.F, Wrenches(1)) == Status::ok);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
