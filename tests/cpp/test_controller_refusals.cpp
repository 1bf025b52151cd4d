// What controllers refuse before a run.
#include <doctest/doctest.h>

#include <limits>

#include "cdcr/cdcr.hpp"
#include "support/controlled_robots.hpp"
#include "support/runs.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST_SUITE_BEGIN("controller_refusals");

TEST_CASE("what does not fit is refused in a sentence") {
  const Model model(upright(1));
  PidOptions pid;
  pid.kp = Vector3d(1.0, 2.0, 3.0);
  CHECK_THROWS_SENTENCE(Pid(model, pid),
                        "kp must be a number, 2 numbers or a matrix of 2 by 2, got 3 by 1");
  pid.kp = Eigen::Vector2d(1.0, -1.0);
  CHECK_THROWS_SENTENCE(Pid(model, pid), "kp must be >= 0 N m/rad and finite, got -1");
  pid.kp = Eigen::Matrix2d::Constant(nan);
  CHECK_THROWS_SENTENCE(Pid(model, pid), "kp must be finite");
  ComputedTorqueOptions torque;
  torque.period = 0.0;
  CHECK_THROWS_SENTENCE(ComputedTorque(model, torque), "period must be > 0 s and finite, got 0");
  torque.period = 1e-3;
  torque.limits.max_rate = 0.0;
  CHECK_THROWS_SENTENCE(ComputedTorque(model, torque),
                        "max_rate must be > 0 N/s (m/s of lengths), got 0");
  torque.limits = {};
  torque.limits.tension.min_tension = 2.0;
  torque.limits.tension.max_tension = 1.0;
  CHECK_THROWS_SENTENCE(ComputedTorque(model, torque),
                        "tension limits must satisfy min_tension <= max_tension, got min_tension 2 "
                        "N and max_tension 1 N");
  torque.limits = {};
  torque.limits.tension.pretension = Eigen::Vector2d(1.0, 1.0);
  CHECK_THROWS_SENTENCE(ComputedTorque(model, torque),
                        "pretension must have one value for each of the 3 cables, got 2");
  torque.limits = {};
  torque.limits.tension.min_tension = -2.0;
  torque.limits.tension.max_tension = -1.0;
  CHECK_THROWS_SENTENCE(ComputedTorque(model, torque),
                        "max_tension must be >= 0 N (a cable cannot push), got -1");
  torque.limits = {};
  torque.limits.tension.cables = {2, 1, 2};
  CHECK_THROWS_SENTENCE(ComputedTorque(model, torque), "cables must differ, got 2 2 times");
  StateFeedbackOptions feedback;
  feedback.gain = MatrixXd::Zero(3, 3);
  CHECK_THROWS_SENTENCE(StateFeedback(model, feedback),
                        "gain must be 3 by 4 finite values, got 3 by 3");
  TaskSpaceOptions task;
  task.damping = 0.0;
  CHECK_THROWS_SENTENCE(TaskSpace(model, task), "damping must be > 0 1/rad and finite, got 0");
  TaskSpace tip_controller(model, {});
  CHECK_THROWS_SENTENCE(tip_controller.set_reference(Eigen::Vector2d(0.0, 0.1)),
                        "reference must be 3 finite values [m], got [  0 0.1]");
  CHECK_NOTHROW(tip_controller.set_reference(tip(model, Eigen::Vector2d(0.0, 0.0)).p));
  CHECK_THROWS_SENTENCE(tip_controller.set_reference(Vector3d(3.0, 0.0, 4.0)),
                        "reference must be at most 0.802 m from the base, as far as the tip "
                        "reaches, got [3 0 4], which is 5 m away");
  ComputedTorque fine(model);
  const Model other(by_length(1));
  const VectorXd zero = VectorXd::Zero(2);
  CHECK_THROWS_SENTENCE(simulate(other, zero, zero, even_times(0.0, 1.0, 2), fine),
                        "the controller drives cables by tension, but cable 1 of the robot is "
                        "driven by length (its stiffness is not 0)");
  ComputedTorque lengths(other);
  CHECK_THROWS_SENTENCE(simulate(model, zero, zero, even_times(0.0, 1.0, 2), lengths),
                        "the controller drives cables by length, but cable 1 of the robot is "
                        "driven by tension (its stiffness is 0)");
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
