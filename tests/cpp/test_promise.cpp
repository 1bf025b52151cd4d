// The promise of loops: steps and updates allocate nothing and end in a status, for as many periods
// as CDCR_TEST_PERIODS says (20; 100,000 at night): 1, 3 and 8 sections, arcs and rods, every
// controller, estimator and method; saturated, infeasible, slack, and what is not finite.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <memory>

#include "cdcr/cdcr.hpp"
#include "support/allocations.hpp"
#include "support/controlled_robots.hpp"
#include "support/filters.hpp"
#include "support/noexcept.hpp"
#include "support/settings.hpp"

namespace cdcr::test {
namespace {

using Step = Status (Loop::*)(const Wrenches&) noexcept;
[[maybe_unused]] constexpr Step step_is_noexcept = &Loop::step;
static_assert(is_noexcept<decltype(&Controller::update)>);
static_assert(is_noexcept<decltype(&Controller::reset)>);
static_assert(is_noexcept<decltype(&Controller::hold)>);
static_assert(is_noexcept<decltype(&Controller::diagnostics)>);
static_assert(is_noexcept<decltype(&Estimator::update)>);
static_assert(is_noexcept<decltype(&Estimator::reset)>);
static_assert(is_noexcept<decltype(&Estimator::write_values)>);
static_assert(is_noexcept<decltype(&Estimator::diagnostics)>);
static_assert(is_noexcept<decltype(&SensorChannel::step)>);
static_assert(is_noexcept<decltype(&Actuators::step)>);
static_assert(is_noexcept<decltype(&base_wrench)>);

long test_periods() {
  return static_cast<long>(environment("CDCR_TEST_PERIODS", 20));
}

Robot hanging(int n) {
  Robot robot = upright(n);
  robot.gravity = -robot.gravity;
  return robot;
}

/// Rods damped so little that explicit steps of a fifth of a millisecond are stable.
Robot limber() {
  Robot robot = slender();
  for (Section& section : robot.sections) section.damping = 2e-3;
  return robot;
}

VectorXd shape(const Model& model, double share) {
  VectorXd q = model.rest();
  for (Index i = 0; i < q.size(); ++i) {
    if (model.coordinate_names()[static_cast<std::size_t>(i)][0] == 'q') q[i] += share;
  }
  return q;
}

/// Through shapes, or where the tip is in them.
ReferencePath swing(const Model& model, TrackingController::Follows follows) {
  using Follows = TrackingController::Follows;
  MatrixXd points(3, follows == Follows::coordinates ? model.num_coordinates()
                     : follows == Follows::position  ? 3
                                                     : 6);
  const double shares[] = {0.0, 0.1, -0.05};
  for (Index row = 0; row < 3; ++row) {
    const VectorXd q = shape(model, shares[row]);
    const Pose at = tip(model, q);
    if (follows == Follows::coordinates) points.row(row) = q.transpose();
    if (follows != Follows::coordinates) points.row(row).head<3>() = at.p.transpose();
    if (follows == Follows::pose) {
      const Eigen::AngleAxisd turn(at.R);
      points.row(row).tail<3>() = turn.angle() * turn.axis().transpose();
    }
  }
  return ReferencePath::spline(Vector3d(0.0, 0.2, 0.5), points);
}

/// One of each kind, within tensions that reach far or nowhere near far enough.
std::vector<std::unique_ptr<TrackingController>> all_controllers(const Model& model,
                                                                 double strongest) {
  CommandLimits limits;
  limits.tension.max_tension = strongest;
  limits.tension.min_tension = 0.1;
  limits.max_rate = 500.0;
  std::vector<std::unique_ptr<TrackingController>> found;
  PidOptions pid;
  pid.kp = 0.5;
  pid.ki = 0.5;
  pid.kd = 0.02;
  pid.limits = limits.tension;
  found.push_back(std::make_unique<Pid>(model, pid));
  ComputedTorqueOptions torque;
  torque.limits = limits;
  found.push_back(std::make_unique<ComputedTorque>(model, torque));
  StateFeedbackOptions feedback;
  const Index d = model.num_coordinates();
  feedback.gain = MatrixXd::Zero(model.num_cables(), 2 * d);
  for (Index j = 0; j < model.num_cables(); ++j) {
    if (model.cables()[static_cast<std::size_t>(j)].length_driven()) continue;
    feedback.gain.row(j).head(d) = model.actuation_matrix().col(j).transpose() * 10.0;
    feedback.gain.row(j).tail(d) = model.actuation_matrix().col(j).transpose();
  }
  feedback.limits = limits;
  found.push_back(std::make_unique<StateFeedback>(model, feedback));
  TaskSpaceOptions task;
  task.limits = limits;
  found.push_back(std::make_unique<TaskSpace>(model, task));
  task.orientation_weight = VectorXd::Constant(1, 0.2);
  found.push_back(std::make_unique<TaskSpace>(model, task));
  for (const auto& one : found) one->set_path(swing(model, one->follows()));
  return found;
}

/// None, or one of each kind with what it hears and the model that a force on the tip adds to.
struct Heard {
  std::vector<Sensor> sensors;
  std::unique_ptr<Estimator> estimator;
};

Sensor sensor_of(Sensor::Kind kind, double noise) {
  Sensor sensor;
  sensor.kind = kind;
  sensor.noise = noise;
  return sensor;
}

Heard heard(std::size_t kind, const Model& model, const LoopOptions& how) {
  using Kind = Sensor::Kind;
  Heard found;
  if (kind == 0 || kind == 3) {
    found.sensors = {sensor_of(Kind::coordinates, 1e-5), sensor_of(Kind::rates, 1e-5)};
    if (kind == 0) return found;
    MomentumObserverOptions options;
    options.actuators = how.actuators;
    options.force_at = Place{model.num_sections() - 1, 1.0};
    found.estimator = std::make_unique<MomentumObserver>(model, options);
    return found;
  }
  KalmanOptions options;
  options.sensors = {
      sensor_of(Kind::lengths, 1e-5),     sensor_of(Kind::tensions, 0.05),
      sensor_of(Kind::tip, 1e-3),         sensor_of(Kind::orientation, 1e-2),
      sensor_of(Kind::curvature, 0.1),    sensor_of(Kind::base_force, 0.05),
      sensor_of(Kind::base_moment, 0.01),
  };
  options.sensors[2].delay = 5e-3;
  options.sensors[2].period = 2e-3;
  options.sensors[4].places = {{0, 0.5}, {model.num_sections() - 1, 1.0}};
  options.actuators = how.actuators;
  options.substeps = model.has_rods() ? 5 : 2;
  options.acceleration_noise[0] = 5.0;
  options.deviation = 1e-3;
  options.rate_deviation = 1e-3;
  if (kind == 1) {
    options.force_at = Place{model.num_sections() - 1, 1.0};
    found.sensors = options.sensors;
    found.estimator = std::make_unique<ExtendedKalman>(model, options);
  } else {
    options.variants = {heavier(model.robot())};
    options.share_deviation = 0.01;  // inertia is positive within all that is doubted
    found.sensors = options.sensors;
    found.estimator = std::make_unique<UnscentedKalman>(model, options);
  }
  return found;
}

/// So many periods under a push that comes and goes; then one that no robot bears, and what is no
/// number, from all sides.
void keep_promise(Loop& loop, long periods) {
  const Model& model = loop.plant().model();
  loop.reset(model.rest(), VectorXd::Zero(model.num_coordinates()));
  Wrenches push(1);
  push[0].section = model.num_sections() - 1;
  Status status = Status::ok;
  CHECK(allocations_of([&] {
          for (long k = 0; k < periods && status == Status::ok; ++k) {
            push[0].force[0] = 0.05 * std::sin(0.01 * static_cast<double>(k));
            status = loop.step(push);
          }
        }) == 0);
  CAPTURE(name(status));
  CAPTURE(loop.time());
  CHECK(status == Status::ok);
  CHECK(loop.q().allFinite());

  push[0].force[0] = 1e300;
  CHECK(allocations_of([&] {
          for (int k = 0; k < 3; ++k) status = loop.step(push);
        }) == 0);
  CHECK(status != Status::ok);
  loop.reset(model.rest(), VectorXd::Zero(model.num_coordinates()));
  push[0].force[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(allocations_of([&] { status = loop.step(push); }) == 0);
  CHECK(status == Status::invalid_wrench);

  const VectorXd bad =
      VectorXd::Constant(model.num_coordinates(), std::numeric_limits<double>::quiet_NaN());
  VectorXd command = loop.asked(), q = model.rest(), qd = VectorXd::Zero(q.size());
  CHECK(allocations_of([&] { status = loop.controller().update(0.0, bad, qd, command); }) == 0);
  CHECK(status == Status::non_finite_state);
  if (loop.estimator() == nullptr) return;
  std::vector<Measurement> told = loop.told();
  for (Measurement& one : told) {
    one.value.setConstant(std::numeric_limits<double>::infinity());
    one.fresh = true;
  }
  qd = bad;
  loop.estimator()->reset(model.rest(), VectorXd::Zero(q.size()), command);
  CHECK(allocations_of([&] {
          // Late sensors let the filter wait.
          for (int k = 0; k < 10; ++k) {
            status = loop.estimator()->update(0.0, told, command, q, qd);
          }
        }) == 0);
  CHECK(status != Status::ok);
}

/// Every controller, with an estimator of each kind, by each method.
void keep_promises(const Robot& robot) {
  const Model model(robot);
  std::size_t turn = 0;
  for (const double strongest : {20.0, 0.2}) {  // enough, and saturated at all times
    for (const auto& controller : all_controllers(model, strongest)) {
      LoopOptions how;
      how.method = turn % 2 == 1 || model.has_rods() ? Method::rosenbrock : Method::rk4;
      how.substeps = how.method == Method::rk4 ? 2 : 1;
      how.actuators.assign(1, {0.0, 2e-3, 0.005, 1e3, 0.0, 100.0, {}});
      Heard with = heard(turn % 4, model, how);
      how.sensors = with.sensors;
      CAPTURE(turn);
      Loop loop(model, *controller, how, with.estimator.get());
      keep_promise(loop, test_periods());
      ++turn;
    }
  }
}

TEST_SUITE_BEGIN("promise");

TEST_CASE("one section") {
  keep_promises(upright(1));
}
TEST_CASE("three sections") {
  keep_promises(upright(3));
}
TEST_CASE("eight sections") {
  keep_promises(hanging(8));
}
TEST_CASE("three sections by length") {
  keep_promises(by_length(3));
}
TEST_CASE("rods") {
  keep_promises(limber());
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
