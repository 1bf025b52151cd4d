// The control loop's call: one Runge-Kutta 4 step of 1 ms through Simulator.
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

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  const cdcr::bench::Harness harness(argc, argv);
  cdcr::bench::measure(harness, "", false);
  cdcr::bench::measure(harness, ", gravity", true);
}
