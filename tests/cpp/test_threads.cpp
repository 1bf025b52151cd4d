// One model read by several threads at once gives every thread the same bits.
#include <doctest/doctest.h>

#include <thread>
#include <vector>

#include "cdcr/simulate.hpp"
#include "cdcr/statics.hpp"
#include "support/cases.hpp"
#include "support/runs.hpp"

namespace cdcr::test {
namespace {

struct Answers {
  Trajectory adaptive, fixed;
  Equilibrium rest;
};

Answers compute(const Model& model) {
  const Eigen::Vector2d q(0.4, -0.2), qd(1.0, 3.0);
  const VectorXd times = even_times(0.0, 20.0, 201);
  const CommandInput input = CommandInput::constant(Eigen::Vector3d(2.0, 1.0, 0.0));
  return {simulate(model, q, qd, times, input, Method::dopri5),
          simulate(model, q, qd, times, input, Method::rk4),
          equilibrium(model, Eigen::Vector3d(2.0, 1.0, 0.0))};
}

TEST_SUITE_BEGIN("threads");

TEST_CASE("four threads, one model, the same bits") {
  Robot robot = amouri2020();
  robot.gravity = {1.0, 0.0, -9.7};
  const Model model(robot);
  const Answers alone = compute(model);
  std::vector<Answers> answers(4);
  std::vector<std::thread> threads;
  for (Answers& mine : answers) {
    threads.emplace_back([&model, &mine] { mine = compute(model); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Answers& answer : answers) {
    CHECK(answer.adaptive.q == alone.adaptive.q);
    CHECK(answer.adaptive.qd == alone.adaptive.qd);
    CHECK(answer.fixed.q == alone.fixed.q);
    CHECK(answer.rest.q == alone.rest.q);
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
