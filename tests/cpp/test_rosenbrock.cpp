// The linearly implicit method of fixed step, in runs and in the simulator.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <limits>

#include "cdcr/linearization.hpp"
#include "cdcr/simulate.hpp"
#include "cdcr/simulator.hpp"
#include "cdcr/statics.hpp"
#include "support/allocations.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/split.hpp"
#include "support/throws.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

// A power of two, so that sums of periods are exact and simulate takes the very same steps.
constexpr double period = 1.0 / 1024.0;
constexpr double at_rest = 1e-9;  // what is left of the motion after 30 s, over the shape

/// Table 1, upright, in parts, damped as a backbone in a sleeve is: rk4 needs steps of 0.1 us.
Model finely_cut(int parts) {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  robot.sections[0].damping = 0.02;
  return Model(split(robot, parts));
}

VectorXd bent(const Model& model) {
  VectorXd q = VectorXd::Zero(model.num_coordinates());
  for (Index i = 0; i < q.size(); i += 2) q[i] = 0.8 / static_cast<double>(model.num_sections());
  return q;
}

TEST_SUITE_BEGIN("rosenbrock");

TEST_CASE("a step is that of its formula, solved as a whole") {
  const double gamma = 1.0 - std::sqrt(0.5);
  for (const int parts : {1, 3}) {
    const Model model = finely_cut(parts);
    const Index d = model.num_coordinates();
    const VectorXd q = bent(model), qd = VectorXd::Constant(d, 0.3);
    const VectorXd pull = Eigen::Vector3d(3.0, 1.0, 0.0);
    Data data(model);
    const auto f = [&](const VectorXd& y) {
      VectorXd slope(2 * d);
      slope.head(d) = y.tail(d);
      forward_dynamics(model, data, y.head(d), y.tail(d), pull, slope.tail(d));
      return slope;
    };
    MatrixXd A(2 * d, 2 * d);
    state_jacobian(model, data, q, qd, pull, no_wrenches(), A);
    const MatrixXd W = MatrixXd::Identity(2 * d, 2 * d) - gamma * period * A;
    const auto lu = W.partialPivLu();
    VectorXd y(2 * d);
    y << q, qd;
    const VectorXd k1 = lu.solve(f(y));
    const VectorXd k2 = lu.solve(f(y + period * k1) - 2.0 * k1);
    const VectorXd next = y + period * (1.5 * k1 + 0.5 * k2);

    Simulator simulator(model, period, 1, Method::rosenbrock);
    simulator.reset(q, qd);
    REQUIRE(simulator.step(pull) == Status::ok);
    CHECK(residual(simulator.q(), next.head(d)) <= tolerance::rounding);
    CHECK(residual(simulator.qd(), next.tail(d)) <= tolerance::recursion);
  }
}

TEST_CASE("steps of the simulator equal those of simulate, to the last bit") {
  const Model model = finely_cut(3);
  const VectorXd q = bent(model), still = VectorXd::Zero(q.size());
  const VectorXd pull = Eigen::Vector3d(3.0, 1.0, 0.0);
  for (const int substeps : {1, 4}) {
    Simulator simulator(model, period, substeps, Method::rosenbrock);
    simulator.reset(q, still);
    const Trajectory run =
        simulate(model, q, still, even_times(0.0, 0.25, 257), CommandInput::constant(pull),
                 Method::rosenbrock, fixed_step(period / substeps));
    REQUIRE(run.status == Status::ok);
    CHECK(run.stats.jacobians == 256 * substeps);
    for (Index i = 1; i <= 256; ++i) {
      REQUIRE(simulator.step(pull) == Status::ok);
      REQUIRE(simulator.q() == run.q.row(i).transpose());
      REQUIRE(simulator.qd() == run.qd.row(i).transpose());
    }
  }
}

TEST_CASE("a damped robot in twelve parts moves in steps of a millisecond") {
  const Model model = finely_cut(12);
  const VectorXd q = bent(model), still = VectorXd::Zero(q.size());
  const VectorXd pull = Eigen::Vector3d(3.0, 0.0, 0.0);

  Simulator explicit_steps(model, 1e-3);
  explicit_steps.reset(q, still);
  Status status = Status::ok;
  for (int i = 0; i < 1000 && status == Status::ok; ++i) status = explicit_steps.step(pull);
  CHECK(status != Status::ok);

  Simulator simulator(model, 1e-3, 1, Method::rosenbrock);
  simulator.reset(q, still);
  const VectorXd none = VectorXd::Zero(3);
  double before = total_energy(model, q, still);
  for (int i = 0; i < 300; ++i) {  // free: nothing but damping changes the energy
    REQUIRE(simulator.step(none) == Status::ok);
    const double energy = total_energy(model, simulator.q(), simulator.qd());
    REQUIRE(energy < before);
    before = energy;
  }
  Simulator longer(model, 1e-2, 1, Method::rosenbrock);
  longer.reset(simulator.q(), simulator.qd());
  for (int i = 0; i < 3000; ++i) REQUIRE(longer.step(pull) == Status::ok);
  const Equilibrium rest = equilibrium(model, pull);
  REQUIRE(rest.status == Status::ok);
  CHECK(residual(longer.q(), rest.q) <= at_rest);
}

TEST_CASE("its steps allocate nothing") {
  for (const int parts : {1, 3, 12}) {
    const Model model = finely_cut(parts);
    Simulator simulator(model, 1e-3, 2, Method::rosenbrock);
    simulator.reset(bent(model), VectorXd::Zero(model.num_coordinates()));
    const VectorXd pull = Eigen::Vector3d(3.0, 1.0, 0.0);
    Wrenches wrenches(1);
    wrenches[0].force = {0.0, 0.1, 0.0};
    Status status = Status::ok;
    CHECK(allocations_of([&] { status = simulator.step(pull); }) == 0);
    CHECK(status == Status::ok);
    CHECK(allocations_of([&] { status = simulator.step(pull, wrenches); }) == 0);
    CHECK(status == Status::ok);
  }
}

TEST_CASE("a step that fails says why and leaves the last good state") {
  const Model model = finely_cut(1);
  for (const auto& [pull, expected] :
       {std::pair{5e4, Status::bending_limit}, std::pair{1e308, Status::non_finite_state}}) {
    Simulator simulator(model, 0.1, 1, Method::rosenbrock);
    const VectorXd q = bent(model), still = VectorXd::Zero(2);
    simulator.reset(q, still);
    CHECK(simulator.step(Eigen::Vector3d(pull, 0.0, 0.0)) == expected);
    CHECK(simulator.q() == q);
    CHECK(simulator.time() == 0.0);
  }
}

TEST_CASE("the simulator takes methods of fixed step alone") {
  const Model model(amouri2020());
  CHECK(Simulator(model, 1e-3, 1, Method::rosenbrock).method() == Method::rosenbrock);
  CHECK_THROWS_SENTENCE(Simulator(model, 1e-3, 1, Method::dopri5),
                        "method of a simulator must be rk4 or rosenbrock, whose steps are fixed");
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
