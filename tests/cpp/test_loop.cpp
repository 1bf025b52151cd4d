// Closed loops: the same as by hand, what is told, failures.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "cdcr/cdcr.hpp"
#include "support/controlled_robots.hpp"
#include "support/residual.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

constexpr double step = 1e-3;

/// Asks for the same at all times.
class Steady final : public Controller {
 public:
  explicit Steady(VectorXd command) : command_(std::move(command)) {}
  void reset() noexcept override {}
  Status update(double /*t*/, const ConstVectorRef& /*q*/, const ConstVectorRef& /*qd*/,
                VectorRef command) noexcept override {
    command = command_;
    return Status::ok;
  }
  double period() const noexcept override { return step; }
  Index num_coordinates() const noexcept override { return any_size; }
  Index num_cables() const noexcept override { return any_size; }

 private:
  VectorXd command_;
};

ReferencePath swing(const Model& model) {
  MatrixXd points = MatrixXd::Zero(3, model.num_coordinates());
  points.row(1).setConstant(0.2);
  points.row(2).setConstant(-0.1);
  return ReferencePath::spline(Vector3d(0.0, 0.2, 0.5), points);
}

TEST_SUITE_BEGIN("loop");

TEST_CASE("a loop does what a simulator and a controller do by hand, to the last bit") {
  for (const NamedRobot& sample : controlled_robots()) {
    CAPTURE(sample.name);
    const Model model(sample.robot);
    const VectorXd q0 = model.rest(), qd0 = VectorXd::Zero(q0.size());
    ComputedTorqueOptions options;
    options.period = 2.0 * step;
    ComputedTorque inside(model, options), by_hand(model, options);
    inside.set_path(swing(model));
    by_hand.set_path(swing(model));
    LoopOptions how;
    how.step = step;
    how.substeps = 2;
    Loop loop(model, inside, how);
    loop.reset(q0, qd0, 0.0);
    Simulator simulator(model, step, 2);
    simulator.reset(q0, qd0);
    VectorXd command(model.num_cables());
    for (int k = 0; k < 100; ++k) {
      if (k % 2 == 0) {
        REQUIRE(by_hand.update(simulator.time(), simulator.q(), simulator.qd(), command) ==
                Status::ok);
      }
      REQUIRE(simulator.step(command) == Status::ok);
      REQUIRE(loop.step() == Status::ok);
      REQUIRE(loop.q() == simulator.q());
      REQUIRE(loop.qd() == simulator.qd());
      REQUIRE(loop.given() == command);
    }
    CHECK(loop.time() == simulator.time());
  }
}

TEST_CASE("the same loop gives the same bits, noise and all, and run samples it") {
  const Model model(upright(2));
  PidOptions options;
  options.kp = 1.0;
  options.kd = 0.05;
  Pid pid(model, options);
  LoopOptions how;
  how.actuators.assign(1, {0.01, 2e-3, 0.01, 100.0, 0.0, 50.0, {}});
  how.sensors.resize(2);
  how.sensors[0] = {Sensor::Kind::coordinates, 2e-3, 1e-3, 1e-3, 1e-3, {}, 7};
  how.sensors[1] = {Sensor::Kind::tip, 0.0, 0.0, 1e-4, 0.0, {}, 8};
  Loop loop(model, pid, how);
  const VectorXd zero = VectorXd::Zero(4);
  LoopRun runs[2];
  for (LoopRun& one : runs) {
    loop.reset(zero, zero, 5.0);
    one = run(loop, 0.2, 10);
    REQUIRE(one.status == Status::ok);
  }
  CHECK(runs[0].q == runs[1].q);
  CHECK(runs[0].asked == runs[1].asked);
  CHECK(runs[0].told[1] == runs[1].told[1]);
  CHECK(runs[0].t.size() == 21);
  CHECK(runs[0].t[20] == doctest::Approx(5.2));
  CHECK(runs[0].q.row(20).transpose() == loop.q());
  CHECK(runs[0].told_q != runs[0].q);
  CHECK(runs[0].told_qd.topRows(20) == runs[0].qd.topRows(20));
}

TEST_CASE("the first commands too change no faster than may be, from those at reset") {
  const Model model(upright(2));
  ComputedTorqueOptions options;
  options.limits.max_rate = 100.0;
  options.limits.tension.min_tension = 1.0;
  ComputedTorque controller(model, options);
  controller.set_reference(VectorXd::Constant(4, 0.3));
  Loop loop(model, controller);
  const VectorXd zero = VectorXd::Zero(4), hold = VectorXd::LinSpaced(6, 2.0, 4.0);
  for (const VectorXd& command : {hold, VectorXd(VectorXd::Zero(6))}) {
    loop.reset(zero, zero, 0.0, command);
    VectorXd before = command;
    for (int k = 0; k < 20; ++k) {
      REQUIRE(loop.step() == Status::ok);
      const VectorXd change = loop.asked() - before;
      CHECK(change.cwiseAbs().maxCoeff() <= 0.1 + 1e-12);
      CHECK(change.cwiseAbs().maxCoeff() >= 0.1 - 1e-12);  // and they do change so fast
      before = loop.asked();
    }
    CHECK(before.minCoeff() >= 1.0);
  }
}

TEST_CASE("after a failure the last good state stays, until reset") {
  const Model model(upright(1));
  Steady strong(Vector3d(4000.0, 0.0, 0.0));
  Loop loop(model, strong);
  CHECK(loop.step() == Status::not_started);
  const Eigen::Vector2d zero(0.0, 0.0);
  loop.reset(zero, zero);
  Status status = Status::ok;
  VectorXd last;
  for (int k = 0; k < 1000 && status == Status::ok; ++k) {
    last = loop.q();
    status = loop.step();
  }
  CHECK(status == Status::bending_limit);
  CHECK(loop.q() == last);
  CHECK(loop.step() == Status::bending_limit);
  loop.reset(zero, zero);
  CHECK(loop.step() == Status::ok);
  const LoopRun cut = run(loop, 5.0);
  CHECK(cut.status == Status::bending_limit);
  CHECK(cut.t.size() == cut.q.rows());
  CHECK(cut.message.find("stopped at t = ") == 0);
  CHECK_THROWS_WITH(run(loop, 5.0), "the loop has ended (bending_limit): call reset(q, qd) first");

  Steady breaking(Vector3d(1e300, 0.0, 0.0));
  Loop broken(model, breaking);
  broken.reset(zero, zero, 3.0);
  const LoopRun first = run(broken, 5.0);
  CHECK(first.status != Status::ok);
  REQUIRE(first.t.size() == 1);
  CHECK(first.t[0] == 3.0);
  CHECK(first.command(0, 0) == 1e300);

  loop.reset(zero, zero);
  CHECK(loop.step(no_wrenches(), [] { return true; }) == Status::ok);  // asked in long steps alone
  LoopOptions long_steps;
  long_steps.step = 1e-3;
  long_steps.substeps = 1 << 30;
  Steady idle(Vector3d(0.0, 0.0, 0.0));
  Loop slow(model, idle, long_steps);
  slow.reset(zero, zero);
  CHECK(slow.step(no_wrenches(), [] { return true; }) == Status::interrupted);
  CHECK(slow.time() == 0.0);

  Steady pushing(Vector3d(-1.0, 0.0, 0.0));
  Loop refused(model, pushing);
  refused.reset(zero, zero);
  CHECK(refused.step() == Status::invalid_tension);
}

TEST_CASE("an estimator's word is what the controller is told") {
  class Half final : public Estimator {
   public:
    void reset(const ConstVectorRef& /*q*/, const ConstVectorRef& /*qd*/,
               const ConstVectorRef& /*command*/) noexcept override {}
    Status update(double /*t*/, const std::vector<Measurement>& told,
                  const ConstVectorRef& /*command*/, VectorRef q, VectorRef qd) noexcept override {
      if (told[0].fresh) q = 0.5 * told[0].value;
      qd.setZero();
      return Status::ok;
    }
  } half;
  const Model model(upright(1));
  Steady steady(Vector3d(1.0, 0.0, 0.0));
  LoopOptions how;
  how.sensors.emplace_back();
  Loop loop(model, steady, how, &half);
  loop.reset(Eigen::Vector2d(0.2, 0.1), Eigen::Vector2d(0.3, 0.3));
  REQUIRE(loop.step() == Status::ok);
  CHECK(loop.told_q() == Eigen::Vector2d(0.1, 0.05));
  CHECK(loop.told_qd() == Eigen::Vector2d(0.0, 0.0));
  CHECK_THROWS_SENTENCE(Loop(model, steady, LoopOptions(), &half), "an estimator needs sensors");
}

TEST_CASE("what does not fit is refused in a sentence") {
  const Model model(upright(1));
  Steady steady(Vector3d::Zero());
  LoopOptions how;
  how.step = 0.0;
  CHECK_THROWS_SENTENCE(Loop(model, steady, how), "step must be > 0 s and finite, got 0");
  how.step = 7e-4;
  CHECK_THROWS_SENTENCE(Loop(model, steady, how),
                        "the controller's period must be a whole number of steps of 0.0007 s, 1 to "
                        "1e9, got 0.001 s");
  how.step = step;
  how.actuators.resize(2);
  CHECK_THROWS_SENTENCE(Loop(model, steady, how),
                        "there must be one actuator, or one for each of the 3 cables, got 2");
  how.actuators.resize(1);
  how.actuators[0].min_command = 3.0;
  how.actuators[0].max_command = 2.0;
  CHECK_THROWS_SENTENCE(Loop(model, steady, how),
                        "limits of actuator 1 must satisfy 0 <= min_command <= max_command, got 3 "
                        "and 2");
  how.actuators[0].min_command = how.actuators[0].max_command = INFINITY;
  CHECK_THROWS_SENTENCE(Loop(model, steady, how),
                        "min_command of actuator 1 must be finite, got inf");
  how.actuators[0] = {};
  how.actuators[0].resolution = 1e-320;
  CHECK_THROWS_SENTENCE(Loop(model, steady, how),
                        doctest::Contains("resolution of actuator 1 must be 0 (none) or at least"));
  how.actuators[0] = {};
  how.actuators[0].dead_time = 1.5e-3;
  CHECK_THROWS_SENTENCE(Loop(model, steady, how),
                        "dead_time of actuator 1 must be a whole number of steps of 0.001 s, 0 to "
                        "1e9, got 0.0015 s");
  how.actuators[0] = {};
  how.actuators[0].winch = Winch{0.01, 1.0, 1e-5, 50.0, 1.0, 1.0};
  CHECK_THROWS_SENTENCE(Loop(model, steady, how),
                        "a winch drives cables by length, but cable 1 of the robot is driven by "
                        "tension (its stiffness is 0)");
  how.actuators.clear();
  how.sensors.resize(1);
  how.sensors[0].kind = Sensor::Kind::curvature;
  CHECK_THROWS_SENTENCE(Loop(model, steady, how), "sensor 1, of curvature, needs places");
  how.sensors[0].places = {{3, 0.5}};
  CHECK_THROWS_SENTENCE(Loop(model, steady, how),
                        "places of sensor 1 must be sections 0 to 0 and fractions 0 to 1, got "
                        "section 3 and fraction 0.5");
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
