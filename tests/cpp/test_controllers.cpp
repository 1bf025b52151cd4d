// Controllers with a model: what their errors do in closed form, what limits do to them.
#include <doctest/doctest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <memory>

#include "cdcr/cdcr.hpp"
#include "support/allocations.hpp"
#include "support/controlled_robots.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

namespace tolerance {
/// Commands held for 0.1 ms, their middle reckoned with, against commands that never rest.
constexpr double held = 1e-5;
/// The same of rods, whose backbone swings beside its cables within a period.
constexpr double held_rods = 1e-2;
}  // namespace tolerance

CommandLimits from_pretension(double pretension) {
  CommandLimits limits;
  limits.tension.min_tension = pretension;
  return limits;
}

/// One of each kind, for that model.
std::vector<std::unique_ptr<TrackingController>> all_controllers(const Model& model,
                                                                 const CommandLimits& limits) {
  std::vector<std::unique_ptr<TrackingController>> found;
  PidOptions pid;
  pid.kp = 2.0;
  pid.ki = VectorXd::Constant(model.num_coordinates(), 1.0);
  pid.kd = MatrixXd::Identity(model.num_coordinates(), model.num_coordinates()) * 0.1;
  pid.limits = limits.tension;
  pid.max_rate = limits.max_rate;
  pid.filter = 2e-3;
  found.push_back(std::make_unique<Pid>(model, pid));
  ComputedTorqueOptions torque;
  torque.limits = limits;
  torque.lead = 0.0;  // so that tensions are those at the state given
  found.push_back(std::make_unique<ComputedTorque>(model, torque));
  StateFeedbackOptions feedback;
  feedback.gain = MatrixXd::Ones(model.num_cables(), 2 * model.num_coordinates());
  feedback.limits = limits;
  found.push_back(std::make_unique<StateFeedback>(model, feedback));
  TaskSpaceOptions task;
  task.limits = limits;
  task.lead = 0.0;
  found.push_back(std::make_unique<TaskSpace>(model, task));
  return found;
}

Trajectory run(const Model& model, Controller& controller, const VectorXd& q0, double duration,
               Index count = 101) {
  return simulate(model, q0, VectorXd::Zero(q0.size()), even_times(0.0, duration, count),
                  controller, Method::dopri5, tolerances(1e-10, 1e-13));
}

TEST_SUITE_BEGIN("controllers");

TEST_CASE("updates allocate nothing, keep the limits and refuse what is no state") {
  Random random;
  INFO(random);
  for (const NamedRobot& sample : controlled_robots()) {
    CAPTURE(sample.name);
    const Model model(sample.robot);
    const Index d = model.num_coordinates(), c = model.num_cables();
    CommandLimits limits = from_pretension(0.3);
    limits.tension.max_tension = 8.0;
    for (const auto& controller : all_controllers(model, limits)) {
      VectorXd command = VectorXd::Zero(c), tension(c);
      for (int round = 0; round < 20; ++round) {
        const VectorXd q = random.vector(d, 0.05), qd = random.vector(d, 0.2);
        Status status = Status::not_started;
        CHECK(allocations_of([&] { status = controller->update(0.1, q, qd, command); }) == 0);
        REQUIRE(status == Status::ok);
        CHECK(check_tension(model, command) == Status::ok);
        cable_tensions(model, q, qd, command, tension);
        CHECK(tension.minCoeff() >= 0.3 - 1e-8);
        CHECK(tension.maxCoeff() <= 8.0 + 1e-8);
      }
      const VectorXd before = command;
      const VectorXd bad = VectorXd::Constant(d, nan), good = VectorXd::Zero(d);
      CHECK(controller->update(0.1, bad, good, command) == Status::non_finite_state);
      CHECK(controller->update(0.1, good, bad, command) == Status::non_finite_state);
      CHECK(controller->update(0.1, VectorXd::Zero(1), good, command) == Status::wrong_size);
      CHECK(command == before);
      CHECK(controller->diagnostics().updates == 22);
      CHECK(controller->diagnostics().duration > 0.0);
      CHECK(allocations_of([&] { controller->reset(); }) == 0);
      CHECK(controller->diagnostics().updates == 0);
    }
  }
}

TEST_CASE("commands change no faster than the limit of their rate, of tensions and of lengths") {
  Random random;
  INFO(random);
  for (const NamedRobot& sample : controlled_robots()) {
    CAPTURE(sample.name);
    const Model model(sample.robot);
    CommandLimits limits;
    limits.max_rate = 20.0;
    for (const auto& controller : all_controllers(model, limits)) {
      VectorXd last, command(model.num_cables());
      for (int round = 0; round < 20; ++round) {
        const VectorXd q = random.vector(model.num_coordinates(), 0.1);
        REQUIRE(controller->update(0.0, q, VectorXd::Zero(q.size()), command) == Status::ok);
        if (round > 0) CHECK((command - last).lpNorm<Eigen::Infinity>() <= 20.0 * 1e-3 + 1e-12);
        last = command;
      }
    }
  }
}

TEST_CASE("computed torque: errors die away as chosen, of arcs one by one, of rods in lengths") {
  // e = e_0 (1 + w t) exp(-w t) for kp = w^2, kd = 2 w.
  const double w = 8.0;
  for (const NamedRobot& sample : controlled_robots()) {
    if (sample.name == "by length" || sample.name == "rods, cables of all kinds") continue;
    CAPTURE(sample.name);
    const Model model(sample.robot);
    ComputedTorqueOptions options;
    options.kp = w * w;
    options.kd = 2.0 * w;
    options.period = 1e-4;
    options.limits = from_pretension(-1e3);
    ComputedTorque controller(model, options);
    VectorXd q0 = VectorXd::Zero(model.num_coordinates());
    for (Index i = 0; i < q0.size(); i += 2) q0[i] = 0.02;
    const VectorXd y0 = model.actuation_matrix().transpose() * q0;
    const Trajectory found = run(model, controller, q0, 0.3, 4);
    REQUIRE(found.status == Status::ok);
    for (Index i = 1; i < found.t.size(); ++i) {
      const double left = (1.0 + w * found.t[i]) * std::exp(-w * found.t[i]);
      const VectorXd y = model.actuation_matrix().transpose() * found.q.row(i).transpose();
      CHECK(residual(y, left * y0, y0.norm()) <=
            (model.has_rods() ? tolerance::held_rods : tolerance::held));
    }
  }
}

TEST_CASE("computed torque keeps the paper's circle to a microradian") {
  const Model model(amouri2020());
  ComputedTorque controller(model);
  const double theta = pi / 12.0;
  controller.set_path(ReferencePath::circle(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(theta, 0.0),
                                            Eigen::Vector2d(0.0, theta), 1.0, 10.0, false));
  const Eigen::Vector2d q0(theta, 0.0), qd0(0.0, theta * pi / 5.0);
  const Trajectory found = simulate(model, q0, qd0, even_times(0.0, 10.0, 201), controller,
                                    Method::dopri5, tolerances(1e-10, 1e-12));
  REQUIRE(found.status == Status::ok);
  double worst = 0.0;
  Setpoint wanted(2);
  for (Index i = 0; i < found.t.size(); ++i) {
    controller.path().evaluate(found.t[i], wanted);
    worst = std::fmax(worst, (found.q.row(i).transpose() - wanted.value).norm());
  }
  MESSAGE("largest error on the circle: ", worst, " rad");
  CHECK(worst <= 1e-6);
}

/// State from one period to the next under a held command, by the series of the exponential.
std::pair<MatrixXd, MatrixXd> held(const MatrixXd& A, const MatrixXd& B, double period) {
  const Index n = A.rows(), m = B.cols();
  MatrixXd whole = MatrixXd::Zero(n + m, n + m);
  whole.topLeftCorner(n, n) = A * (period / 1024.0);
  whole.topRightCorner(n, m) = B * (period / 1024.0);
  MatrixXd term = MatrixXd::Identity(n + m, n + m), sum = term;
  for (int k = 1; k < 12; ++k) {
    term = (term * whole / k).eval();
    sum += term;
  }
  for (int k = 0; k < 10; ++k) sum = (sum * sum).eval();
  return {sum.topLeftCorner(n, n), sum.topRightCorner(n, m)};
}

TEST_CASE("step responses are those of the sampled linear loop") {
  const Model model(upright(2));
  Data data(model);
  const Index d = 4, c = 6;
  const VectorXd rest = VectorXd::Zero(d), pull = VectorXd::Constant(c, 5.0);
  MatrixXd A(2 * d, 2 * d), B(2 * d, c);
  linearize(model, data, rest, rest, pull, A, B);
  const double period = 5e-3, step = 1e-5;
  const auto [Ad, Bd] = held(A, B, period);
  const MatrixXd pinv = model.actuation_matrix().completeOrthogonalDecomposition().pseudoInverse();

  // Both laws in the form u = pull - K (x - x_ref), x_ref = (step, .., 0, ..).
  PidOptions gains;
  gains.kp = 0.8;
  gains.kd = 0.02;
  gains.period = period;
  gains.feed_forward = false;
  gains.limits.min_tension = -1e3;
  Pid pid(model, gains);
  MatrixXd K(c, 2 * d);
  K << 0.8 * pinv, 0.02 * pinv;
  StateFeedbackOptions options;
  options.gain = K;
  options.command = pull;
  options.period = period;
  StateFeedback feedback(model, options);
  const VectorXd reference = VectorXd::Constant(d, step);
  for (TrackingController* controller :
       std::initializer_list<TrackingController*>{&pid, &feedback}) {
    controller->set_reference(reference);
    const Trajectory found = run(model, *controller, rest, 40 * period, 41);
    REQUIRE(found.status == Status::ok);
    VectorXd x = VectorXd::Zero(2 * d), goal = x;
    goal.head(d) = reference;
    for (Index i = 0; i < found.t.size(); ++i) {
      CHECK(residual(found.q.row(i).transpose(), x.head(d), step) <= 1e-6);
      x = (Ad * x - Bd * K * (x - goal)).eval();
    }
    CHECK(x.head(d).norm() > 0.1 * step);
  }
}

TEST_CASE("anti-windup knows limits of rate: it comes back sooner than an integral that grew") {
  const Model model(upright(1, 0.1));
  const Eigen::Vector2d reference(0.15, 0.0), rest(0.0, 0.0);
  double after[2];
  for (const bool anti_windup : {false, true}) {
    PidOptions options;
    options.kp = 0.5;
    options.ki = 4.0;
    options.period = 1e-2;
    options.feed_forward = false;
    options.anti_windup = anti_windup;
    options.max_rate = 0.5;
    Pid pid(model, options);
    pid.set_reference(reference);
    const Trajectory found = run(model, pid, rest, 20.0, 401);
    REQUIRE(found.status == Status::ok);
    after[anti_windup ? 1 : 0] = found.q.col(0).maxCoeff() / reference[0] - 1.0;
  }
  CAPTURE(after[0]);
  CAPTURE(after[1]);
  CHECK(after[0] > 0.2);
  CHECK(after[1] < 0.5 * after[0]);
}

TEST_CASE("task space: the tip follows a circle, and the posture goes where the tip lets it") {
  const Model model(upright(3));
  TaskSpaceOptions options;
  options.damping = 1e-3;
  options.limits = from_pretension(0.5);
  const Eigen::Matrix<double, 6, 1> q0 =
      (Eigen::Matrix<double, 6, 1>() << 0.5, 0.1, 0.3, -0.2, 0.4, 0.1).finished();
  const Vector3d from = tip(model, q0).p;
  const auto end_of = [&](const VectorXd& posture) {
    options.posture = posture;
    TaskSpace controller(model, options);
    const Vector3d center = from - Vector3d(0.03, 0.0, 0.0);
    controller.set_path(ReferencePath::circle(center, Vector3d(0.03, 0.0, 0.0),
                                              Vector3d(0.0, 0.03, 0.0), 1.0, 2.0));
    const Trajectory found = run(model, controller, q0, 4.0, 81);
    REQUIRE(found.status == Status::ok);
    double worst = 0.0;
    Setpoint wanted(3);
    for (Index i = 0; i < found.t.size(); ++i) {
      controller.path().evaluate(found.t[i], wanted);
      worst = std::fmax(worst, (tip(model, found.q.row(i).transpose()).p - wanted.value).norm());
    }
    CAPTURE(worst);
    CHECK(worst < 1e-3);
    return VectorXd(found.q.row(80).transpose());
  };
  const VectorXd bent = (VectorXd(6) << 1.0, 0.0, -0.5, 0.0, 0.5, 0.0).finished();
  const VectorXd near_start = end_of(q0), near_bent = end_of(bent);
  CHECK((near_bent - bent).norm() < 0.7 * (near_start - bent).norm());
}

/// A law of one's own: a spring towards the reference, in twenty lines.
class Spring final : public TrackingController {
 public:
  Spring(const Model& model, double gain)
      : TrackingController(model, 1e-2, from_pretension(0.2)),
        gain_(gain),
        force_(model.num_coordinates()) {}

 private:
  Status control(double /*t*/, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const Setpoint& wanted) noexcept override {
    force_ = gain_ * (wanted.value - q);
    note_error(force_.norm() / gain_);
    (void)give(q, qd, force_);
    return Status::ok;
  }

  double gain_;
  VectorXd force_;
};

TEST_CASE("a law of one's own has reference, limits and diagnostics from its base") {
  const Model model(upright(1, 0.1));
  Spring spring(model, 3.0);
  spring.set_reference(Eigen::Vector2d(0.2, 0.1));
  const Trajectory found = run(model, spring, Eigen::Vector2d(0.0, 0.0), 20.0, 3);
  REQUIRE(found.status == Status::ok);
  CHECK(found.tension.minCoeff() >= 0.2);
  // At rest the spring balances backbone and weight.
  Data data(model);
  VectorXd gradient(2);
  const VectorXd rest = found.q.row(2).transpose();
  potential_gradient(model, data, rest, gradient);
  CHECK(residual(3.0 * (Eigen::Vector2d(0.2, 0.1) - rest), gradient, 1.0) <= 1e-9);
  CHECK(spring.diagnostics().updates >= 2000);
  CHECK(residual(spring.diagnostics().error, (Eigen::Vector2d(0.2, 0.1) - rest).norm()) <= 1e-9);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
