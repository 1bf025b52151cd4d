// Control of the tip's position and orientation: accelerations as chosen, poses reached, what is
// left free.
#include <doctest/doctest.h>

#include <cmath>

#include "base/rotation.hpp"
#include "cdcr/cdcr.hpp"
#include "support/allocations.hpp"
#include "support/controlled_robots.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

/// Accelerations of the tip by differences of its Jacobian, of the reference by those of rotations.
constexpr double by_differences = 1e-6;
/// The pose at the end of a run, [m] and [rad], long after the slowest part of the motion.
constexpr double reached = 1e-7;

using Vector6 = Eigen::Matrix<double, 6, 1>;

TaskSpaceOptions oriented(double weight) {
  TaskSpaceOptions options;
  options.orientation_weight = VectorXd::Constant(1, weight);
  options.limits.tension.min_tension = -1e3;  // any force
  options.damping = 1e-5;
  return options;
}

VectorXd pose_at(const Model& model, const VectorXd& q) {
  const Pose at = tip(model, q);
  VectorXd value(6);
  value << at.p, detail::rotation_vector(at.R);
  return value;
}

/// Position and, in the base frame, the rotation from the tip to the pose.
Vector6 error_of(const Model& model, const VectorXd& q, const VectorXd& wanted) {
  const Pose at = tip(model, q);
  const Matrix3d R = detail::rotation_of(Vector3d(wanted.tail<3>()));
  Vector6 error;
  error << wanted.head<3>() - at.p, detail::rotation_vector(R * at.R.transpose());
  return error;
}

/// Turning rate of a rotation that changes: the axial vector of R' R^T, by differences.
template <class Function>
Vector3d turning_rate(const Function& rotation, double t) {
  constexpr double h = 1e-3;
  const auto slope = [&](double step) -> Matrix3d {
    return (rotation(t + step) - rotation(t - step)) / (2.0 * step);
  };
  const Matrix3d rate = (4.0 * slope(h) - slope(2.0 * h)) / 3.0;
  const Matrix3d w = rate * rotation(t).transpose();
  return 0.5 * Vector3d(w(2, 1) - w(1, 2), w(0, 2) - w(2, 0), w(1, 0) - w(0, 1));
}

VectorXd bent(Index d, double size) {
  VectorXd q(d);
  for (Index i = 0; i < d; ++i) q[i] = size * std::sin(1.0 + 2.0 * static_cast<double>(i));
  return q;
}

TEST_SUITE_BEGIN("pose_control");

TEST_CASE("the tip accelerates and turns as reference, gains and errors say") {
  const Model model(upright(3));
  TaskSpaceOptions options = oriented(0.3);
  options.lead = 0.0;
  options.kp = (VectorXd(6) << 90.0, 100.0, 110.0, 60.0, 70.0, 80.0).finished();
  TaskSpace controller(model, options);
  CHECK(residual(controller.path().coefficients().col(0), pose_at(model, model.rest())) <= 1e-14);
  const VectorXd q = bent(6, 0.7), qd = bent(6, -1.1);
  VectorXd there = pose_at(model, q);
  there.head<3>() *= 0.9;
  const Vector3d times(0.0, 0.5, 1.0);
  // Through a small rotation vector, where series take over, and a large one.
  for (const double size : {1.0, 0.01}) {
    CAPTURE(size);
    MatrixXd points(3, 6);
    points.row(0) = there.transpose();
    points.row(1) = size * there.transpose();
    points.row(2) << 0.1, 0.0, 0.9, 0.3, -0.2, 0.5;
    const ReferencePath path = ReferencePath::spline(times, points);
    controller.set_path(path);
    const double t = size == 1.0 ? 0.3 : 0.49;
    Setpoint wanted(6);
    const auto rotation = [&](double time) {
      path.evaluate(time, wanted);
      return detail::rotation_of(Vector3d(wanted.value.tail<3>()));
    };
    const auto rate = [&](double time) { return turning_rate(rotation, time); };
    constexpr double h = 1e-3;
    const Vector3d turning_second =
        (8.0 * (rate(t + h) - rate(t - h)) - (rate(t + 2 * h) - rate(t - 2 * h))) / (12.0 * h);
    Vector6 second, first;
    path.evaluate(t, wanted);
    second << wanted.acceleration.head<3>(), turning_second;
    first << wanted.rate.head<3>(), rate(t);
    path.evaluate(t, wanted);

    VectorXd tension(model.num_cables()), qdd(6);
    REQUIRE(controller.update(t, q, qd, tension) == Status::ok);
    Data data(model);
    forward_dynamics(model, data, q, qd, tension, qdd);
    MatrixXd J(6, 6), before(6, 6), after(6, 6);
    tip_jacobian(model, q, J);
    tip_jacobian(model, q - h * 0.1 * qd, before);
    tip_jacobian(model, q + h * 0.1 * qd, after);
    const VectorXd found = J * qdd + (after - before) * qd / (0.2 * h);
    const Vector6 error = error_of(model, q, wanted.value);
    const VectorXd expected =
        second + 20.0 * (first - J * qd) + options.kp.values().col(0).cwiseProduct(VectorXd(error));
    CHECK(residual(found.head<3>(), expected.head<3>()) <= by_differences);
    CHECK(residual(found.tail<3>(), expected.tail<3>()) <= by_differences);
  }
}

TEST_CASE("three sections reach a pose, at once or along a table of poses, and errors die away") {
  const Model model(upright(3));
  const VectorXd goal = bent(6, 0.6), zero = VectorXd::Zero(6);
  const VectorXd q0 = goal + 0.05 * bent(6, 1.0).reverse(), wanted = pose_at(model, goal);
  TaskSpace controller(model, oriented(0.3));
  controller.set_reference(wanted);
  const auto motion = [&](const VectorXd& times) {
    const Trajectory found =
        simulate(model, q0, zero, times, controller, Method::dopri5, tolerances(1e-9, 1e-12));
    REQUIRE(found.status == Status::ok);
    return found;
  };
  // e = e_0 (1 + w t) exp(-w t) of a critically damped error, of small rotations as of positions.
  const VectorXd times = even_times(0.0, 3.0, 31);
  const Trajectory found = motion(times);
  const Vector6 first = error_of(model, q0, wanted);
  for (Index i = 0; i <= 10; ++i) {
    const double wt = 10.0 * times[i];
    const Vector6 left = (1.0 + wt) * std::exp(-wt) * first;
    const Vector6 error = error_of(model, found.q.row(i).transpose(), wanted);
    CHECK(residual(error.head<3>(), left.head<3>(), first.head<3>().norm()) <= 2e-4);
    CHECK(residual(error.tail<3>(), left.tail<3>(), first.tail<3>().norm()) <= 1e-2);
  }
  CHECK(error_of(model, found.q.row(30).transpose(), wanted).lpNorm<Eigen::Infinity>() <= reached);

  MatrixXd poses(3, 6);
  poses.row(0) = pose_at(model, q0).transpose();
  poses.row(1) = pose_at(model, 0.5 * (q0 + goal)).transpose();
  poses.row(2) = wanted.transpose();
  controller.set_path(ReferencePath::spline(Vector3d(0.0, 0.4, 1.0), poses));
  const Trajectory along = motion(even_times(0.0, 2.5, 26));
  Setpoint at(6);
  for (Index i = 0; i < along.t.size(); ++i) {
    controller.path().evaluate(along.t[i], at);
    CHECK(error_of(model, along.q.row(i).transpose(), at.value).lpNorm<Eigen::Infinity>() <= 1e-4);
  }
}

TEST_CASE(
    "what a pose leaves free goes to the posture: four sections, and a free turn of the tip") {
  const auto end_of = [](const Model& model, const TaskSpaceOptions& options, const VectorXd& q0,
                         const VectorXd& wanted) {
    TaskSpace controller(model, options);
    controller.set_reference(wanted);
    const Trajectory found = simulate(model, q0, VectorXd::Zero(q0.size()), even_times(0.0, 5.0, 2),
                                      controller, Method::dopri5, tolerances(1e-8, 1e-11));
    REQUIRE(found.status == Status::ok);
    return VectorXd(found.q.row(1).transpose());
  };
  const Model four(upright(4));
  const VectorXd goal = bent(8, 0.5), wanted = pose_at(four, goal);
  TaskSpaceOptions options = oriented(0.3);
  options.posture = goal;
  const VectorXd near_goal = end_of(four, options, goal, wanted);
  CHECK((near_goal - goal).norm() <= reached);
  options.posture = goal + 0.4 * bent(8, 1.0).reverse();
  const VectorXd beside = end_of(four, options, goal, wanted);
  CHECK((beside - goal).norm() >= 0.05);
  CHECK((beside - options.posture).norm() <= (goal - options.posture).norm());
  CHECK(error_of(four, beside, wanted).lpNorm<Eigen::Infinity>() <= reached);

  // The same pose but for the turn about the tip's own axis, where that costs nothing.
  const Model three(upright(3));
  const VectorXd shape = bent(6, 0.6), pose_there = pose_at(three, shape);
  options = oriented(0.3);
  options.orientation_weight = Vector3d(0.3, 0.3, 0.0);
  options.posture = shape + 0.4 * bent(6, 1.0).reverse();
  const VectorXd rolled = end_of(three, options, shape, pose_there);
  Vector6 left = error_of(three, rolled, pose_there);
  left.tail<3>() = (tip(three, rolled).R.transpose() * left.tail<3>()).eval();
  CHECK(std::abs(left[5]) >= 0.01);
  CHECK(left.head<5>().lpNorm<Eigen::Infinity>() <= reached);
}

TEST_CASE("where coordinates are few the pose is met as well as may be, and nothing is allocated") {
  for (const NamedRobot& sample : controlled_robots()) {
    CAPTURE(sample.name);
    const Model model(sample.robot);
    TaskSpaceOptions options;
    options.orientation_weight = VectorXd::Constant(1, 0.2);
    TaskSpace controller(model, options);
    VectorXd wanted = pose_at(model, model.rest());
    wanted[0] += 0.03;
    wanted[2] -= 0.04;
    wanted.tail<3>() = detail::rotation_vector(tip(model, model.rest()).R *
                                               detail::rotation_of(Vector3d(0.0, 0.3, 0.0)));
    controller.set_reference(wanted);
    const VectorXd zero = VectorXd::Zero(model.num_coordinates());
    VectorXd command(model.num_cables());
    Status status = Status::not_started;
    CHECK(allocations_of([&] { status = controller.update(0.0, model.rest(), zero, command); }) ==
          0);
    CHECK(status == Status::ok);
    const double squared = 0.05 * 0.05 + 0.2 * 0.2 * 0.3 * 0.3;
    CHECK(residual(controller.diagnostics().error, std::sqrt(squared)) <= 1e-12);
  }
}

TEST_CASE("weights, gains and poses that do not fit are refused in a sentence") {
  const Model model(upright(1));
  TaskSpaceOptions options;
  options.orientation_weight = Eigen::Vector2d(1.0, 1.0);
  CHECK_THROWS_SENTENCE(TaskSpace(model, options),
                        "orientation_weight must be one number or three [m/rad], got 2");
  options.orientation_weight = Vector3d(1.0, -1.0, 1.0);
  CHECK_THROWS_SENTENCE(TaskSpace(model, options),
                        "orientation_weight must be >= 0 m/rad and finite, got -1");
  options.orientation_weight = VectorXd::Ones(1);
  options.kp = Vector3d::Ones();
  CHECK_THROWS_SENTENCE(TaskSpace(model, options),
                        "kp must be a number, 6 numbers or a matrix of 6 by 6, got 3 by 1");
  options.kp = 1.0;
  TaskSpace controller(model, options);
  CHECK_THROWS_SENTENCE(controller.set_reference(Vector3d::Zero()),
                        "reference must be 6 finite values, a position [m] and a rotation vector "
                        "[rad], got [0 0 0]");
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
