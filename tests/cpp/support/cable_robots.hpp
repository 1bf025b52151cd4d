#pragma once

#include <cmath>

#include "cases.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/kinematics.hpp"
#include "chain_cases.hpp"
#include "split.hpp"

// Robots whose cables rub or are driven by length, their states, and what their cables do.

namespace cdcr::test {

inline VectorXd cable_force_of(const Model& model, const VectorXd& q, const VectorXd& qd,
                               const VectorXd& command) {
  VectorXd force(model.num_coordinates());
  cable_force(model, q, qd, command, force);
  return force;
}

inline VectorXd tensions_of(const Model& model, const VectorXd& q, const VectorXd& qd,
                            const VectorXd& command) {
  VectorXd tension(model.num_cables());
  cable_tensions(model, q, qd, command, tension);
  return tension;
}

inline MatrixXd tensions_along_of(const Model& model, const VectorXd& q, const VectorXd& qd,
                                  const VectorXd& command) {
  MatrixXd tension(model.num_sections() + 1, model.num_cables());
  tensions_along(model, q, qd, command, tension);
  return tension;
}

inline VectorXd lengths_of(const Model& model, const VectorXd& q) {
  VectorXd lengths(model.num_cables());
  cable_lengths(model, q, lengths);
  return lengths;
}

inline VectorXd rest_command_of(const Model& model) {
  VectorXd command(model.num_cables());
  rest_command(model, command);
  return command;
}

/// A random chain with four cables or more that end anywhere; they rub, each section with its own
/// coefficient up to 0.5 and some cables with another, and every third is driven by length.
inline Robot rubbing_chain(Random& random, int n) {
  Robot robot = random_chain(random, n);
  robot.sliding_speed = random.logarithmic(1e-5, 1e-1);
  const double radius = 0.3 * robot.sections[0].disk_diameter;
  for (int j = 0; j < 4; ++j) {
    robot.cables.push_back(
        {radius, random.uniform(-pi, pi), random.integer(0, n - 1), 0.0, 0.0, std::nullopt});
  }
  for (Section& section : robot.sections) section.cable_friction = random.uniform(0.0, 0.5);
  for (std::size_t j = 0; j < robot.cables.size(); ++j) {
    Cable& cable = robot.cables[j];
    if (j % 2 == 0) cable.friction = random.uniform(0.0, 0.5);
    if (j % 3 == 0) cable.stiffness = random.logarithmic(1e2, 1e5);
    if (j % 3 == 0) cable.damping = random.logarithmic(1e-2, 1e2);
  }
  return robot;
}

/// Sections bent up to a full turn, now and then one of them straight.
inline VectorXd random_shape(const Model& model, Random& random) {
  const auto n = static_cast<int>(model.num_sections());
  VectorXd q = random_bending(n, random.logarithmic(1e-3, 2.0 * pi), random);
  if (random.integer(0, 4) == 0) q.segment(2 * random.integer(0, n - 1), 2).setZero();
  return q;
}

/// Tensions up to `most` [N]; for cables driven by length, lengths that pull about so much or are
/// slack.
inline VectorXd random_command(const Model& model, const VectorXd& q, double most, Random& random) {
  VectorXd command = lengths_of(model, q);
  for (Index j = 0; j < command.size(); ++j) {
    const Cable& cable = model.cables()[static_cast<std::size_t>(j)];
    command[j] = cable.length_driven()
                     ? command[j] + random.uniform(-1.0, 0.3) * most / cable.stiffness
                     : random.uniform(0.0, most);
  }
  return command;
}

/// Table 1 cut into parts, with three cables that end on each; driven by length when stiff.
inline Robot parts_with_cables(int parts, double stiffness, double damping) {
  Robot robot = split(amouri2020(), parts);
  for (std::size_t i = 0; i < robot.sections.size(); ++i) {
    Section& section = robot.sections[i];
    const double turn = static_cast<double>(i) * pi / 5.0;
    section.cable_angles = {turn, turn + 2.0 * pi / 3.0, turn + 4.0 * pi / 3.0};
    section.cable_stiffness = stiffness;
    section.cable_damping = damping;
  }
  return robot;
}

}  // namespace cdcr::test
