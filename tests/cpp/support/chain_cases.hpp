#pragma once

#include <string>
#include <vector>

#include "cases.hpp"
#include "cdcr/wrench.hpp"
#include "chain_sum.hpp"

// States and loads of robots of several sections, and the natural size of what they feel.

namespace cdcr::test {

struct ChainState {
  std::string name;
  VectorXd q, qd, tension;
};

/// Exactly straight, nearly straight, a mixture of these with bent sections, bent up to 2.5 rad,
/// and bent up to 2 pi; rates up to 10 rad/s, tensions that bend a section by about 1 rad.
std::vector<ChainState> chain_states(const Model& model, Random& random);

/// A bending vector of every section, theta up to max_theta, in random directions.
VectorXd random_bending(Index num_sections, double max_theta, Random& random);

/// Wrenches anywhere on the robot, in both frames, of the size of weight and stiffness.
Wrenches random_wrenches(const Model& model, int count, Random& random);

/// Size of each coordinate's terms in h(q, qd) (d): weight, elastic, damping and inertial forces.
/// An inertial force is about sqrt(M_ii) times the root of twice the energy times the turning rate.
RealVector bias_scale(const Model& model, const ChainSum& sum, const RealMatrix& M,
                      const ChainState& state);

/// body(model, data, state) for random robots of these numbers of sections in sample states.
template <class Body>
void for_each_chain(const std::vector<int>& numbers, Body body) {
  Random random;
  for (const int n : numbers) {
    const Model model(random_chain(random, n));
    Data data(model);
    for (const ChainState& state : chain_states(model, random)) {
      INFO(random, ", sections: ", n, ", state: ", state.name);
      body(model, data, state);
    }
  }
}

}  // namespace cdcr::test
