// Wrenches against their virtual work, and what is said about wrong ones.
#include <doctest/doctest.h>

#include <functional>
#include <limits>

#include "cdcr/kinematics.hpp"
#include "cdcr/wrench.hpp"
#include "support/chain_cases.hpp"
#include "support/residual.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

// A product of the Jacobian, one rounding for each section on the way, with six numbers.
constexpr double work_tolerance = 4e-15;

/// Moments as large as any: the force at the end of a stretched robot, and the moment itself.
double moment_scale(const Model& model, const Wrench& wrench) {
  double reach = 0.0;
  for (const Section& section : model.robot().sections) reach += section.length;
  return wrench.force.norm() * reach + wrench.moment.norm();
}

VectorXd force_of(const Model& model, const VectorXd& q, const Wrenches& wrenches) {
  VectorXd force = VectorXd::Zero(model.num_coordinates());
  add_wrench_force(model, q, wrenches, force);
  return force;
}

/// body(model, state) for random robots of 1 to 8 sections in sample states.
template <class Body>
void for_each_chain(Random& random, Body body) {
  for (int n = 1; n <= 8; ++n) {
    const Model model(random_chain(random, n));
    for (const ChainState& state : chain_states(model, random)) {
      INFO(random, ", sections: ", n, ", state: ", state.name);
      body(model, state);
    }
  }
}

TEST_SUITE_BEGIN("wrench");

TEST_CASE("the generalised force of a wrench is its virtual work") {
  Random random;
  for_each_chain(random, [&](const Model& model, const ChainState& state) {
    const ChainSum sum(model.robot());
    for (Wrench wrench : random_wrenches(model, 4, random)) {
      for (const double fraction : {0.0, wrench.fraction, 1.0}) {
        wrench.fraction = fraction;
        const RealVector expected = sum.wrench_force(state.q.cast<Real>(), wrench);
        CHECK(residual(force_of(model, state.q, {wrench}), expected, moment_scale(model, wrench)) <=
              work_tolerance);
      }
    }
  });
}

TEST_CASE("several wrenches add up, on top of what is there") {
  Random random;
  for_each_chain(random, [&](const Model& model, const ChainState& state) {
    const Wrenches wrenches = random_wrenches(model, 5, random);
    VectorXd force = VectorXd::Ones(model.num_coordinates()), expected = force;
    double scale = 1.0;
    for (const Wrench& wrench : wrenches) {
      expected += force_of(model, state.q, {wrench});
      scale += moment_scale(model, wrench);
    }
    add_wrench_force(model, state.q, wrenches, force);
    CHECK(residual(force, expected, scale) <= work_tolerance);
    add_wrench_force(model, state.q, {}, force);
    CHECK(residual(force, expected, scale) <= work_tolerance);
  });
}

TEST_CASE("a local wrench is the one that is turned with the backbone") {
  Random random;
  for_each_chain(random, [&](const Model& model, const ChainState& state) {
    Wrench local = random_wrenches(model, 1, random)[0];
    local.frame = Wrench::Frame::local;
    const Matrix3d R = pose(model, state.q, local.section, local.fraction).R;
    Wrench turned = local;
    turned.frame = Wrench::Frame::base;
    turned.force = R * local.force;
    turned.moment = R * local.moment;
    CHECK(residual(force_of(model, state.q, {local}), force_of(model, state.q, {turned}),
                   moment_scale(model, local)) <= work_tolerance);
  });
}

TEST_CASE("a wrench bends nothing beyond the point where it acts") {
  Random random;
  for_each_chain(random, [&](const Model& model, const ChainState& state) {
    for (const Wrench& wrench : random_wrenches(model, 4, random)) {
      const VectorXd force = force_of(model, state.q, {wrench});
      const Index beyond = model.num_coordinates() - 2 * (wrench.section + 1);
      CHECK(force.tail(beyond) == VectorXd::Zero(beyond));
    }
  });
}

TEST_CASE("a force across the straight robot at its tip bends each section by its arm") {
  // Force F along X at the tip: the moment of section i is F times the distance of its middle.
  Robot robot = amouri2020();
  robot.sections = {3, robot.sections[0]};
  const Model model(robot);
  Wrench wrench;
  wrench.section = 2;
  wrench.force = {2.0, 0.0, 0.0};
  const double l = robot.sections[0].length;
  VectorXd expected(6);
  expected << 2.0 * 2.5 * l, 0.0, 2.0 * 1.5 * l, 0.0, 2.0 * 0.5 * l, 0.0;
  CHECK(residual(force_of(model, VectorXd::Zero(6), {wrench}), expected) <= work_tolerance);
  // A moment about Y bends all sections towards X alike.
  wrench.force.setZero();
  wrench.moment = {0.0, 0.7, 0.0};
  expected << 0.7, 0.0, 0.7, 0.0, 0.7, 0.0;
  CHECK(residual(force_of(model, VectorXd::Zero(6), {wrench}), expected) <= work_tolerance);
}

TEST_CASE("a wrong wrench gets a sentence that names it") {
  Robot robot = amouri2020();
  robot.sections = {3, robot.sections[0]};
  const Model model(robot);
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto changed = [](const std::function<void(Wrench&)>& change) {
    Wrenches wrenches(2);
    change(wrenches[1]);
    return wrenches;
  };
  validate(model, changed([](Wrench& wrench) { wrench.section = 2; }));
  validate(model, {});
  CHECK_THROWS_SENTENCE(validate(model, changed([](Wrench& wrench) { wrench.section = 3; })),
                        "wrenches[1].section must be 0 to 2, got 3");
  CHECK_THROWS_SENTENCE(validate(model, changed([](Wrench& wrench) { wrench.section = -1; })),
                        "wrenches[1].section must be 0 to 2, got -1");
  CHECK_THROWS_SENTENCE(validate(model, changed([](Wrench& wrench) { wrench.fraction = 1.5; })),
                        "wrenches[1].fraction must be 0 to 1, got 1.5");
  CHECK_THROWS_SENTENCE(validate(model, changed([](Wrench& wrench) { wrench.fraction = -0.25; })),
                        "wrenches[1].fraction must be 0 to 1, got -0.25");
  CHECK_THROWS_SENTENCE(validate(model, changed([](Wrench& wrench) { wrench.fraction = nan; })),
                        "wrenches[1].fraction must be 0 to 1, got nan");
  CHECK_THROWS_SENTENCE(
      validate(model, changed([](Wrench& wrench) { wrench.force = {1.0, nan, 0.0}; })),
      "wrenches[1].force must be three finite numbers of N, got [  1 nan   0]");
  CHECK_THROWS_SENTENCE(
      validate(model, changed([](Wrench& wrench) { wrench.moment = {0.0, 2.0, infinity}; })),
      "wrenches[1].moment must be three finite numbers of N m, got [  0   2 inf]");
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
