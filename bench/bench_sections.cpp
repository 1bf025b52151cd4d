// Robots of several sections: functions of one state over the number of sections, and one second
// of a robot of three sections in steps of Runge-Kutta 4.
#include <cmath>
#include <memory>
#include <random>
#include <sstream>

#include "harness.hpp"
#include "scenario.hpp"

namespace cdcr::bench {
namespace {

constexpr int num_states = 64;

/// Bent and moving: evenly random, each section up to 1.5 rad and 3 rad/s a component.
std::vector<State> random_states(Index num_coordinates) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<State> states(num_states);
  for (State& state : states) {
    state.q = VectorXd::NullaryExpr(num_coordinates, [&] { return unit(engine); });
    state.qd = VectorXd::NullaryExpr(num_coordinates, [&] { return 3.0 * unit(engine); });
  }
  return states;
}

void measure_functions(const Harness& harness, Index n) {
  const Model model(arm(n));
  const Index m = model.num_coordinates();
  const std::vector<State> states = random_states(m);
  const auto state = [&states](long i) -> const State& { return states[i % num_states]; };
  const std::string suffix = ", " + std::to_string(n) + " sections";
  const VectorXd tension = VectorXd::Ones(model.num_cables()), qdd = VectorXd::Ones(m);
  Data data(model);
  VectorXd out(m);
  MatrixXd M(m, m), A(2 * m, 2 * m), B(2 * m, model.num_cables());
  const auto nothing = [] {};
  const auto plan = [&suffix](const char* name, long calls) {
    return Plan{name + suffix, "us", calls, 1000};
  };
  harness.run(plan("forward_dynamics", 200), nothing, [&](long i) {
    forward_dynamics(model, data, state(i).q, state(i).qd, tension, out);
    keep(out);
  });
  harness.run(plan("inverse_dynamics", 200), nothing, [&](long i) {
    inverse_dynamics(model, data, state(i).q, state(i).qd, qdd, out);
    keep(out);
  });
  harness.run(plan("mass_matrix", 200), nothing, [&](long i) {
    mass_matrix(model, data, state(i).q, M);
    keep(M);
  });
  harness.run(plan("state_jacobian", 10), nothing, [&](long i) {
    state_jacobian(model, data, state(i).q, state(i).qd, tension, no_wrenches(), A);
    keep(A);
  });
  harness.run(plan("linearize", 10), nothing, [&](long i) {
    linearize(model, data, state(i).q, state(i).qd, tension, A, B);
    keep(A);
    keep(B);
  });
  harness.run(plan("potential_hessian", 10), nothing, [&](long i) {
    potential_hessian(model, data, state(i).q, M);
    keep(M);
  });
}

/// State after one second under `command`; empty where the steps did not stay bounded.
VectorXd one_second(const Model& model, const VectorXd& command, double step) {
  Simulator simulator(model, step);
  const VectorXd straight = VectorXd::Zero(model.num_coordinates());
  simulator.reset(straight, straight);
  const long periods = std::lround(1.0 / step);
  for (long i = 0; i < periods; ++i) {
    if (simulator.step(command) != Status::ok) return {};
  }
  return simulator.q();
}

/// The largest of 1 ms, 0.1 ms ... that is stable: a tenth of it changes the end by less than 1 %.
double stable_step(const Model& model, const VectorXd& command) {
  for (double step = 1e-3; step > 1e-7; step *= 0.1) {
    const VectorXd end = one_second(model, command, step);
    const VectorXd finer = one_second(model, command, 0.1 * step);
    if (end.size() > 0 && (end - finer).norm() < 0.01 * finer.norm()) return step;
  }
  return 0.0;
}

/// A step of one cable of each of three sections.
VectorXd pull(const Model& model) {
  VectorXd command(model.num_cables());
  rest_command(model, command);
  for (const Index cable : {0, 4, 8}) {
    command[cable] += model.cables()[cable].length_driven() ? -5e-3 : 2.0;
  }
  return command;
}

/// As many steps whatever the robot, by which right-hand sides compare.
void measure_steps(const Harness& harness, const std::string& robot_name, const Robot& robot) {
  const std::string name = "10,000 steps of RK4, " + robot_name;
  if (!harness.wants(name)) return;
  const Model model(robot);
  const VectorXd command = pull(model);
  const auto run = [&](long /*i*/) { keep(one_second(model, command, 1e-4)); };
  harness.run({name, "ms", 1, 50}, [] {}, run);
}

void measure_second(const Harness& harness, const std::string& name, const Robot& robot) {
  if (!harness.wants(name)) return;
  const Model model(robot);
  const VectorXd command = pull(model);
  const double step = stable_step(model, command);
  const auto run = [&](long /*i*/) { keep(one_second(model, command, step)); };
  const double before = processor_time();
  run(0);
  std::ostringstream extra;
  extra << R"(, "step": )" << step << R"(, "times real time": )"
        << 1.0 / (processor_time() - before);
  harness.run({name, "ms", 1, 50}, [] {}, run, extra.str());
}

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  using namespace cdcr;
  const bench::Harness harness(argc, argv);
  for (const Index n : {2, 3, 5, 10, 20}) bench::measure_functions(harness, n);
  bench::measure_second(harness, "1 s of 3 sections, RK4", bench::arm(3));
  Robot by_length = bench::arm(3);
  for (Section& section : by_length.sections) {
    section.cable_stiffness = 2e4;
    section.cable_damping = 5.0;
  }
  bench::measure_second(harness, "1 s of 3 sections driven by length, RK4", by_length);
  Robot rubbing = bench::arm(3);
  for (Section& section : rubbing.sections) section.cable_friction = 0.2;
  bench::measure_second(harness, "1 s of 3 sections with friction, RK4", rubbing);
  bench::measure_steps(harness, "3 sections", bench::arm(3));
  bench::measure_steps(harness, "3 sections with friction", rubbing);
  rubbing.presliding_stiffness = 2e4;
  bench::measure_steps(harness, "3 sections with friction that remembers", rubbing);
  for (Section& section : by_length.sections) section.cable_friction = 0.2;
  by_length.presliding_stiffness = 2e4;
  bench::measure_steps(harness, "3 sections by length with friction that remembers", by_length);
  by_length.presliding_stiffness = 0.0;
  for (Section& section : by_length.sections) section.cable_friction = 0.0;
  bench::measure_steps(harness, "3 sections by length", by_length);
}
