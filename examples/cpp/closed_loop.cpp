// A closed loop at 1 kHz with motors and sensors that are not ideal, as a controller's author tries
// a law before the robot is there: what examples/21_closed_loop.py does in Python.
#include <cdcr/cdcr.hpp>
#include <cmath>
#include <cstdio>

int main() {
  cdcr::Robot robot = cdcr::amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  robot.sections[0].damping = 5e-3;
  const cdcr::Model model(robot);

  cdcr::ComputedTorqueOptions gains;
  gains.kp = 64.0;
  gains.kd = 16.0;
  gains.lead = 2.5e-3;  // half a period, and what motors are late [s]
  gains.delay = 1e-3;   // of the sensors [s]
  gains.limits.tension.min_tension = 1.0;
  cdcr::ComputedTorque controller(model, gains);
  const Eigen::Vector2d center(0.0, 0.0), x(0.3, 0.0), y(0.0, 0.3);
  controller.set_path(cdcr::ReferencePath::circle(center, x, y, 1.0, 4.0));

  cdcr::LoopOptions how;
  how.actuators.resize(1);
  how.actuators[0].time_constant = 2e-3;
  how.sensors.resize(1);
  how.sensors[0].kind = cdcr::Sensor::Kind::coordinates;
  how.sensors[0].noise = 2e-4;
  how.sensors[0].delay = 1e-3;

  cdcr::Loop loop(model, controller, how);  // set up may allocate and throw
  cdcr::Data data(model);
  cdcr::VectorXd hold(2);
  cdcr::potential_gradient(model, data, x, hold);
  const cdcr::VectorXd tension = cdcr::allocate(model, hold, gains.limits.tension).tension;
  loop.reset(x, Eigen::Vector2d(0.0, 0.0), 0.0, tension);  // the motors hold it at first

  cdcr::LoopLog log(loop);  // each step, for a thread that writes it to a file
  cdcr::LogWriter writer(log, "closed_loop.mcap");
  loop.set_log(&log);
  double worst = 0.0;
  for (int k = 0; k < 4000; ++k) {  // the loop neither allocates nor throws
    const Eigen::Vector2d error = loop.q() - controller.setpoint().value;
    if (k > 0) worst = std::fmax(worst, error.norm());
    if (loop.step() != cdcr::Status::ok) {
      std::fprintf(stderr, "%s\n", cdcr::message(loop.status()));
      return 1;
    }
  }
  writer.close();
  std::printf("largest error on the circle: %.2f mrad\n", 1e3 * worst);
  std::printf("rows that found no room in the log: %ld\n", log.dropped());
  return 0;
}
