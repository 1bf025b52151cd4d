// Robots of several sections whose cables rub or are driven by length, under wrenches: what the
// headers call real-time safe allocates nothing there either.
#include <doctest/doctest.h>

#include <limits>

#include "cdcr/cdcr.hpp"
#include "support/allocations.hpp"
#include "support/cable_robots.hpp"
#include "support/noexcept.hpp"

namespace cdcr::test {
namespace {

static_assert(is_noexcept<decltype(&cable_tensions)>);
using CableForce = void(const Model&, const ConstVectorRef&, const ConstVectorRef&,
                        const ConstVectorRef&, VectorRef) noexcept;
static_assert(is_noexcept<decltype(static_cast<CableForce*>(&cable_force))>);
using CableForceThatRemembers = void(const Model&, const ConstVectorRef&, const ConstVectorRef&,
                                     const ConstVectorRef&, const ConstVectorRef&, VectorRef,
                                     VectorRef) noexcept;
static_assert(is_noexcept<decltype(static_cast<CableForceThatRemembers*>(&cable_force))>);
static_assert(is_noexcept<decltype(&cable_pull)>);
static_assert(is_noexcept<decltype(&tensions_along)>);
using FrictionPower = double(const Model&, const ConstVectorRef&, const ConstVectorRef&,
                             const ConstVectorRef&) noexcept;
static_assert(is_noexcept<decltype(static_cast<FrictionPower*>(&friction_power))>);
static_assert(is_noexcept<decltype(&cable_energy)>);
static_assert(is_noexcept<decltype(&rest_command)>);
static_assert(is_noexcept<decltype(&add_wrench_force)>);
using StaticStiffness = void(const Model&, Data&, const ConstVectorRef&, const ConstVectorRef&,
                             const Wrenches&, MatrixRef) noexcept;
static_assert(is_noexcept<decltype(static_cast<StaticStiffness*>(&static_stiffness))>);
static_assert(is_noexcept<decltype(&check_state)>);

volatile double sink = 0.0;  // keeps results alive

/// Three sections, rubbing cables on each, driven by tension and by length, gravity, a payload.
Robot everything() {
  Robot robot = parts_with_cables(3, 0.0, 0.0);
  robot.gravity = {1.0, 0.0, 9.81};
  robot.payload = 0.02;
  robot.payload_position = {0.0, 0.01, 0.02};
  robot.base_position = {0.5, 0.0, 1.0};
  robot.tool(2, 3) = 0.05;
  for (Section& section : robot.sections) section.cable_friction = 0.3;
  robot.cables.push_back({0.015, 0.3, 2, 2e3, 1.0, 0.1});
  robot.cables.push_back({0.015, 3.4, 1, 5e3, 2.0, std::nullopt});
  return robot;
}

struct Rig {
  Model model{everything()};
  Data data{model};
  VectorXd q, qd, command;
  Wrenches wrenches;
};

/// body(model, data, q, qd, command, wrenches) in a few states, straight ones among them, with
/// cables slack and taut.
template <class Body>
void for_each_state(Body body) {
  Random random;
  INFO(random);
  Rig rig;
  for (int i = 0; i < 20; ++i) {
    rig.q = i == 0 ? VectorXd::Zero(6) : random_bending(3, 2.0, random);
    rig.qd = random.vector(6, i % 3 == 0 ? 0.0 : 5.0);
    rig.command = random_command(rig.model, rig.q, 10.0, random);
    rig.wrenches = random_wrenches(rig.model, 3, random);
    CAPTURE(i);
    body(rig.model, rig.data, rig.q, rig.qd, rig.command, rig.wrenches);
  }
}

TEST_SUITE_BEGIN("realtime_sections");

TEST_CASE("dynamics of three sections under everything allocate nothing") {
  for_each_state([](const Model& model, Data& data, const VectorXd& q, const VectorXd& qd,
                    const VectorXd& command, const Wrenches& wrenches) {
    VectorXd v(6);
    MatrixXd M(6, 6), A(12, 12), B(12, model.num_cables());
    CHECK(allocations_of([&] { mass_matrix(model, data, q, M); }) == 0);
    CHECK(allocations_of([&] { bias(model, data, q, qd, v); }) == 0);
    CHECK(allocations_of([&] { forward_dynamics(model, data, q, qd, command, v); }) == 0);
    CHECK(allocations_of([&] { forward_dynamics(model, data, q, qd, command, wrenches, v); }) == 0);
    CHECK(v.allFinite());
    const VectorXd qdd = v;
    CHECK(allocations_of([&] { inverse_dynamics(model, data, q, qd, qdd, v); }) == 0);
    CHECK(allocations_of([&] { forward_dynamics_force(model, data, q, qd, qdd, v); }) == 0);
    CHECK(allocations_of([&] { sink = kinetic_energy(model, data, q, qd); }) == 0);
    CHECK(allocations_of([&] { sink = potential_energy(model, data, q); }) == 0);
    CHECK(allocations_of([&] { potential_gradient(model, data, q, v); }) == 0);
    CHECK(allocations_of([&] { potential_hessian(model, data, q, M); }) == 0);
    CHECK(allocations_of([&] { linearize(model, data, q, qd, command, wrenches, A, B); }) == 0);
    CHECK(allocations_of([&] { state_jacobian(model, data, q, qd, command, wrenches, A); }) == 0);
    CHECK(A.allFinite());
    MatrixXd on_q(6, 6), on_qd(6, 6), on_command(6, model.num_cables()), on_wrenches(6, 18);
    CHECK(allocations_of([&] {
            acceleration_derivatives(model, data, q, qd, command, wrenches, on_q, on_qd, on_command,
                                     on_wrenches);
          }) == 0);
    CHECK(on_wrenches.allFinite());
    CHECK(allocations_of([&] { static_stiffness(model, q, command, wrenches, M); }) == 0);
    CHECK(M.allFinite());
  });
}

TEST_CASE("cables, wrenches and kinematics of three sections allocate nothing") {
  for_each_state([](const Model& model, Data& /*data*/, const VectorXd& q, const VectorXd& qd,
                    const VectorXd& command, const Wrenches& wrenches) {
    VectorXd force = VectorXd::Zero(6), each(model.num_cables());
    MatrixXd along(4, model.num_cables()), J(6, 6);
    const Index spring = model.num_cables() - 1;
    CHECK(allocations_of([&] { cable_tensions(model, q, qd, command, each); }) == 0);
    CHECK(allocations_of([&] { cable_force(model, q, qd, command, force); }) == 0);
    CHECK(allocations_of([&] { sink = cable_pull(model, spring, q, qd, command[spring]); }) == 0);
    CHECK(allocations_of([&] { tensions_along(model, q, qd, command, along); }) == 0);
    CHECK(allocations_of([&] { sink = friction_power(model, q, qd, command); }) == 0);
    CHECK(allocations_of([&] { sink = cable_energy(model, q, command); }) == 0);
    CHECK(allocations_of([&] { rest_command(model, each); }) == 0);
    CHECK(allocations_of([&] { add_wrench_force(model, q, wrenches, force); }) == 0);
    CHECK(allocations_of([&] { cable_lengths(model, q, each); }) == 0);
    CHECK(allocations_of([&] { sink = tip(model, q).p[0]; }) == 0);
    CHECK(allocations_of([&] { jacobian(model, q, 2, 0.7, J); }) == 0);
    CHECK(allocations_of([&] { tip_jacobian(model, q, J); }) == 0);
    MatrixXd H(6, 36);
    CHECK(allocations_of([&] { kinematic_hessian(model, q, 2, 0.7, H); }) == 0);
    CHECK(allocations_of([&] { tip_hessian(model, q, H); }) == 0);
    MatrixXd B(6, model.num_cables());
    CHECK(allocations_of([&] { actuation_matrix(model, q, B); }) == 0);
  });
}

TEST_CASE("a simulator's step with all of it allocates nothing, not even when it fails") {
  for_each_state([](const Model& model, Data& /*data*/, const VectorXd& q, const VectorXd& qd,
                    const VectorXd& command, const Wrenches& wrenches) {
    Simulator sim(model, 1e-5, 2);
    Status status = Status::ok;
    CHECK(allocations_of([&] { status = sim.step(command, wrenches); }) == 0);
    CHECK(status == Status::not_started);
    sim.reset(q, qd);
    for (int k = 0; k < 3; ++k) {
      CHECK(allocations_of([&] { status = sim.step(command, wrenches); }) == 0);
      CHECK(status == Status::ok);
    }
    VectorXd wrong = command;
    wrong[model.num_cables() - 1] = -1e-9;
    CHECK(allocations_of([&] { status = sim.step(wrong, wrenches); }) == 0);
    CHECK(status == Status::invalid_tension);
    wrong[model.num_cables() - 1] = std::numeric_limits<double>::quiet_NaN();
    CHECK(allocations_of([&] { status = sim.step(wrong, wrenches); }) == 0);
    CHECK(status == Status::invalid_tension);
  });
}

TEST_CASE("wrenches over time are evaluated without allocating") {
  Rig rig;
  Random random;
  WrenchInput loads;
  for (const Wrench& wrench : random_wrenches(rig.model, 2, random)) {
    loads.add(wrench, {{0.0, 1.0, 2.0}, {0.0, 1.0, 0.5}, true, {}});
    loads.add(wrench, {{0.0, 1.5}, {1.0, 0.0}, false, {}});
  }
  Wrenches now = loads.wrenches();
  for (const double t : {-1.0, 0.0, 0.7, 1.0, 1.5, 3.0}) {
    CHECK(allocations_of([&] { loads.evaluate(t, t, now); }) == 0);
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
