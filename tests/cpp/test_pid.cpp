// The PID loop by itself: its law, its limits, what it refuses.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "cdcr/cdcr.hpp"
#include "support/allocations.hpp"
#include "support/cases.hpp"
#include "support/pid_loops.hpp"
#include "support/residual.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

namespace tolerance {
/// A handful of operations.
constexpr double rounding = 4e-15;
}  // namespace tolerance

TEST_SUITE_BEGIN("pid");

TEST_CASE("an update is feed-forward plus gains times errors, allocated") {
  const Model model(heavily_damped());
  Data data(model);
  const Eigen::Vector2d reference(0.2, 0.4), qd(-0.3, 0.7);
  for (const bool feed_forward : {false, true}) {
    PidOptions options = gains(0.5, 2.0, 0.05, 0.25);
    options.feed_forward = feed_forward;
    options.limits.min_tension = 0.3;
    Pid pid(model, options);
    pid.set_reference(reference);
    CHECK(pid.reference() == reference);
    CHECK(pid.period() == 0.25);
    CHECK(pid.num_cables() == 3);
    VectorXd integral = VectorXd::Zero(2), hold = VectorXd::Zero(2), tension(3);
    if (feed_forward) potential_gradient(model, data, reference, hold);
    for (int i = 0; i < 4; ++i) {
      const VectorXd q = 0.1 * i * qd;
      REQUIRE(pid.update(0.25 * i, q, qd, tension) == Status::ok);
      const VectorXd force = hold + 0.5 * (reference - q) + 2.0 * integral - 0.05 * qd;
      CHECK(residual(tension, allocate(model, force, options.limits).tension) <=
            tolerance::rounding);
      integral += 0.25 * (reference - q);
      CHECK(residual(pid.integral(), integral) <= tolerance::rounding);
    }
    pid.reset();
    CHECK(pid.integral() == VectorXd::Zero(2));
    CHECK(pid.reference() == reference);
  }
}

TEST_CASE("anti-windup stops only what the limits withhold") {
  const Model model(amouri2020());
  PidOptions options = gains(1.0, 1.0, 0.0, 0.5);
  options.limits.max_tension = 2.0;
  const Eigen::Vector2d at_straight(0.0, 0.0), still(0.0, 0.0);
  VectorXd tension(3);
  for (const bool anti_windup : {true, false}) {
    options.anti_windup = anti_windup;
    Pid pid(model, options);
    // Out of reach along X; nothing is asked along Y.
    pid.set_reference(Eigen::Vector2d(1.0, 0.0));
    REQUIRE(pid.update(0.0, at_straight, still, tension) == Status::ok);
    CHECK(tension == Vector3d(2.0, 0.0, 0.0));
    CHECK(pid.integral() == Eigen::Vector2d(anti_windup ? 0.0 : 0.5, 0.0));
    // Beyond the reference the error has the other sign, which unwinds.
    REQUIRE(pid.update(0.5, Eigen::Vector2d(1.2, 0.0), still, tension) == Status::ok);
    CHECK(residual(pid.integral()[0], (anti_windup ? 0.0 : 0.5) - 0.1) <= 1e-14L);
  }
}

TEST_CASE("anti-windup takes rounding for nothing that limits withhold") {
  Robot robot = amouri2020();
  robot.sections[0].cable_angles = {0.0, 0.5 * pi, pi, 1.5 * pi};
  const Model model(robot);
  PidOptions options = gains(1.0, 1.0, 0.0, 1e-3);
  options.max_rate = 20.0;  // withholds force along X alone
  Pid pid(model, options);
  pid.set_reference(Eigen::Vector2d(1.5, 0.01));
  VectorXd tension(4);
  for (int i = 0; i < 200; ++i) {
    REQUIRE(pid.update(1e-3 * i, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), tension) ==
            Status::ok);
  }
  CHECK(residual(pid.integral()[1], 200 * 1e-3 * 0.01) <= 1e-13L);
}

TEST_CASE("a filtered derivative needs no measured rate") {
  const Model model(amouri2020());
  PidOptions options;
  options.kd = 0.3;
  options.filter = 4e-3;
  options.feed_forward = false;
  options.limits.min_tension = -1e3;
  Pid pid(model, options);
  // Under a ramp of q the rate comes up as 1 - (f/(f + T))^k.
  VectorXd command(3);
  const Eigen::Vector2d slope(0.5, -0.2), unused(77.0, 77.0);
  for (int k = 0; k < 30; ++k) {
    REQUIRE(pid.update(1e-3 * k, 1e-3 * k * slope, unused, command) == Status::ok);
    const double share = 1.0 - std::pow(4.0 / 5.0, k);
    const VectorXd expected = -0.3 * share * slope;
    CHECK(residual(model.actuation_matrix() * command, expected, 0.1) <= 1e-11);
  }
}

TEST_CASE("a state that is not a number is refused and leaves the controller as it was") {
  const Model model(amouri2020());
  Pid pid(model, gains(1.0, 1.0));
  pid.set_reference(q_start);
  VectorXd tension = Vector3d(1.0, 2.0, 3.0);
  CHECK(pid.update(0.0, Eigen::Vector2d(nan, 0.0), qd_start, tension) == Status::non_finite_state);
  CHECK(pid.update(0.0, q_start, Eigen::Vector2d(0.0, inf), tension) == Status::non_finite_state);
  CHECK(tension == Vector3d(1.0, 2.0, 3.0));
  CHECK(pid.integral() == VectorXd::Zero(2));
}

TEST_CASE("bad gains, periods, limits and references are refused") {
  const Model model(amouri2020());
  const auto refused = [&](const PidOptions& options, const char* sentence) {
    CHECK_THROWS_SENTENCE(Pid(model, options), sentence);
  };
  refused(gains(-1.0), "kp must be >= 0 N m/rad and finite, got -1");
  refused(gains(inf), "kp must be >= 0 N m/rad and finite, got inf");
  refused(gains(1.0, -2.0), "ki must be >= 0 N m/(rad s) and finite, got -2");
  refused(gains(1.0, 0.0, nan), "kd must be >= 0 N m s/rad and finite, got nan");
  refused(gains(1.0, 0.0, 0.0, 0.0), "period must be > 0 s and finite, got 0");
  refused(gains(1.0, 0.0, 0.0, inf), "period must be > 0 s and finite, got inf");
  PidOptions options = gains(1.0);
  options.limits = {1.0, 0.5, {}};
  refused(options,
          "tension limits must satisfy min_tension <= max_tension, got min_tension 1 N and "
          "max_tension 0.5 N");
  options.limits = {0.0, 1.0, {7}};
  refused(options, "cables must be indices from 0 to 2, got 7");

  Pid pid(model, gains(1.0));
  pid.set_reference(q_start);
  CHECK_THROWS_SENTENCE(pid.set_reference(Vector3d(1.0, 2.0, 3.0)),
                        "reference must be 2 finite values that bend each section by at most 3 pi "
                        "rad, got [1 2 3]");
  CHECK_THROWS_SENTENCE(pid.set_reference(Eigen::Vector2d(0.0, 10.0)),
                        "reference must be 2 finite values that bend each section by at most 3 pi "
                        "rad, got [ 0 10]");
  CHECK_THROWS_SENTENCE(pid.set_reference(Eigen::Vector2d(nan, 1.0)),
                        "reference must be 2 finite values that bend each section by at most 3 pi "
                        "rad, got [nan   1]");
  CHECK(pid.reference() == q_start);
}

TEST_CASE("an update neither allocates nor throws, whatever the cables") {
  // Compiles for a noexcept update alone.
  using Update =
      Status (Pid::*)(double, const ConstVectorRef&, const ConstVectorRef&, VectorRef) noexcept;
  [[maybe_unused]] constexpr Update update = &Pid::update;
  Random random;
  INFO(random);
  for (const int count : {0, 1, 2, 3, 4, 6, 16}) {
    CAPTURE(count);
    Robot robot = heavily_damped();
    robot.sections[0].cable_angles.clear();
    for (int j = 0; j < count; ++j) {
      robot.sections[0].cable_angles.push_back(2.0 * pi * j / count);
    }
    const Model model(robot);
    PidOptions options = gains(1.0, 1.0, 0.1);
    options.limits = {0.1, 2.0, {}};
    Pid pid(model, options);
    pid.set_reference(q_start);
    VectorXd tension(count);
    for (int round = 0; round < 20; ++round) {
      const VectorXd q = random.vector(2, 0.5), qd = random.vector(2, 1.0);
      Status status = Status::not_started;
      CHECK(allocations_of([&] { status = pid.update(0.0, q, qd, tension); }) == 0);
      CHECK(status == Status::ok);
    }
    CHECK(allocations_of([&] { pid.reset(); }) == 0);
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
