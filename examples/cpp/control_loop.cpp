// A loop at 1 kHz, as in examples/12_control_loop.py: the simulator stands where the robot will
// stand. Once each period the loop reads the state, computes tensions and hands them over. Set-up
// may allocate and throw; the loop does neither. During the second second 0.5 N push on the tip.
#include <algorithm>
#include <cdcr/cdcr.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  constexpr double degree = 3.14159265358979323846 / 180.0;
  constexpr double kp = 2.0, kd = 0.3;  // [N m/rad], [N m s/rad]

  // Set-up: the robot, the shape to hold and the moment that holds it.
  cdcr::Robot robot = cdcr::amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  robot.sections[0].damping = 5e-3;
  const cdcr::Model model(robot);
  cdcr::Data data(model);

  const cdcr::VectorXd goal = Eigen::Vector2d(30.0 * degree, 0.0);
  cdcr::VectorXd hold(2), moment(2);
  cdcr::potential_gradient(model, data, goal, hold);

  cdcr::TensionLimits limits;
  limits.min_tension = 0.5;  // [N]
  cdcr::Allocator allocator(model, limits);

  cdcr::Wrench push;
  push.force = {0.0, 0.5, 0.0};  // at the tip [N]
  const cdcr::Wrenches pushed = {push};

  constexpr int periods = 3000;
  std::vector<double> cost(periods);  // [us]
  double off = 0.0, largest = 0.0;    // at the end of the push [deg], [N]

  cdcr::Simulator simulator(model, 1e-3);
  simulator.reset(goal, cdcr::VectorXd::Zero(2));

  // Run: a loop with a real robot would wait for its clock once a period.
  for (int k = 0; k < periods; ++k) {
    const auto start = std::chrono::steady_clock::now();
    moment = hold + kp * (goal - simulator.q()) - kd * simulator.qd();
    if (!allocator.solve(moment)) return 1;
    const bool push_now = 1000 <= k && k < 2000;
    const cdcr::Status status =
        simulator.step(allocator.tension(), push_now ? pushed : cdcr::no_wrenches());
    if (status != cdcr::Status::ok) {
      std::fprintf(stderr, "period %d: %s\n", k, cdcr::name(status));
      return 1;
    }
    cost[static_cast<std::size_t>(k)] =
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    largest = std::max(largest, allocator.tension().maxCoeff());
    if (k == 1999) off = (simulator.q() - goal).norm() / degree;
  }

  std::printf("pushed: %.3f deg off; a second later: %.4f deg\n", off,
              (simulator.q() - goal).norm() / degree);
  std::printf("largest tension: %.2f N\n", largest);
  std::nth_element(cost.begin(), cost.begin() + periods / 2, cost.end());
  std::printf("a period took %.2f us of the 1000 us that it has (median)\n", cost[periods / 2]);
  return 0;
}
