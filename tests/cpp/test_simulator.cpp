// The simulator inside a control loop.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "cdcr/simulate.hpp"
#include "cdcr/simulator.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();
// Powers of two, so that sums of periods are exact and simulate takes the very same steps.
constexpr double period = 1.0 / 1024.0;

const Eigen::Vector2d q_start(0.4, -0.1), qd_start(0.5, 2.0);
const Eigen::Vector3d pull(3.0, 1.0, 0.0);

Model upright() {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  robot.sections[0].damping = 1e-3;
  return Model(robot);
}

void check_state_is(const Simulator& sim, const VectorXd& q, const VectorXd& qd, double time) {
  CHECK(sim.q() == q);
  CHECK(sim.qd() == qd);
  CHECK(sim.time() == time);
}

TEST_SUITE_BEGIN("simulator");

TEST_CASE("steps equal those of simulate with rk4, to the last bit") {
  const Model model = upright();
  for (const int substeps : {1, 4}) {
    Simulator sim(model, period, substeps);
    sim.reset(q_start, qd_start);
    const Trajectory run =
        simulate(model, q_start, qd_start, even_times(0.0, 1.0, 1025), CommandInput::constant(pull),
                 Method::rk4, fixed_step(period / substeps));
    REQUIRE(run.status == Status::ok);
    for (Index i = 1; i <= 1024; ++i) {
      REQUIRE(sim.step(pull) == Status::ok);
      REQUIRE(sim.q() == run.q.row(i).transpose());
      REQUIRE(sim.qd() == run.qd.row(i).transpose());
      REQUIRE(sim.time() == run.t[i]);
    }
  }
}

TEST_CASE("tensions may change every period") {
  const Model model = upright();
  Simulator sim(model, period);
  sim.reset(q_start, qd_start);
  const Index count = 200;
  MatrixXd rows(count, 3);
  for (Index i = 0; i < count; ++i) {
    rows.row(i) << 1.0 + std::sin(0.1 * static_cast<double>(i)), 0.5, 1.0;
  }
  VectorXd times(count + 1);
  for (Index i = 0; i <= count; ++i) times[i] = static_cast<double>(i) * period;
  const Trajectory run =
      simulate(model, q_start, qd_start, times,
               CommandInput::table(times.head(count), rows, CommandInput::Interpolation::previous),
               Method::rk4, fixed_step(period));
  for (Index i = 0; i < count; ++i) {
    REQUIRE(sim.step(rows.row(i).transpose()) == Status::ok);
    REQUIRE(sim.q() == run.q.row(i + 1).transpose());
  }
}

TEST_CASE("time does not gather rounding errors") {
  const Model model = upright();
  Simulator sim(model, 1e-3);
  sim.reset(VectorXd::Zero(2), VectorXd::Zero(2), 5.0);
  for (int i = 0; i < 10000; ++i) REQUIRE(sim.step(VectorXd::Zero(3)) == Status::ok);
  CHECK(sim.time() == 15.0);
  CHECK(sim.period() == 1e-3);
}

TEST_CASE("reset starts again with the same answers") {
  const Model model = upright();
  Simulator sim(model);
  sim.reset(q_start, qd_start);
  for (int i = 0; i < 50; ++i) REQUIRE(sim.step(pull) == Status::ok);
  const VectorXd q = sim.q(), qd = sim.qd();
  sim.reset(q_start, qd_start);
  check_state_is(sim, q_start, qd_start, 0.0);
  for (int i = 0; i < 50; ++i) REQUIRE(sim.step(pull) == Status::ok);
  CHECK(sim.q() == q);
  CHECK(sim.qd() == qd);
}

TEST_CASE("a simulator outlives the model it was made from, and can be moved") {
  auto model = std::make_unique<Model>(upright());
  Simulator sim(*model);
  model.reset();
  sim.reset(q_start, qd_start);
  Simulator moved(std::move(sim));
  CHECK(moved.step(pull) == Status::ok);
  CHECK(moved.model().num_cables() == 3);
}

TEST_CASE("before reset a step does nothing") {
  Simulator sim(upright());
  CHECK(sim.step(pull) == Status::not_started);
  check_state_is(sim, VectorXd::Zero(2), VectorXd::Zero(2), 0.0);
}

TEST_CASE("a bad tension leaves the last good state, and the loop can go on") {
  Simulator sim(upright(), period), reference(upright(), period);
  sim.reset(q_start, qd_start);
  reference.reset(q_start, qd_start);
  REQUIRE(sim.step(pull) == Status::ok);
  REQUIRE(reference.step(pull) == Status::ok);
  const VectorXd q = sim.q(), qd = sim.qd();
  for (const VectorXd& bad :
       {VectorXd(Eigen::Vector3d(1.0, -1e-9, 0.0)), VectorXd(Eigen::Vector3d(nan, 0.0, 0.0)),
        VectorXd(Eigen::Vector3d(0.0, inf, 0.0)), VectorXd(Eigen::Vector2d(1.0, 1.0)),
        VectorXd(VectorXd::Zero(4)), VectorXd(0)}) {
    CHECK(sim.step(bad) == Status::invalid_tension);
    check_state_is(sim, q, qd, period);
  }
  CHECK(sim.step(pull) == Status::ok);
  CHECK(reference.step(pull) == Status::ok);
  check_state_is(sim, reference.q(), reference.qd(), 2.0 * period);
}

TEST_CASE("a step beyond the bending limit is not taken") {
  Simulator sim(upright(), 0.01);
  sim.reset(Eigen::Vector2d(9.0, 0.0), Eigen::Vector2d(0.0, 0.0));
  const VectorXd hard = Eigen::Vector3d(2000.0, 0.0, 0.0);
  VectorXd q = sim.q(), qd = sim.qd();
  double time = 0.0;
  Status status = Status::ok;
  for (int i = 0; i < 1000 && status == Status::ok; ++i) {
    q = sim.q();
    qd = sim.qd();
    time = sim.time();
    status = sim.step(hard);
  }
  CHECK((status == Status::bending_limit || status == Status::non_finite_state));
  check_state_is(sim, q, qd, time);
}

TEST_CASE("coasting over the limit is a bending limit, not a NaN") {
  Simulator sim(upright(), 1e-5);
  sim.reset(Eigen::Vector2d(max_bending - 1e-3, 0.0), Eigen::Vector2d(50.0, 0.0));
  Status status = Status::ok;
  for (int i = 0; i < 10 && status == Status::ok; ++i) status = sim.step(VectorXd::Zero(3));
  INFO("status: ", std::string(name(status)));
  CHECK(status == Status::bending_limit);
  CHECK(sim.q().norm() <= max_bending);
}

TEST_CASE("a speed that overflows is a state that is not finite") {
  Simulator sim(upright());
  sim.reset(q_start, Eigen::Vector2d(1e200, 0.0));
  CHECK(sim.step(pull) == Status::non_finite_state);
  check_state_is(sim, q_start, Eigen::Vector2d(1e200, 0.0), 0.0);
}

TEST_CASE("bad set-up is refused with a sentence") {
  const Model model = upright();
  CHECK_THROWS_SENTENCE(Simulator(model, 0.0), "step must be > 0 s and finite, got 0");
  CHECK_THROWS_SENTENCE(Simulator(model, -1e-9), "step must be > 0 s and finite, got -1e-09");
  CHECK_THROWS_SENTENCE(Simulator(model, inf), "step must be > 0 s and finite, got inf");
  CHECK_THROWS_SENTENCE(Simulator(model, 1e-3, 0), "substeps must be at least 1, got 0");
  Simulator sim(model);
  CHECK_THROWS_SENTENCE(sim.reset(Eigen::Vector3d::Zero(), qd_start),
                        "q must be 2 finite values, got [0 0 0]");
  CHECK_THROWS_SENTENCE(sim.reset(q_start, Eigen::Vector2d(inf, 1.0)),
                        "qd must be 2 finite values, got [inf   1]");
  CHECK_THROWS_SENTENCE(sim.reset(q_start, qd_start, nan), "time must be finite, got nan");
  CHECK_THROWS_SENTENCE(sim.reset(Eigen::Vector2d(9.5, 0.0), qd_start),
                        "q must bend each section by at most 3 pi rad, got 9.5 rad in section 1");
  CHECK(sim.step(pull) == Status::not_started);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
