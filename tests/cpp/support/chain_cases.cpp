#include "chain_cases.hpp"

#include <cmath>

namespace cdcr::test {
namespace {

VectorXd random_tension(const Model& model, Random& random) {
  VectorXd tension(model.num_cables());
  for (Index j = 0; j < tension.size(); ++j) {
    const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
    tension[j] = random.uniform(0.0, 1.0) * model.stiffness()[cable.end_section] / cable.radius;
  }
  return tension;
}

}  // namespace

VectorXd random_bending(Index num_sections, double max_theta, Random& random) {
  VectorXd q(2 * num_sections);
  for (Index i = 0; i < num_sections; ++i) {
    const double theta = random.uniform(0.0, max_theta), phi = random.uniform(-pi, pi);
    q.segment(2 * i, 2) << theta * std::cos(phi), theta * std::sin(phi);
  }
  return q;
}

std::vector<ChainState> chain_states(const Model& model, Random& random) {
  const Index n = model.num_sections();
  std::vector<ChainState> states;
  const auto add = [&](const std::string& name, const VectorXd& q) {
    states.push_back({name, q, random.vector(2 * n, 10.0), random_tension(model, random)});
  };
  add("straight", VectorXd::Zero(2 * n));
  add("nearly straight", random_bending(n, 1e-8, random));
  VectorXd mixed = random_bending(n, 2.5, random);
  for (Index i = 0; i < n; ++i) {
    const double factors[] = {1.0, 0.0, 1e-9, 1e-4};
    mixed.segment(2 * i, 2) *= factors[random.integer(0, 3)];
  }
  add("mixed", mixed);
  add("bent", random_bending(n, 2.5, random));
  add("bent up to a full turn", random_bending(n, 2.0 * pi, random));
  return states;
}

Wrenches random_wrenches(const Model& model, int count, Random& random) {
  Wrenches wrenches;
  for (int k = 0; k < count; ++k) {
    Wrench wrench;
    wrench.section = random.integer(0, static_cast<int>(model.num_sections()) - 1);
    wrench.fraction = random.uniform(0.0, 1.0);
    const double moment = model.stiffness()[wrench.section];
    const auto section = static_cast<std::size_t>(wrench.section);
    wrench.force = random.vector(3, moment / model.robot().sections[section].length);
    wrench.moment = random.vector(3, moment);
    wrench.frame = k % 2 == 0 ? Wrench::Frame::base : Wrench::Frame::local;
    wrenches.push_back(wrench);
  }
  return wrenches;
}

RealVector bias_scale(const Model& model, const ChainSum& sum, const RealMatrix& M,
                      const ChainState& state) {
  const RealVector q = state.q.cast<Real>(), qd = state.qd.cast<Real>();
  Real turning = 0.0L;
  for (Index i = 0; i < model.num_sections(); ++i) turning += qd.segment(2 * i, 2).norm();
  const Real inertial = std::sqrt(qd.dot(M * qd)) * turning;
  RealVector scale = sum.weight_scale() + inertial * M.diagonal().cwiseSqrt();
  for (Index i = 0; i < model.num_sections(); ++i) {
    const Real elastic = model.stiffness()[i] * q.segment(2 * i, 2).norm();
    const Real damped = model.damping()[i] * qd.segment(2 * i, 2).norm();
    scale.segment(2 * i, 2).array() += elastic + damped;
  }
  return scale;
}

}  // namespace cdcr::test
