// What the headers call real-time safe: no exception can leave it, no memory is allocated in it.
#include <doctest/doctest.h>

#include <cstdlib>
#include <limits>

#include "cdcr/cdcr.hpp"
#include "support/allocations.hpp"
#include "support/cases.hpp"
#include "support/noexcept.hpp"

namespace cdcr::test {
namespace {

static_assert(is_noexcept<decltype(&actuation_force)>);
static_assert(is_noexcept<decltype(&forward_dynamics_force)>);
static_assert(is_noexcept<decltype(&potential_hessian)>);
static_assert(is_noexcept<decltype(&state_jacobian)>);
static_assert(is_noexcept<decltype(&acceleration_derivatives)>);
static_assert(is_noexcept<decltype(&kinematic_hessian)>);
static_assert(is_noexcept<decltype(&tip_hessian)>);
static_assert(is_noexcept<decltype(&InverseSolver::solve)>);
static_assert(is_noexcept<decltype(&polar)>);
static_assert(is_noexcept<decltype(&bending)>);
static_assert(is_noexcept<decltype(&check_tension)>);
static_assert(is_noexcept<decltype(&message)>);
static_assert(is_noexcept<decltype(&Simulator::q)>);
static_assert(is_noexcept<decltype(&Simulator::qd)>);
static_assert(is_noexcept<decltype(&Simulator::time)>);

// Overloaded functions have no single address.
using Vector = const ConstVectorRef&;
template <class Result, class... Arguments>
using Of = Result (*)(const Model&, Arguments...) noexcept;
[[maybe_unused]] constexpr Of<void, Data&, Vector, MatrixRef> one_mass_matrix = &mass_matrix;
[[maybe_unused]] constexpr Of<void, Data&, Vector, Vector, VectorRef> one_bias = &bias;
[[maybe_unused]] constexpr Of<double, Data&, Vector, Vector> one_kinetic_energy = &kinetic_energy;
[[maybe_unused]] constexpr Of<double, Data&, Vector> one_potential_energy = &potential_energy;
[[maybe_unused]] constexpr Of<void, Data&, Vector, VectorRef> one_potential_gradient =
    &potential_gradient;
[[maybe_unused]] constexpr Of<Pose, Vector, Index, double> one_pose = &pose;
[[maybe_unused]] constexpr Of<Pose, Vector> one_tip = &tip;
[[maybe_unused]] constexpr Of<void, Vector, Index, double, MatrixRef> one_jacobian = &jacobian;
[[maybe_unused]] constexpr Of<void, Vector, VectorRef> one_cable_lengths = &cable_lengths;
template <class... Arguments>
using DynamicsFunction = void (*)(const Model&, Data&, Vector, Vector, Vector,
                                  Arguments...) noexcept;
[[maybe_unused]] constexpr DynamicsFunction<VectorRef> forward = &forward_dynamics;
[[maybe_unused]] constexpr DynamicsFunction<const Wrenches&, VectorRef> forward_under_wrenches =
    &forward_dynamics;
[[maybe_unused]] constexpr DynamicsFunction<VectorRef> inverse = &inverse_dynamics;
[[maybe_unused]] constexpr DynamicsFunction<const Wrenches&, VectorRef> inverse_beside_wrenches =
    &inverse_dynamics;
[[maybe_unused]] constexpr DynamicsFunction<MatrixRef, MatrixRef> linear = &linearize;
[[maybe_unused]] constexpr DynamicsFunction<const Wrenches&, MatrixRef, MatrixRef>
    linear_under_wrenches = &linearize;
using Step = Status (Simulator::*)(Vector) noexcept;
using StepUnderWrenches = Status (Simulator::*)(Vector, const Wrenches&) noexcept;
[[maybe_unused]] constexpr Step step = &Simulator::step;
[[maybe_unused]] constexpr StepUnderWrenches step_under_wrenches = &Simulator::step;

volatile double sink = 0.0;  // keeps results alive

TEST_SUITE_BEGIN("realtime");

TEST_CASE("the counter counts") {
  if (!allocations_counted) return;
  CHECK(allocations_of([] {}) == 0);
  CHECK(allocations_of([] {
          const VectorXd ones = VectorXd::Ones(7);
          const double* volatile seen = ones.data();  // else clang leaves the allocation out
          sink = *seen;
        }) >= 1);
  CHECK(allocations_of([] { delete new double(sink); }) <= 1);
  CHECK(allocations_of([] {
          void* volatile block = std::malloc(3);
          std::free(block);
        }) == 1);
}

TEST_CASE("dynamics and linearisation allocate nothing") {
  for_each_case(3.0 * pi, [](const Model& model, Data& data, const State& state) {
    VectorXd v(2);
    MatrixXd M(2, 2), A(4, 4), B(4, model.num_cables());
    const VectorXd &q = state.q, &qd = state.qd, &F = state.tension;
    const Eigen::Vector2d force(0.1, -0.2);
    CHECK(allocations_of([&] { mass_matrix(model, data, q, M); }) == 0);
    CHECK(allocations_of([&] { bias(model, data, q, qd, v); }) == 0);
    CHECK(allocations_of([&] { actuation_force(model, F, v); }) == 0);
    CHECK(allocations_of([&] { forward_dynamics(model, data, q, qd, F, v); }) == 0);
    CHECK(allocations_of([&] { forward_dynamics_force(model, data, q, qd, force, v); }) == 0);
    CHECK(allocations_of([&] { inverse_dynamics(model, data, q, qd, force, v); }) == 0);
    CHECK(allocations_of([&] { sink = kinetic_energy(model, data, q, qd); }) == 0);
    CHECK(allocations_of([&] { sink = potential_energy(model, data, q); }) == 0);
    CHECK(allocations_of([&] { potential_gradient(model, data, q, v); }) == 0);
    CHECK(allocations_of([&] { potential_hessian(model, data, q, M); }) == 0);
    CHECK(allocations_of([&] { linearize(model, data, q, qd, F, A, B); }) == 0);
    CHECK(allocations_of([&] { state_jacobian(model, data, q, qd, F, no_wrenches(), A); }) == 0);
  });
}

TEST_CASE("segments of a longer vector are used in place") {
  const Model model(amouri2020());
  Data data(model);
  VectorXd y(4), dydt(4), F = VectorXd::Ones(5);
  y << 0.1, 0.2, 0.3, 0.4;
  CHECK(allocations_of([&] {
          forward_dynamics(model, data, y.head(2), y.tail(2), F.segment(1, 3), dydt.tail(2));
        }) == 0);
}

TEST_CASE("kinematics allocates nothing") {
  for_each_case(3.0 * pi, [](const Model& model, Data&, const State& state) {
    MatrixXd J(6, 2);
    VectorXd lengths(model.num_cables());
    CHECK(allocations_of([&] { sink = pose(model, state.q, 0, 0.5).p[0]; }) == 0);
    CHECK(allocations_of([&] { sink = tip(model, state.q).p[0]; }) == 0);
    CHECK(allocations_of([&] { jacobian(model, state.q, 0, 0.7, J); }) == 0);
    CHECK(allocations_of([&] { cable_lengths(model, state.q, lengths); }) == 0);
    const Vector3d p(0.1, 0.2, 0.3);
    InverseSolver solver(model);
    CHECK(allocations_of([&] { sink = solver.solve(p).distance; }) == 0);
  });
}

TEST_CASE("a simulator's step allocates nothing, not even the first or a failing one") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for_each_case(1.0, [&](const Model& model, Data&, const State& state) {
    Simulator sim(model, 1e-4, 2);
    Status status = Status::ok;
    VectorXd wrong = state.tension;
    const VectorXd too_many = VectorXd::Ones(model.num_cables() + 1);
    CHECK(allocations_of([&] { status = sim.step(state.tension); }) == 0);
    CHECK(status == Status::not_started);
    sim.reset(state.q, 0.1 * state.qd);
    for (int i = 0; i < 3; ++i) {
      CHECK(allocations_of([&] { status = sim.step(state.tension); }) == 0);
    }
    if (wrong.size() > 0) wrong[0] = nan;
    CHECK(allocations_of([&] { status = sim.step(wrong); }) == 0);
    CHECK(allocations_of([&] { status = sim.step(too_many); }) == 0);
    CHECK(status == Status::invalid_tension);
    CHECK(allocations_of([&] { sink = message(status)[0]; }) == 0);
  });
}

TEST_CASE("tables and constants are evaluated without allocating") {
  VectorXd F(3);
  const Eigen::Vector2d q(0.1, 0.2);
  const CommandInput table = CommandInput::table(Eigen::Vector2d(0.0, 1.0), MatrixXd::Ones(2, 3),
                                                 CommandInput::Interpolation::linear);
  const CommandInput constant = CommandInput::constant(Eigen::Vector3d(1.0, 2.0, 3.0));
  CHECK(allocations_of([&] { table.evaluate(0.5, table.segment(0.5), q, q, F); }) == 0);
  CHECK(allocations_of([&] { constant.evaluate(0.5, 0, q, q, F); }) == 0);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
