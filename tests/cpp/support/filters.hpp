#pragma once

#include "cdcr/cdcr.hpp"

namespace cdcr::test {

inline Model heavier(const Robot& robot) {
  Robot changed = robot;
  changed.payload += 0.05;
  return Model(changed);
}

inline Model stiffer(const Robot& robot) {
  Robot changed = robot;
  for (Section& section : changed.sections) section.youngs_modulus *= 1.5;
  return Model(changed);
}

inline KalmanOptions of_lengths(double noise) {
  KalmanOptions options;
  options.sensors.resize(1);
  options.sensors[0].kind = Sensor::Kind::lengths;
  options.sensors[0].noise = noise;
  options.acceleration_noise[0] = 0.1;
  return options;
}

}  // namespace cdcr::test
