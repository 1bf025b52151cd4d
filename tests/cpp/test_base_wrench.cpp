// What the robot does to its base: against the momentum of its elements, at rest, in loops.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "cdcr/cdcr.hpp"
#include "support/allocations.hpp"
#include "support/cable_robots.hpp"
#include "support/controlled_robots.hpp"
#include "support/element_sum.hpp"
#include "support/residual.hpp"

namespace cdcr::test {
namespace {

/// Second differences of places in steps that turn the tip by some 0.01 rad; rods have their mass
/// at seven nodes.
constexpr double by_differences = 1e-8, of_rods = 1e-6;
/// Forces of friction and play, found again from rates that a fine simulation reaches.
constexpr double by_simulation = 1.6e-2;

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// f'' at 0, by differences of eighth order.
template <class Function>
auto second_difference(const Function& f, double h) {
  using Value = decltype(f(h));
  Value sum = f(0.0) * (-205.0 / 72.0);
  sum += (f(h) + f(-h)) * (8.0 / 5.0);
  sum -= (f(2 * h) + f(-2 * h)) * (1.0 / 5.0);
  sum += (f(3 * h) + f(-3 * h)) * (8.0 / 315.0);
  sum -= (f(4 * h) + f(-4 * h)) * (1.0 / 560.0);
  return Value(sum / (h * h));
}

/// The weight less the rate of momentum of everything that has mass, from where it is alone.
class MomentumSum {
 public:
  MomentumSum(const Model& model, const VectorXd& q, const VectorXd& qd, const VectorXd& qdd)
      : model_(model), q_(q), qd_(qd), qdd_(qdd) {
    const Robot& robot = model.robot();
    const double fastest = qd.lpNorm<Eigen::Infinity>() + std::sqrt(qdd.lpNorm<Eigen::Infinity>());
    h_ = 0.01 / (1.0 + fastest);
    for (Index i = 0; i < model.num_sections(); ++i) {
      const Section& s = robot.sections[static_cast<std::size_t>(i)];
      for (const Disk& disk : s.disks()) add_disk(i, disk.position, disk.mass, disk.diameter);
      for (std::size_t k = 0; k < num_gauss; ++k) {
        add_disk(i, static_cast<double>(gauss().node[k]),
                 static_cast<double>(gauss().weight[k]) * s.backbone_mass, s.backbone_diameter);
      }
    }
    add(model.num_sections() - 1, 1.0, robot.payload, robot.payload_position,
        robot.payload_inertia);
  }

  [[nodiscard]] const Vector6& wrench() const { return wrench_; }

 private:
  void add_disk(Index section, double fraction, double mass, double diameter) {
    const double transverse = mass * diameter * diameter / 16.0;
    add(section, fraction, mass, Vector3d::Zero(),
        Vector3d(transverse, transverse, 2.0 * transverse).asDiagonal());
  }

  /// Inertia about the centre of mass at `offset`, in the frame of the backbone.
  void add(Index section, double fraction, double mass, const Vector3d& offset,
           const Matrix3d& inertia) {
    const auto at = [&](double t) {
      const VectorXd q = q_ + t * qd_ + 0.5 * t * t * qdd_;
      Pose frame = pose(model_, q, section, fraction);
      Eigen::Matrix<double, 3, 4> all;
      all << frame.p + frame.R * offset, frame.R;
      return all;
    };
    const Eigen::Matrix<double, 3, 4> now = at(0.0), second = second_difference(at, h_);
    const Vector3d force = mass * (model_.robot().gravity - second.col(0));
    // With the second moments J of mass, d/dt of (R' J R^T - R J R'^T), which is L as a matrix.
    const Matrix3d J = 0.5 * inertia.trace() * Matrix3d::Identity() - inertia;
    const Matrix3d turning = second.rightCols<3>() * J * now.rightCols<3>().transpose();
    const Matrix3d spin = turning - turning.transpose();
    const Vector3d place = now.col(0) - model_.robot().base_position;
    wrench_.head<3>() += force;
    wrench_.tail<3>() += place.cross(force) - Vector3d(spin(2, 1), spin(0, 2), spin(1, 0));
  }

  const Model& model_;
  VectorXd q_, qd_, qdd_;
  double h_;
  Vector6 wrench_ = Vector6::Zero();
};

/// All that a base can bring: it stands elsewhere and aslant, and the payload is beside the tip.
Robot aslant(Robot robot) {
  robot.base_position = {0.4, -0.2, 1.0};
  robot.base_orientation =
      Eigen::AngleAxisd(0.7, Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  robot.payload = 0.05;
  robot.payload_position = {0.01, -0.02, 0.03};
  robot.payload_inertia = Vector3d(2e-5, 3e-5, 4e-5).asDiagonal();
  return robot;
}

std::vector<NamedRobot> all_kinds() {
  Robot rods = slender(), metal;
  metal.sections = {rod_section(1, 0, 0), rod_section(0, locked, locked)};
  metal.gravity = {0.0, 0.0, -9.81};
  return {{"one section", upright(1)},
          {"one with a payload", aslant(upright(1))},
          {"three sections", aslant(upright(3))},
          {"rods", aslant(rods)},
          {"rods that twist and stretch", aslant(metal)}};
}

VectorXd on_base(const Model& model, const VectorXd& q, const VectorXd& qd, const VectorXd& qdd,
                 const Wrenches& wrenches = {}) {
  VectorXd found(6);
  CHECK(allocations_of([&] { base_wrench(model, q, qd, qdd, wrenches, found); }) == 0);
  return found;
}

TEST_SUITE_BEGIN("base_wrench");

TEST_CASE("weight and rate of momentum, summed over the elements") {
  for (const NamedRobot& sample : all_kinds()) {
    CAPTURE(sample.name);
    const Model model(sample.robot);
    Random random;
    INFO(random);
    for (int round = 0; round < 4; ++round) {
      RodState state(model, 0.7, random);
      VectorXd qdd = 3.0 * random.vector(model.num_coordinates(), 10.0);
      if (model.has_rods()) qdd *= 0.01;
      if (round == 0) state.qd.setZero();
      const VectorXd found = on_base(model, state.q, state.qd, qdd);
      const MomentumSum sum(model, state.q, state.qd, qdd);
      const double allowed = model.has_rods() ? of_rods : by_differences;
      CHECK(residual(found.head<3>(), sum.wrench().head<3>()) <= allowed);
      CHECK(residual(found.tail<3>(), sum.wrench().tail<3>()) <= allowed);
    }
  }
}

TEST_CASE("at rest the base bears the weight and the wrenches, wherever cables pull") {
  Random random;
  INFO(random);
  const Model model(aslant(upright(3)));
  double mass = model.robot().payload;
  for (const Section& s : model.robot().sections) {
    mass += s.backbone_mass;
    for (const Disk& disk : s.disks()) mass += disk.mass;
  }
  const VectorXd q = random.vector(6, 0.5), zero = VectorXd::Zero(6);
  const Wrenches wrenches = random_wrenches(model, 3, random);
  const VectorXd found = on_base(model, q, zero, zero, wrenches);
  VectorXd wanted = on_base(model, q, zero, zero);
  CHECK(residual(wanted.head<3>(), Vector3d(mass * model.robot().gravity)) <= 1e-13);
  for (const Wrench& one : wrenches) {
    const Pose at = pose(model, q, one.section, one.fraction);
    const Matrix3d turn = one.frame == Wrench::Frame::local ? at.R : Matrix3d::Identity();
    const Vector3d force = turn * one.force, arm = at.p - model.robot().base_position;
    wanted.head<3>() += force;
    wanted.tail<3>() += arm.cross(force) + turn * one.moment;
  }
  CHECK(residual(found, wanted) <= 1e-13);
}

/// Tells a sensor that is asked for each step of a loop.
VectorXd told(const Loop& loop, std::size_t sensor) {
  return loop.sensors()[sensor].value();
}

TEST_CASE("sensors in a loop feel what the plant does, with friction that remembers and play") {
  Robot robot = parts_with_cables(2, 0.0, 0.0);
  robot.presliding_stiffness = 1e4;
  for (Section& section : robot.sections) {
    section.cable_friction = 0.5;
    section.damping = 0.02;
  }
  const Model model(robot);
  REQUIRE(model.num_deflections() > 0);
  const double step = 1e-4;
  PidOptions gains;
  gains.period = step;
  gains.kp = 1.0;
  gains.kd = 0.02;
  Pid pid(model, gains);
  pid.set_reference(VectorXd::Constant(4, 0.3));
  LoopOptions how;
  how.step = step;
  how.actuators.assign(1, {0.05, 0.0, 0.0, 1e6, 0.0, 100.0, {}});
  how.sensors.resize(2);
  how.sensors[0].kind = Sensor::Kind::base_force;
  how.sensors[1].kind = Sensor::Kind::base_moment;
  how.sensors[1].bias = 0.5;
  Loop loop(model, pid, how);
  const VectorXd zero = VectorXd::Zero(4);
  Wrenches push(1);
  push[0] = {1, 1.0, {0.1, 0.0, 0.0}};
  loop.reset(zero, zero);
  VectorXd q[3], qd[3], qdd(4);
  Data data(model);
  double largest_miss = 0.0;
  for (int k = 0; k < 1000; ++k) {
    for (int i = 0; i < 2; ++i) {
      q[i] = q[i + 1];
      qd[i] = qd[i + 1];
    }
    q[2] = loop.q();
    qd[2] = loop.qd();
    if (k < 200 || k % 100 != 0) {
      REQUIRE(loop.step(push) == Status::ok);
      continue;
    }
    // The middle of three states: what was told of it, and its acceleration by differences.
    const VectorXd force = told(loop, 0), moment = told(loop, 1).array() - 0.5;
    const VectorXd wanted = on_base(model, q[1], qd[1], (qd[2] - qd[0]) / (2.0 * step), push);
    CAPTURE(k);
    CHECK(residual(force, wanted.head<3>()) <= by_simulation);
    CHECK(residual(moment, wanted.tail<3>()) <= by_simulation);
    // A law of friction that forgets would be heard.
    forward_dynamics(model, data, q[1], qd[1], loop.given(), push, qdd);
    const VectorXd forgetful = on_base(model, q[1], qd[1], qdd, push);
    const double miss = residual(force, forgetful.head<3>()).value;
    largest_miss = std::fmax(largest_miss, miss);
    REQUIRE(loop.step(push) == Status::ok);
  }
  CHECK(largest_miss > 1.5 * by_simulation);
  push[0].force[0] = std::nan("");
  CHECK(loop.step(push) == Status::invalid_wrench);
}

TEST_CASE("a push on the tip is found from what the base feels, its pull along the robot too") {
  const Model model(upright(3));
  KalmanOptions options;
  options.acceleration_noise[0] = 0.1;
  options.force_at = Place{2, 1.0};
  options.force_noise = 0.1;
  options.sensors.resize(3);
  options.sensors[0].kind = Sensor::Kind::lengths;
  options.sensors[0].noise = 1e-5;
  options.sensors[1].kind = Sensor::Kind::base_force;
  options.sensors[1].noise = 0.02;
  options.sensors[2].kind = Sensor::Kind::base_moment;
  options.sensors[2].noise = 0.01;
  Wrenches push(1);
  push[0] = {2, 1.0, {0.15, -0.1, 0.2}};
  ComputedTorqueOptions gentle;
  gentle.kp = 25.0;
  gentle.kd = 10.0;
  gentle.limits.tension.min_tension = 0.5;
  ComputedTorque controller(model, gentle);
  LoopOptions how;
  how.sensors = options.sensors;
  const auto check = [&](auto filter) {
    Loop loop(model, controller, how, &filter);
    loop.reset(model.rest(), VectorXd::Zero(6));
    Status status = Status::ok;
    CHECK(allocations_of([&] {
            for (int k = 0; k < 1000; ++k) status = loop.step(push);
          }) == 0);
    REQUIRE(status == Status::ok);
    VectorXd found(3), deviations(3);
    filter.write_values(found, deviations);
    CAPTURE(found.transpose());
    CAPTURE(deviations.transpose());
    // Along the robot too, where cables tell next to nothing.
    CHECK((found - push[0].force).norm() <= 0.1 * push[0].force.norm());
    CHECK(((found - push[0].force).cwiseAbs().array() <= 4.0 * deviations.array()).all());
  };
  check(ExtendedKalman(model, options));
  check(UnscentedKalman(model, options));
}

TEST_CASE("force and moment are heard at one state: which comes first changes nothing") {
  const Model model(upright(3));
  const VectorXd zero = VectorXd::Zero(6), start = VectorXd::Constant(6, 0.1);
  const VectorXd command = VectorXd::Constant(9, 2.0);
  VectorXd wrench(6), q(6), qd(6), first(12);
  base_wrench(model, start, zero, zero, {}, wrench);
  for (const bool moment_first : {false, true}) {
    KalmanOptions options;
    options.deviation = 0.1;
    options.rate_deviation = 1.0;
    options.sensors.resize(2);
    options.sensors[0].noise = options.sensors[1].noise = 0.01;
    options.sensors[moment_first ? 1 : 0].kind = Sensor::Kind::base_force;
    options.sensors[moment_first ? 0 : 1].kind = Sensor::Kind::base_moment;
    ExtendedKalman filter(model, options);
    filter.reset(zero, zero, command);
    std::vector<Measurement> told{{wrench.head<3>(), true}, {wrench.tail<3>(), true}};
    if (moment_first) std::swap(told[0], told[1]);
    for (int k = 0; k < 3; ++k) {
      REQUIRE(filter.update(1e-3 * k, told, command, q, qd) == Status::ok);
    }
    VectorXd found(12);
    found << q, qd;
    if (moment_first) CHECK(residual(found, first) <= 1e-9);
    first = found;
    CHECK(found.norm() > 0.1);
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
