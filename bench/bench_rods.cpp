// Rods, sections whose bending, twist and stretch vary along them, under the tensions of straight
// cables, three a section: forward dynamics and derivatives of one state, and where they rest.
//
// The robot of Table 1, its base tilted by 30 degrees, with rods in place of its section.
#include <random>

#include "harness.hpp"
#include "scenario.hpp"

namespace cdcr::bench {
namespace {

/// So many rods of these orders, -1 for none.
Robot rods(int num_sections, int bending, int twist, int stretch) {
  Robot robot = bench::robot(true);
  Section& section = robot.sections[0];
  section.shear_modulus = section.youngs_modulus / 2.6;
  section.bending_order = bending;
  section.twist_order = twist;
  section.stretch_order = stretch;
  robot.sections.assign(static_cast<std::size_t>(num_sections), Section(section));
  return robot;
}

void measure(const Harness& harness, const Plan& plan, const Robot& robot) {
  const Model model(robot);
  Data data(model);
  constexpr int num_states = 64;
  const Index d = model.num_coordinates(), m = model.first_coordinate(1);
  const Section& section = robot.sections[0];
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<State> states(num_states);
  for (State& state : states) {
    state.q = VectorXd::NullaryExpr(d, [&] { return unit(engine); });
    state.qd = VectorXd::NullaryExpr(d, [&] { return 3.0 * unit(engine); });
    for (Index k = 0; k < d; ++k) {  // stretch is in metres
      if (k % m < m - section.stretch_order - 1) continue;
      state.q[k] *= 0.05 * section.length;
      state.qd[k] *= 0.05 * section.length;
    }
  }
  const VectorXd tension = VectorXd::Ones(model.num_cables());
  VectorXd qdd(d);
  harness.run(
      plan, [] {},
      [&](long i) {
        const State& state = states[static_cast<std::size_t>(i % num_states)];
        forward_dynamics(model, data, state.q, state.qd, tension, qdd);
        keep(qdd);
      });
}

/// Equilibria of one rod, each under other tensions of up to 3 N.
void measure_rest(const Harness& harness, const Plan& plan, const Robot& robot) {
  const Model model(robot);
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> strong(0.0, 3.0);
  std::vector<VectorXd> draws(256, VectorXd(model.num_cables()));
  for (VectorXd& draw : draws) {
    for (double& tension : draw) tension = strong(engine);
  }
  harness.run(
      plan, [] {},
      [&](long i) { keep(equilibrium(model, draws[static_cast<std::size_t>(i) % draws.size()])); });
}

/// The derivatives of so many rods of order 2 with twist, under the cables of Table 1 on each.
void measure_derivatives(const Harness& harness, const Plan& plan, int num_sections) {
  const Model model(rods(num_sections, 2, 0, -1));
  Data data(model);
  const Index d = model.num_coordinates();
  const VectorXd q = VectorXd::Constant(d, 0.2), qd = VectorXd::Constant(d, 0.5),
                 tension = VectorXd::Ones(model.num_cables());
  MatrixXd A(2 * d, 2 * d), B(2 * d, model.num_cables());
  harness.run(
      plan, [] {},
      [&](long /*i*/) {
        linearize(model, data, q, qd, tension, A, B);
        keep(A);
      });
}

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  using namespace cdcr::bench;
  const Harness harness(argc, argv);
  const auto plan = [](const char* name) { return Plan{name, "us", 100, 1000}; };
  measure(harness, plan("forward_dynamics, rod of order 2 with twist"), rods(1, 2, 0, -1));
  measure(harness, plan("forward_dynamics, rod of order 3 with twist and stretch"),
          rods(1, 3, 0, 0));
  measure(harness, plan("forward_dynamics, 3 rods of order 2 with twist"), rods(3, 2, 0, -1));
  measure_rest(harness, {"equilibrium, rod of order 2 with twist", "us", 256, 100},
               rods(1, 2, 0, -1));
  measure_derivatives(harness, {"linearize, rod of order 2 with twist", "us", 10, 1000}, 1);
  measure_derivatives(harness, {"linearize, 3 rods of order 2 with twist", "us", 10, 1000}, 3);
}
