#pragma once

#include "cdcr/pid.hpp"

// A robot and gains for the tests of the PID loop, alone and in runs.

namespace cdcr::test {

inline const Eigen::Vector2d q_start(0.3, -0.2), qd_start(0.5, 1.0);

/// Table 1, upright, so damped that it comes to rest within a second or two.
inline Robot heavily_damped() {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  robot.sections[0].damping = 0.1;
  return robot;
}

inline PidOptions gains(double kp, double ki = 0.0, double kd = 0.0, double period = 1e-2) {
  PidOptions options;
  options.kp = kp;
  options.ki = ki;
  options.kd = kd;
  options.period = period;
  return options;
}

}  // namespace cdcr::test
