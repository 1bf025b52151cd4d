// Derivatives by parameters and of runs in C++: what is exact, allocations, refusals. Numbers are
// compared in tests/python/test_parameter_derivatives.py and test_sensitivities.py.
#include <doctest/doctest.h>

#include <cmath>

#include "cdcr/dynamics.hpp"
#include "cdcr/sensitivities.hpp"
#include "integration/collocation.hpp"
#include "support/allocations.hpp"

namespace cdcr::test {
namespace {

Parameter of_section(const Robot& robot, const char* name, double Section::* field) {
  const auto robot_at = [robot, field](double value) {
    Robot other = robot;
    other.sections[0].*field = value;
    return other;
  };
  return {name, robot.sections[0].*field, robot_at};
}

}  // namespace

TEST_SUITE_BEGIN("parameters");

TEST_CASE("polynomials of second degree are told from what is none") {
  const Robot robot = amouri2020();
  const Model model(robot);
  const ParameterSet set(model, {of_section(robot, "modulus", &Section::youngs_modulus),
                                 of_section(robot, "disk", &Section::disk_diameter),
                                 of_section(robot, "length", &Section::length),
                                 of_section(robot, "diameter", &Section::backbone_diameter)});
  CHECK(set.size() == 4);
  CHECK(set.is_exact(0));
  CHECK(set.is_exact(1));
  CHECK_FALSE(set.is_exact(2));
  CHECK_FALSE(set.is_exact(3));
}

TEST_CASE("parameter_derivatives allocates nothing, and scales as the force does") {
  Robot robot = amouri2020();
  robot.sections.push_back(robot.sections[0]);
  const Model model(robot);
  Data data(model);
  const ParameterSet set(model, {of_section(robot, "radius", &Section::cable_radius),
                                 of_section(robot, "length", &Section::length)});
  ParameterData room(model);
  const VectorXd q = VectorXd::Constant(4, 0.3), qd = VectorXd::Constant(4, -0.7);
  const VectorXd command = VectorXd::LinSpaced(6, 0.5, 3.0);
  MatrixXd slopes(4, 2);
  const auto differentiate = [&] {
    parameter_derivatives(model, data, set, room, q, qd, command, no_wrenches(), slopes);
  };
  CHECK(allocations_of(differentiate) == 0);
  // The force of the first section's cables is as their radius.
  VectorXd with(4), without(4), others = command;
  others.head(3).setZero();
  forward_dynamics(model, data, q, qd, command, with);
  forward_dynamics(model, data, q, qd, others, without);
  const VectorXd change = (with - without) / robot.sections[0].cable_radius;
  CHECK((slopes.col(0) - change).norm() < 1e-10 * change.norm());
}

TEST_CASE("a refusal names the parameter") {
  const Robot robot = amouri2020();
  const Model model(robot);
  Parameter broken = of_section(robot, "length", &Section::length);
  broken.robot_at = nullptr;
  CHECK_THROWS_WITH_AS(ParameterSet(model, {broken}),
                       "parameter length: no function of it is given", std::invalid_argument);
}

TEST_CASE("Radau IIA integrates polynomials to its order") {
  for (int stages = 2; stages <= 5; ++stages) {
    const detail::Collocation method = detail::Collocation::radau(stages);
    for (int k = 0; k <= 2 * stages - 2; ++k) {
      double sum = 0.0;
      for (int j = 0; j < stages; ++j) {
        sum += method.once(stages - 1, j) * std::pow(method.nodes[j], k);
      }
      CHECK(std::abs(sum - 1.0 / (k + 1)) < 1e-14);
      if (k > stages - 3) continue;  // that both estimates of the error leave out
      CHECK((method.error * method.nodes.array().pow(k).matrix()).cwiseAbs().maxCoeff() < 1e-13);
    }
  }
}

TEST_CASE("a start of another shape is refused") {
  const Model model(amouri2020());
  Sensitivities asked;
  asked.q0 = true;
  asked.start = MatrixXd::Zero(4, 3);
  const VectorXd still = VectorXd::Zero(2), times = VectorXd::LinSpaced(2, 0.0, 0.1);
  const CommandInput pull = CommandInput::constant(VectorXd::Zero(3));
  CHECK_THROWS_WITH_AS(simulate(model, still, still, times, pull, asked),
                       "sensitivities at the start must be of shape (4, 2), got (4, 3)",
                       std::invalid_argument);
}

TEST_SUITE_END();

}  // namespace cdcr::test
