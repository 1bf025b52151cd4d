#pragma once

#include <doctest/doctest.h>

#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "cdcr/model.hpp"
#include "settings.hpp"

// Robots and states that the laws are tried on: chosen extremes, then random ones.

namespace cdcr::test {

constexpr double pi = 3.14159265358979323846;

/// Random numbers from CDCR_TEST_SEED; INFO(random) tells the seed of a failure.
class Random {
 public:
  double uniform(double low, double high) { return low + (high - low) * unit_(engine_); }
  /// Evenly spread in the logarithm.
  double logarithmic(double low, double high);
  int integer(int low, int high);
  VectorXd vector(Index size, double magnitude);

  friend std::ostream& operator<<(std::ostream& out, const Random&) {
    return out << "CDCR_TEST_SEED=" << test_seed();
  }

 private:
  std::mt19937_64 engine_{test_seed()};
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

struct NamedRobot {
  std::string name;
  Robot robot;
};

Robot random_robot(Random& random);

/// n sections that differ, disks anywhere, cables that end anywhere, a payload with inertia, any
/// base orientation and gravity; damped or not.
Robot random_chain(Random& random, int n);

/// Table 1 and its extremes, then CDCR_TEST_COUNT random robots; all have inertia.
std::vector<NamedRobot> sample_robots(Random& random);

struct State {
  double theta;
  VectorXd q, qd, tension;
};

/// theta = 0, 1e-9, 1e-4 and random up to max_theta, in random directions.
std::vector<State> sample_states(const Model& model, double max_theta, Random& random);

/// body(model, data, state) for every sample robot in every sample state.
template <class Body>
void for_each_case(double max_theta, Body body) {
  Random random;
  for (const NamedRobot& sample : sample_robots(random)) {
    const Model model(sample.robot);
    Data data(model);
    for (const State& state : sample_states(model, max_theta, random)) {
      INFO(random, ", robot: ", sample.name, ", theta = ", state.theta);
      body(model, data, state);
    }
  }
}

}  // namespace cdcr::test
