// The control loop's call: one step of 1 ms through Simulator, by Runge-Kutta 4 and, of robots cut
// into parts, by the linearly implicit method.
#include "harness.hpp"
#include "scenario.hpp"

namespace cdcr::bench {
namespace {

void measure(const Harness& harness, const std::string& suffix, bool gravity) {
  Simulator simulator{Model(robot(gravity)), 1e-3};
  const VectorXd tension = Eigen::Vector3d(5.0, 1.0, 0.0);
  const auto restart = [&simulator] { simulator.reset(bent().q, bent().qd); };
  const auto step = [&](long /*i*/) { keep(simulator.step(tension)); };

  restart();
  harness.run({"Simulator.step" + suffix}, restart, step);
  // One period a sample: what the clock costs is in it, and what the machine does besides.
  Plan periods{"Simulator.step, each period" + suffix, "us", 1, 200000, 1000.0};
  harness.run(periods, [] {}, step);
}

/// A period of 1 ms of a robot in parts by the implicit method, whose step they do not bound.
void measure_implicit(const Harness& harness, int parts) {
  const Model model(in_parts(parts));
  Simulator simulator(model, 1e-3, 1, Method::rosenbrock);
  const VectorXd tension = Eigen::Vector3d(5.0, 1.0, 0.0);
  const VectorXd still = VectorXd::Zero(model.num_coordinates());
  const Plan plan{"Simulator.step by rosenbrock, " + std::to_string(parts) + " parts", "us", 1000,
                  10, 1000.0};
  harness.run(
      plan, [&] { simulator.reset(still, still); },
      [&](long /*i*/) { keep(simulator.step(tension)); });
}

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  const cdcr::bench::Harness harness(argc, argv);
  cdcr::bench::measure(harness, "", false);
  cdcr::bench::measure(harness, ", gravity", true);
  for (const int parts : {1, 4, 12, 24}) cdcr::bench::measure_implicit(harness, parts);
}
