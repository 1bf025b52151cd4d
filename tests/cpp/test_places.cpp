// Places given by arc length, and what coordinates are called.
#include <doctest/doctest.h>

#include <limits>

#include "cdcr/model.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/throws.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

TEST_SUITE_BEGIN("places");

TEST_CASE("places by arc length") {
  Random random;
  Robot robot = random_chain(random, 4);
  double begin = 0.0;
  for (Index i = 0; i < 4; ++i) {
    const double length = robot.sections[i].length;
    for (const double x : {0.25, 0.5, 1.0}) {
      const Place place = robot.locate(begin + x * length);
      CHECK(place.section == i);
      CHECK(residual(place.fraction, x) <= tolerance::cancelled);
    }
    begin += length;
  }
  CHECK(robot.locate(0.0).section == 0);
  CHECK(robot.locate(0.0).fraction == 0.0);
  robot = amouri2020();
  CHECK(robot.locate(0.802 * (1.0 + 2e-16)).fraction == 1.0);
  const std::string sentence = "s must be 0 to 0.802 m, the length of the robot, got ";
  CHECK_THROWS_SENTENCE(robot.locate(0.803), (sentence + "0.803").c_str());
  CHECK_THROWS_SENTENCE(robot.locate(-1e-9), (sentence + "-1e-09").c_str());
  CHECK_THROWS_SENTENCE(robot.locate(std::numeric_limits<double>::quiet_NaN()),
                        (sentence + "nan").c_str());
}

TEST_CASE("coordinates have names") {
  Random random;
  const Model model(random_chain(random, 2));
  CHECK(model.coordinate_names() == std::vector<std::string>{"q1_x", "q1_y", "q2_x", "q2_y"});
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
