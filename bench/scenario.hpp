#pragma once

#include <vector>

#include "cdcr/cdcr.hpp"

namespace cdcr::bench {

inline constexpr double quarter_pi = 0.78539816339744831;

/// A point of a run.
struct State {
  VectorXd q, qd;
};

/// Table 1, with gravity as if the base were tilted by 30 degrees, so that no term vanishes.
inline Robot robot(bool gravity) {
  Robot robot = amouri2020();
  if (gravity) robot.gravity = {4.905, 0.0, -8.496};
  return robot;
}

/// The start of every run here: bent by pi/4 towards phi = 0, at rest.
inline State bent() {
  return {bending(quarter_pi, 0.0), VectorXd::Zero(2)};
}

/// States of a spatial swing of 10 s, each another point of it. Their number divides 1024.
inline std::vector<State> swing(const Model& model) {
  constexpr Index num_states = 64;
  const VectorXd times = VectorXd::LinSpaced(num_states, 0.0, 10.0);
  const VectorXd rate = bending(2.0, 2.0);
  const Trajectory run = simulate(model, bent().q, rate, times,
                                  TensionInput::constant(VectorXd::Zero(model.num_cables())));
  std::vector<State> states;
  for (Index i = 0; i < num_states; ++i) {
    states.push_back({run.q.row(i).transpose(), run.qd.row(i).transpose()});
  }
  return states;
}

}  // namespace cdcr::bench
