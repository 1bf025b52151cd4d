// A controller's use of the library: cdcr::cdcr alone, at 1 kHz, no SUNDIALS anywhere.
#include <cdcr/cdcr.hpp>
#include <cmath>
#include <cstdio>

int main() {
  cdcr::Robot robot = cdcr::amouri2020();
  robot.sections[0].damping = 0.02;  // well damped: at rest after 10 s
  const cdcr::Model model(robot);
  const cdcr::Vector3d tension(5.0, 0.0, 0.0);

  cdcr::Simulator simulator(model, 1e-3);
  simulator.reset(cdcr::VectorXd::Zero(2), cdcr::VectorXd::Zero(2));
  cdcr::Status status = cdcr::Status::ok;
  for (int period = 0; period < 10000 && status == cdcr::Status::ok; ++period) {
    status = simulator.step(tension);
  }
  const cdcr::Polar end = cdcr::polar(simulator.q()[0], simulator.q()[1]);
  const cdcr::VectorXd rest = cdcr::equilibrium(model, tension).q;

  std::printf("cdcr %s: %s after %g s, theta %.6f rad, at rest %.6f rad\n", cdcr::version,
              cdcr::name(status), simulator.time(), end.theta, rest[0]);
  const bool settled = std::abs(end.theta - rest[0]) < 1e-6 && std::abs(end.phi) < 1e-6;
  return status == cdcr::Status::ok && settled ? 0 : 1;
}
