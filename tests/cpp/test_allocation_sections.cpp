// Tensions for a generalised force on several sections: closed form, search, names, commands.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "cdcr/allocation.hpp"
#include "cdcr/cables.hpp"
#include "support/allocations.hpp"
#include "support/cases.hpp"
#include "support/chain_cases.hpp"
#include "support/residual.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

/// A few operations on numbers of the size of the tensions.
constexpr double closed = 1e-13;
/// What the search leaves: it meets Q to 1e-10 at worst, a few digits better as a rule.
constexpr double searched = 1e-9;

constexpr double inf = std::numeric_limits<double>::infinity();

/// Three cables end at every section, turned and at another radius from section to section.
Model three_each(int n, double stiffness = 0.0) {
  Robot robot = amouri2020();
  const Section section = robot.sections[0];
  robot.sections.clear();
  for (int k = 0; k < n; ++k) {
    Section next = section;
    next.cable_stiffness = stiffness;
    next.cable_radius = 0.019 - 0.001 * k;
    for (double& angle : next.cable_angles) angle += 0.3 * k;
    next.cable_angles[1] += 0.2;  // not evenly spread
    robot.sections.push_back(next);
  }
  return Model(robot);
}

TensionLimits by(AllocationMethod method, double low, double high) {
  return {low, high, {}, method};
}

TEST_SUITE_BEGIN("allocation_sections");

TEST_CASE("section by section meets the force with the least tensions of all") {
  Random random;
  INFO(random);
  for (int n = 1; n <= 8; ++n) {
    CAPTURE(n);
    const Model model = three_each(n);
    REQUIRE(Allocator(model).has_closed_form());
    int feasible = 0;
    for (const double high : {inf, 30.0}) {
      for (int round = 0; round < 40; ++round) {
        // A force that tensions within 1 to 20 N give, so that it can be met.
        VectorXd given(3 * n);
        for (Index j = 0; j < 3 * n; ++j) given[j] = random.uniform(1.0, 20.0);
        const VectorXd force = model.actuation_matrix() * given;
        const auto sections = allocate(model, force, by(AllocationMethod::sections, 0.5, high));
        const auto search = allocate(model, force, by(AllocationMethod::search, 0.5, high));
        REQUIRE(sections.feasible);
        REQUIRE(search.feasible);
        ++feasible;
        CHECK(residual(VectorXd(model.actuation_matrix() * sections.tension), force,
                       largest(force) + 0.02 * largest(sections.tension)) <= closed);
        CHECK(residual(search.tension, sections.tension) <= searched);
        CHECK(sections.tension.norm() <= given.norm());
        CHECK(sections.tension.minCoeff() >= 0.5);
      }
    }
    CHECK(feasible == 80);
  }
}

TEST_CASE("out of reach of one section, all cables come as near as they can") {
  Random random;
  INFO(random);
  const Model model = three_each(3);
  for (int round = 0; round < 50; ++round) {
    const VectorXd force = random.vector(6, 1.0);
    const auto sections = allocate(model, force, by(AllocationMethod::sections, 0.0, 5.0));
    const auto search = allocate(model, force, by(AllocationMethod::search, 0.0, 5.0));
    CHECK(sections.feasible == search.feasible);
    CHECK(residual(sections.distance, search.distance, force.norm()) <= searched);
    CHECK(sections.feasible == sections.limits.empty());
    CHECK(sections.limits.size() == sections.limiting.size());
  }
}

TEST_CASE("the nearest is nearest: no small change of a tension brings it nearer") {
  Random random;
  INFO(random);
  for (int n = 2; n <= 8; ++n) {
    const Model model(random_chain(random, n));
    const VectorXd force = random.vector(2 * n, 5.0);
    const auto answer = allocate(model, force, {0.2, 3.0, {}});
    const VectorXd missing = force - answer.force;
    for (Index j = 0; j < model.num_cables(); ++j) {
      const VectorXd b = model.actuation_matrix().col(j);
      const double nearer = b.dot(missing);  // by more of this tension
      const double noise = 1e-7 * b.norm() * force.norm();
      CAPTURE(n);
      if (answer.tension[j] > 0.2) CHECK(nearer >= -noise);
      if (answer.tension[j] < 3.0) CHECK(nearer <= noise);
    }
  }
}

TEST_CASE("cables in the way are named by section, counted from 1") {
  const Model model = three_each(2);
  CHECK(cable_name(model, 0) == "cable 1 of section 1");
  CHECK(cable_name(model, 4) == "cable 2 of section 2");
  Robot with_own = model.robot();
  with_own.cables.push_back({0.01, 0.5, 0, 0.0, 0.0, {}});
  CHECK(cable_name(Model(with_own), 6) == "cable 4 of section 1");
  // Section 2 is asked for more along its first cable than 4 N give; section 1 for just as much.
  VectorXd force = VectorXd::Zero(6);
  force[3] = 10.0;
  const VectorXd asked = model.actuation_matrix() * force;
  const auto answer = allocate(model, asked, {0.0, 4.0, {}});
  CHECK_FALSE(answer.feasible);
  REQUIRE(answer.limits.size() == answer.limiting.size());
  REQUIRE_FALSE(answer.limits.empty());
  bool named = false;
  for (const std::string& limit : answer.limits) {
    named = named || limit == "cable 1 of section 2 at 4 N (max)";
  }
  CHECK(named);
}

TEST_CASE("method sections is for three cables around every section") {
  Robot robot = three_each(2).robot();
  robot.sections[1].cable_angles.push_back(0.1);
  const char* sentence =
      "method sections needs three cables, not on one side of the backbone, that end at every "
      "section, and all of them in use";
  CHECK_THROWS_SENTENCE(Allocator(Model(robot), by(AllocationMethod::sections, 0.0, 1.0)),
                        sentence);
  CHECK_FALSE(Allocator(Model(robot)).has_closed_form());
  robot.sections[1].cable_angles = {0.0, 0.5, 1.0};  // on one side
  CHECK_THROWS_SENTENCE(Allocator(Model(robot), by(AllocationMethod::sections, 0.0, 1.0)),
                        sentence);
  CHECK_FALSE(Allocator(three_each(2), by(AllocationMethod::search, 0.0, 1.0)).has_closed_form());
}

TEST_CASE("solving allocates nothing") {
  Random random;
  INFO(random);
  for (const int n : {1, 2, 8}) {
    const Model model = three_each(n);
    for (const AllocationMethod method : {AllocationMethod::sections, AllocationMethod::search}) {
      Allocator allocator(model, by(method, 0.1, 3.0));
      for (int round = 0; round < 20; ++round) {
        const VectorXd force = random.vector(2 * n, 0.1);
        CHECK(allocations_of([&] { (void)allocator.solve(force); }) == 0);
      }
    }
  }
}

TEST_CASE("commands hold the tensions they are made for") {
  Random random;
  INFO(random);
  Robot robot = three_each(3, 900.0).robot();
  robot.sections[1].cable_stiffness = 0.0;
  const Model model(robot);
  const VectorXd q = random_bending(3, 2.0, random), rest = VectorXd::Zero(6);
  VectorXd tension(9), command(9), held(9);
  for (Index j = 0; j < 9; ++j) tension[j] = random.uniform(0.0, 5.0);
  CHECK(allocations_of([&] { cable_commands(model, q, tension, command); }) == 0);
  CHECK(command.segment<3>(3) == tension.segment<3>(3));
  cable_tensions(model, q, rest, command, held);
  // A length of metres times the stiffness is what rounding is a share of.
  CHECK(residual(held, tension, 900.0 * model.straight_lengths().maxCoeff()) <= closed);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
