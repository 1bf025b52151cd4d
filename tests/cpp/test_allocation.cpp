// Tensions for a generalised force, against trying every set of cables at their limits.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "cdcr/allocation.hpp"
#include "cdcr/dynamics.hpp"
#include "support/active_sets.hpp"
#include "support/allocations.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

namespace tolerance {
/// Distance to the force and tensions of the closed form: a handful of operations.
constexpr double closed = 1e-14;
/// The same of the search, with cables a hundredth of a radian or more off one line.
constexpr double distance = 1e-12;
constexpr double norm = 1e-9;
/// Tensions of the search where cables are spread evenly.
constexpr double search = 1e-12;
}  // namespace tolerance

Model model_of(std::vector<double> cable_angles) {
  Robot robot = amouri2020();
  robot.sections[0].cable_angles = std::move(cable_angles);
  return Model(robot);
}

Model evenly_spread(int num_cables) {
  std::vector<double> angles;
  for (int j = 0; j < num_cables; ++j) angles.push_back(2.0 * pi * j / num_cables);
  return model_of(angles);
}

void check_against_all(const Model& model, const VectorXd& force, const TensionLimits& limits) {
  CAPTURE(model.actuation_matrix());
  CAPTURE(force.transpose());
  CAPTURE(limits.min_tension);
  CAPTURE(limits.max_tension);
  const Allocation answer = allocate(model, force, limits);
  const Best best = best_of_all(model, force, limits);
  const double size = force_size(model, force, answer.tension);
  CAPTURE(answer.tension.transpose());
  CHECK(residual(answer.distance, best.distance, size) <= tolerance::distance);
  CHECK(residual(answer.force, model.actuation_matrix() * answer.tension, size) <=
        tolerance::closed);
  CHECK(answer.distance == (answer.force - force).stableNorm());
  if (answer.feasible) {
    CHECK(residual(answer.tension.norm(), best.norm, 1.0 + best.norm) <= tolerance::norm);
    CHECK(answer.limiting.empty());
  } else {
    // Not nearer than the rounding that counts as met.
    CHECK(best.distance > 1e-13 * size);
    for (const Index cable : answer.limiting) {
      const double F = answer.tension[cable];
      CHECK((F == limits.min_tension || F == limits.max_tension));
    }
  }
  for (Index j = 0; j < model.num_cables(); ++j) {
    const bool used = limits.cables.empty() || std::find(limits.cables.begin(), limits.cables.end(),
                                                         j) != limits.cables.end();
    const double F = answer.tension[j];
    if (used) CHECK((F >= limits.min_tension && F <= limits.max_tension));
    if (!used) CHECK(F == 0.0);
  }
}

/// No two of them nearly in line, where a force across takes tensions without measure.
std::vector<double> random_angles(int count, Random& random) {
  std::vector<double> angles;
  while (static_cast<int>(angles.size()) < count) {
    const double angle = random.uniform(-pi, pi);
    const auto in_line = [&](double other) { return std::abs(std::sin(angle - other)) < 0.01; };
    if (std::none_of(angles.begin(), angles.end(), in_line)) angles.push_back(angle);
  }
  return angles;
}

TensionLimits random_limits(Random& random) {
  TensionLimits limits;
  const int kind = random.integer(0, 5);
  if (kind == 1) limits.min_tension = random.uniform(0.0, 3.0);
  if (kind == 2) limits.min_tension = -random.uniform(0.0, 3.0);
  if (kind == 3) limits.min_tension = -inf;
  if (random.integer(0, 2) > 0) {
    const double low = std::isfinite(limits.min_tension) ? limits.min_tension : 0.0;
    limits.max_tension = std::max(low, 0.0) + random.uniform(0.0, 10.0);
  }
  return limits;
}

TEST_SUITE_BEGIN("allocation");

TEST_CASE("is as near and as small as the best of all active sets") {
  Random random;
  INFO(random);
  for (int round = 0; round < 25 * test_count(); ++round) {
    const int count = random.integer(1, 6);
    const Model model = model_of(random_angles(count, random));
    const double radius = model.robot().sections[0].cable_radius;
    TensionLimits limits = random_limits(random);
    if (random.integer(0, 3) == 0) {
      for (Index j = 0; j < count; ++j) {
        if (random.integer(0, 1) == 1) limits.cables.push_back(j);
      }
    }
    check_against_all(model, random.vector(2, radius * random.logarithmic(0.1, 30.0)), limits);
  }
}

TEST_CASE("ties and cables in line are no obstacle") {
  Random random;
  INFO(random);
  const std::vector<std::vector<double>> arrangements = {
      {0.3},
      {0.3, 0.3},
      {0.3, 0.3 + pi},
      {0.0, 0.0, 0.0},
      {0.0, pi / 2.0, pi, -pi / 2.0},
      {0.0, 0.0, 2.0, 2.0, 4.0, 4.0},
      {0.0, pi / 3.0, 2.0 * pi / 3.0, pi, 4.0 * pi / 3.0, 5.0 * pi / 3.0}};
  for (const auto& angles : arrangements) {
    const Model model = model_of(angles);
    const double radius = model.robot().sections[0].cable_radius;
    for (const TensionLimits& limits :
         {TensionLimits{}, TensionLimits{0.5, 4.0, {}}, TensionLimits{-1.0, 2.0, {}},
          TensionLimits{2.0, 2.0, {}}, TensionLimits{-inf, inf, {}}}) {
      check_against_all(model, VectorXd::Zero(2), limits);
      for (int step = 0; step < 12; ++step) {
        // Along the cables and half way between them.
        const double phi = 0.3 * (step % 2) + pi / 6.0 * step;
        check_against_all(model, 3.0 * radius * Eigen::Vector2d(std::cos(phi), std::sin(phi)),
                          limits);
      }
    }
    check_against_all(model, random.vector(2, radius), {});
  }
}

TEST_CASE("cables almost against each other: what little they give across is not left out") {
  for (const double off : {1e-2, 1e-3, 1e-4, 1e-5}) {
    CAPTURE(off);
    const Model model = model_of({0.3, 0.3 + pi - off});
    for (const Eigen::Vector2d& tension :
         {Eigen::Vector2d(30.0, 0.3), Eigen::Vector2d(0.3, 30.0), Eigen::Vector2d(5.0, 5.0)}) {
      const VectorXd force = model.actuation_matrix() * tension;
      const Allocation answer = allocate(model, force);
      CHECK(answer.feasible);
      // The angle between the two multiplies the rounding of a force.
      CHECK(residual(answer.tension, tension, 30.0 / off) <= tolerance::search);
    }
  }
}

TEST_CASE("three cables: slack where least needed, the others share the force") {
  const Model model(amouri2020());
  const MatrixXd& B = model.actuation_matrix();
  const double radius = model.robot().sections[0].cable_radius;
  for (int degrees = -180; degrees < 180; degrees += 5) {
    CAPTURE(degrees);
    const double phi = degrees * pi / 180.0, magnitude = 0.1;
    const VectorXd force = magnitude * Eigen::Vector2d(std::cos(phi), std::sin(phi));
    Vector3d expected;
    for (int j = 0; j < 3; ++j) {
      expected[j] = 2.0 / (3.0 * radius) * magnitude * std::cos(phi - 2.0 * pi / 3.0 * j);
    }
    const VectorXd push_pull = expected;
    for (const double pretension : {0.0, 1.5}) {
      const Allocation answer = allocate(model, force, {pretension, inf, {}});
      const VectorXd raised = (expected.array() + (pretension - expected.minCoeff())).matrix();
      CHECK(answer.feasible);
      CHECK(residual(answer.tension, raised) <= tolerance::closed);
      CHECK(residual(answer.tension.minCoeff(), pretension, raised.norm()) <= tolerance::closed);
      CHECK(residual(B * answer.tension, force) <= 10.0 * tolerance::closed);
    }
    // An ideal actuator needs no pretension.
    CHECK(residual(allocate(model, force, {-inf, inf, {}}).tension, push_pull) <=
          tolerance::closed);
  }
}

TEST_CASE("the closed form of three cables and the search agree for all directions") {
  const Model model(amouri2020());
  const std::vector<Index> all = {0, 1, 2};  // named, so that the search is taken
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{
           {0.0, inf}, {0.0, 6.0}, {1.0, 6.0}, {-1.0, 5.0}, {-inf, inf}, {2.0, 3.0}}) {
    for (int degrees = -180; degrees < 180; degrees += 3) {
      CAPTURE(degrees);
      const double phi = degrees * pi / 180.0;
      const VectorXd force = 0.1 * Eigen::Vector2d(std::cos(phi), std::sin(phi));
      const Allocation closed = allocate(model, force, {low, high, {}});
      const Allocation searched = allocate(model, force, {low, high, all});
      CHECK(closed.feasible == searched.feasible);
      CHECK(residual(searched.tension, closed.tension) <= tolerance::search);
      CHECK(closed.limiting == searched.limiting);
    }
  }
}

TEST_CASE("out of reach, it names the cables at their limits") {
  const Model model(amouri2020());
  const double radius = model.robot().sections[0].cable_radius;
  const Allocation answer = allocate(model, radius * Eigen::Vector2d(10.0, 0.0), {0.0, 4.0, {}});
  CHECK_FALSE(answer.feasible);
  CHECK(answer.tension == Eigen::Vector3d(4.0, 0.0, 0.0));
  CHECK(answer.limiting == std::vector<Index>{0, 1, 2});
  CHECK(residual(answer.distance, 6.0 * radius) <= tolerance::closed);

  // Forces whose squares overflow.
  const Allocation large = allocate(model, Eigen::Vector2d(1e300, 1e300), {});
  CHECK(large.feasible);
  CHECK(large.distance <= tolerance::closed * 1e300);
  // A force that asks for more than the largest double.
  const double most = std::numeric_limits<double>::max();
  const Allocation beyond = allocate(model, Eigen::Vector2d(-most, -1.0), {});
  CHECK(!beyond.feasible);
  CHECK(beyond.tension.allFinite());

  // One cable free: cables 0 and 1 pull alike, and only cable 0 may.
  const Allocation alone = allocate(model, radius * Eigen::Vector2d(1.0, 1.0), {0.0, 4.0, {0}});
  CHECK_FALSE(alone.feasible);
  CHECK(residual(alone.tension, Eigen::Vector3d(1.0, 0.0, 0.0)) <= tolerance::search);
  CHECK(alone.limiting.empty());
}

TEST_CASE("limits that leave one choice are kept") {
  const Model model(amouri2020());
  const Allocation answer = allocate(model, VectorXd::Zero(2), {2.0, 2.0, {}});
  CHECK(answer.tension == Eigen::Vector3d(2.0, 2.0, 2.0));
  CHECK(answer.feasible);
}

TEST_CASE("at_limit tells which cables stand at a limit") {
  const Model model(amouri2020());
  Allocator allocator(model, {0.5, 4.0, {}});
  const double radius = model.robot().sections[0].cable_radius;
  REQUIRE(allocator.solve(radius * Eigen::Vector2d(1.0, 0.2)));
  const VectorXd& F = allocator.tension();
  for (Index j = 0; j < 3; ++j) CHECK(allocator.at_limit(j) == (F[j] == 0.5 || F[j] == 4.0));
  CHECK(allocator.at_limit(2));
  Allocator some(model, {0.0, 4.0, {0}});
  CHECK_FALSE(some.solve(radius * Eigen::Vector2d(-1.0, 0.2)));
  CHECK(some.at_limit(0));
  CHECK_FALSE(some.at_limit(1));  // not in use
}

TEST_CASE("a solution does not depend on the one before") {
  Random random;
  INFO(random);
  for (const int count : {3, 5}) {
    const Model model = evenly_spread(count);
    const TensionLimits limits{0.2, 3.0, {}};
    Allocator allocator(model, limits);
    for (int round = 0; round < 50; ++round) {
      const VectorXd force = random.vector(2, 0.1);
      (void)allocator.solve(force);
      CHECK(allocator.tension() == allocate(model, force, limits).tension);
    }
  }
}

TEST_CASE("a robot without cables gives no force") {
  const Model model = model_of({});
  const Allocation nothing = allocate(model, VectorXd::Zero(2));
  CHECK(nothing.feasible);
  CHECK(nothing.tension.size() == 0);
  const Allocation something = allocate(model, Eigen::Vector2d(0.3, 0.4));
  CHECK_FALSE(something.feasible);
  CHECK(something.force == VectorXd::Zero(2));
  CHECK(something.distance == 0.5);
  CHECK(something.limiting.empty());
}

TEST_CASE("bad limits, cables and forces are refused") {
  const Model model(amouri2020());
  const VectorXd force = VectorXd::Zero(2);
  CHECK_THROWS_SENTENCE(allocate(model, force, {2.0, 1.0, {}}),
                        "tension limits must satisfy min_tension <= max_tension, got min_tension "
                        "2 N and max_tension 1 N");
  CHECK_THROWS_SENTENCE(allocate(model, force, {NAN, 1.0, {}}),
                        "tension limits must satisfy min_tension <= max_tension, got min_tension "
                        "nan N and max_tension 1 N");
  CHECK_THROWS_SENTENCE(allocate(model, force, {0.0, NAN, {}}),
                        "tension limits must satisfy min_tension <= max_tension, got min_tension "
                        "0 N and max_tension nan N");
  CHECK_THROWS_SENTENCE(allocate(model, force, {inf, inf, {}}),
                        "tension limits must satisfy min_tension <= max_tension, got min_tension "
                        "inf N and max_tension inf N");
  CHECK_THROWS_SENTENCE(Allocator(model, {0.0, 1.0, {0, 3}}),
                        "cables must be indices from 0 to 2, got 3");
  CHECK_THROWS_SENTENCE(Allocator(model, {0.0, 1.0, {-1}}),
                        "cables must be indices from 0 to 2, got -1");
  CHECK_THROWS_SENTENCE(allocate(model, Vector3d(1.0, 2.0, 3.0)),
                        "force must be 2 finite values, got [1 2 3]");
  CHECK_THROWS_SENTENCE(allocate(model, Eigen::Vector2d(1.0, NAN)),
                        "force must be 2 finite values, got [  1 nan]");
}

TEST_CASE("solving neither allocates nor throws, whatever the cables") {
  static_assert(noexcept(std::declval<Allocator&>().solve(std::declval<const ConstVectorRef&>())));
  static_assert(noexcept(std::declval<Allocator&>().at_limit(0)));
  Random random;
  INFO(random);
  for (const int count : {0, 1, 2, 3, 4, 6, 16}) {
    CAPTURE(count);
    const Model model = evenly_spread(count);
    for (const TensionLimits& limits : {TensionLimits{}, TensionLimits{0.5, 2.0, {}}}) {
      Allocator allocator(model, limits);
      for (int round = 0; round < 20; ++round) {
        const VectorXd force = random.vector(2, 0.2);
        CHECK(allocations_of([&] { (void)allocator.solve(force); }) == 0);
      }
    }
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
