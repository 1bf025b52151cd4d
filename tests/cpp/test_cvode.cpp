// Methods bdf and adams: accuracy, exact stops, failures, and the promises of cdcr/cvode.hpp.
#include "cdcr/cvode.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "cdcr/simulate.hpp"

// Counts what the program allocates, SUNDIALS included; left alone where a sanitizer does so.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#define CDCR_COUNTS_ALLOCATIONS
namespace {
long allocations = 0;
}
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}
}
#endif

namespace cdcr::test {
namespace {

// Largest error of q [rad] at rtol 1e-12 against Dormand-Prince at 1e-13: the errors of thousands
// of steps add up to a few hundred times rtol, more under a strong pull.
constexpr double tight_error = 2e-8;
// What the default tolerances must keep of step-tension over 10 s [rad], with a margin of three.
constexpr double default_error = 1e-6 / 3.0;

const std::vector<Method> methods = {Method::bdf, Method::adams};
const char* label(Method method) { return method == Method::bdf ? "bdf" : "adams"; }

Robot heavy_robot() {
  Robot robot = amouri2020();
  robot.gravity = {2.0, -1.0, -9.0};
  robot.payload = 0.01;
  robot.sections[0].damping = 2e-3;
  return robot;
}

TensionInput pull(double first, double second = 0.0) {
  return TensionInput::constant(Eigen::Vector3d(first, second, 0.0));
}

/// Tension of cable 1 as a function of time; the others are slack.
template <typename Function>
TensionInput pull_by(Function function) {
  return TensionInput::function(
      [function](double t, const ConstVectorRef& q, const ConstVectorRef&, VectorRef tension) {
        tension.setZero();
        tension[0] = function(t, q[0]);
      },
      3);
}

Options tolerances(double rtol) {
  Options options;
  options.rtol = rtol;
  options.atol = 0.01 * rtol;
  return options;
}

VectorXd state(double q_x, double q_y, double qd_x = 0.0, double qd_y = 0.0) {
  return Eigen::Vector4d(q_x, q_y, qd_x, qd_y);
}

Status run(Integrator& integrator, double t_stop) {
  Status status = Status::ok;
  while (status == Status::ok && integrator.time() < t_stop) status = integrator.step();
  return status;
}

Trajectory run(const Model& model, const TensionInput& input, const VectorXd& y,
               const VectorXd& times, Method method, const Options& options = {}) {
  return simulate(model, y.head(2), y.tail(2), times, input, method, options,
                  make_cvode_integrator);
}

Trajectory reference(const Model& model, const TensionInput& input, const VectorXd& y,
                     const VectorXd& times) {
  return run(model, input, y, times, Method::dopri5, tolerances(1e-13));
}

double distance(const Trajectory& a, const Trajectory& b) {
  REQUIRE(a.status == Status::ok);
  REQUIRE(b.status == Status::ok);
  REQUIRE(a.q.rows() == b.q.rows());
  return (a.q - b.q).rowwise().norm().maxCoeff();
}

/// What the process writes to stderr during its lifetime.
class CapturedErrors {
 public:
  CapturedErrors() {
    std::fflush(stderr);
    REQUIRE(dup2(fileno(file_), STDERR_FILENO) >= 0);
  }
  ~CapturedErrors() { restore(); }
  CapturedErrors(const CapturedErrors&) = delete;
  CapturedErrors& operator=(const CapturedErrors&) = delete;

  long size() {
    restore();
    std::fseek(file_, 0, SEEK_END);
    return std::ftell(file_);
  }

 private:
  void restore() {
    if (saved_ < 0) return;
    std::fflush(stderr);
    dup2(saved_, STDERR_FILENO);
    close(saved_);
    saved_ = -1;
  }
  std::FILE* file_ = std::tmpfile();
  int saved_ = dup(STDERR_FILENO);
};

TEST_CASE("agrees with Dormand-Prince under damping, gravity and tables with jumps") {
  const Model model(heavy_robot());
  const VectorXd times = VectorXd::LinSpaced(301, 0.0, 3.0);
  const VectorXd t = Eigen::Vector4d(0.3, 0.77, 1.0, 2.0);
  MatrixXd tension(4, 3);
  tension << 2.0, 0.0, 1.0, 0.0, 6.0, 0.5, 8.0, 0.0, 0.0, 0.0, 0.0, 3.0;
  for (const auto kind :
       {TensionInput::Interpolation::previous, TensionInput::Interpolation::linear}) {
    const TensionInput input = TensionInput::table(t, tension, kind);
    const VectorXd y = state(0.4, -0.3, 1.0, 2.0);
    const Trajectory truth = reference(model, input, y, times);
    for (const Method method : methods) {
      CAPTURE(label(method));
      const Trajectory run_ = run(model, input, y, times, method, tolerances(1e-12));
      CHECK(distance(run_, truth) <= tight_error);
      CHECK(run_.tension == truth.tension);
    }
  }
}

TEST_CASE("default tolerances keep step-tension within 1e-6 rad over 10 s") {
  const Model model(amouri2020());
  const VectorXd times = VectorXd::LinSpaced(10001, 0.0, 10.0);
  const Trajectory truth = reference(model, pull(5.0), state(0.0, 0.0), times);
  for (const Method method : methods) {
    CAPTURE(label(method));
    const Trajectory run_ = run(model, pull(5.0), state(0.0, 0.0), times, method);
    CHECK(distance(run_, truth) <= default_error);
  }
}

TEST_CASE("a tighter tolerance is a smaller error") {
  const Model model(amouri2020());
  const VectorXd times = VectorXd::LinSpaced(101, 0.0, 2.0);
  const VectorXd y = state(0.8, 0.0, 0.0, 3.0);
  const Trajectory truth = reference(model, pull(1.0, 2.0), y, times);
  for (const Method method : methods) {
    CAPTURE(label(method));
    double before = 1.0;
    for (const double rtol : {1e-5, 1e-7, 1e-9, 1e-11}) {
      CAPTURE(rtol);
      const double error =
          distance(run(model, pull(1.0, 2.0), y, times, method, tolerances(rtol)), truth);
      CHECK(error < 0.2 * before);
      before = error;
    }
  }
}

TEST_CASE("stops exactly where asked, however short the way") {
  const Model model(amouri2020());
  const TensionInput input = pull(5.0);
  Plant plant(model, input);
  for (const Method method : methods) {
    CAPTURE(label(method));
    const auto integrator = make_cvode_integrator(plant, method, {});
    double t = 0.1;
    VectorXd y = state(0.1, 0.2);
    for (const double length : {0.1, 1.0 / 3.0, 1e-6, 1e-9, 1e-12, 1e-15, 2e-3, 1e-16 + 0.7}) {
      CAPTURE(length);
      const double stop = std::max(t + length, std::nextafter(t, 1e9));
      REQUIRE(integrator->restart(t, y, stop) == Status::ok);
      CHECK(integrator->time() == t);
      CHECK(integrator->state() == y);
      REQUIRE(run(*integrator, stop) == Status::ok);
      CHECK(integrator->time() == stop);
      t = stop;
      y = integrator->state();
    }
  }
}

TEST_CASE("the output grid changes neither steps nor solution, bit for bit") {
  const Model model(heavy_robot());
  const VectorXd t = Eigen::Vector2d(0.25, 1.1);
  const MatrixXd tension = Eigen::Matrix<double, 2, 3>{{4.0, 0.0, 0.0}, {0.0, 5.0, 1.0}};
  const TensionInput input =
      TensionInput::table(t, tension, TensionInput::Interpolation::previous);
  for (const Method method : methods) {
    CAPTURE(label(method));
    const VectorXd y = state(0.0, 0.0);
    const Trajectory fine = run(model, input, y, VectorXd::LinSpaced(1025, 0.0, 2.0), method);
    for (const Index stride : {1024, 128, 4}) {
      const VectorXd times = VectorXd::LinSpaced(1024 / stride + 1, 0.0, 2.0);
      const Trajectory coarse = run(model, input, y, times, method);
      CHECK(coarse.stats.steps == fine.stats.steps);
      CHECK(coarse.stats.evaluations == fine.stats.evaluations);
      for (Index i = 0; i < coarse.t.size(); ++i) {
        REQUIRE(coarse.t[i] == fine.t[i * stride]);
        CHECK(coarse.q.row(i) == fine.q.row(i * stride));
        CHECK(coarse.qd.row(i) == fine.qd.row(i * stride));
      }
    }
  }
}

TEST_CASE("interpolates within the last step only, and its ends are the states") {
  const Model model(amouri2020());
  const TensionInput input = pull(5.0);
  Plant plant(model, input);
  for (const Method method : methods) {
    CAPTURE(label(method));
    const auto integrator = make_cvode_integrator(plant, method, {});
    VectorXd y = VectorXd::Zero(4);
    REQUIRE(integrator->restart(0.0, state(0.5, 0.0), 1.0) == Status::ok);
    integrator->interpolate(0.0, y);
    CHECK(y == state(0.5, 0.0));
    for (int i = 0; i < 200; ++i) REQUIRE(integrator->step() == Status::ok);
    const double before = integrator->time();
    const VectorXd start = integrator->state();
    REQUIRE(integrator->step() == Status::ok);
    integrator->interpolate(before, y);
    CHECK((y.head(2) - start.head(2)).norm() <= 1e-10);  // smooth to the tolerance
    integrator->interpolate(integrator->time(), y);
    CHECK(y == integrator->state());
    CHECK_THROWS_AS(integrator->interpolate(integrator->time() + 0.1, y), std::invalid_argument);
    CHECK_THROWS_AS(integrator->interpolate(0.0, y), std::invalid_argument);
  }
}

TEST_CASE("starts at rest in the straight configuration") {
  const Model model(amouri2020());
  const VectorXd times = VectorXd::LinSpaced(101, 0.0, 1.0);
  const VectorXd rest = state(0.0, 0.0);
  for (const Method method : methods) {
    CAPTURE(label(method));
    SUBCASE("no tension: stays, in a few steps") {
      const Trajectory still = run(model, pull(0.0), rest, times, method);
      REQUIRE(still.status == Status::ok);
      CHECK(still.q.isZero(0.0));
      CHECK(still.stats.steps < 30);
    }
    SUBCASE("cables 1 and 2 pulled") {
      const Trajectory moving = run(model, pull(3.0, 4.0), rest, times, method);
      CHECK(distance(moving, reference(model, pull(3.0, 4.0), rest, times)) <= default_error);
    }
    SUBCASE("tension that grows from zero, so that the first derivative is zero too") {
      const TensionInput ramp = TensionInput::table(
          Eigen::Vector2d(0.0, 1.0), Eigen::Matrix<double, 2, 3>{{0.0, 0.0, 0.0}, {5.0, 0.0, 2.0}},
          TensionInput::Interpolation::linear);
      const Trajectory moving = run(model, ramp, rest, times, method);
      CHECK(distance(moving, reference(model, ramp, rest, times)) <= default_error);
    }
  }
}

TEST_CASE("an exception of the tension function comes through and a restart recovers") {
  const Model model(amouri2020());
  bool armed = true;
  const TensionInput input = pull_by([&armed](double t, double) {
    if (armed && t > 0.05) throw std::domain_error("no tension here");
    return 5.0 + std::sin(3.0 * t);
  });
  Plant plant(model, input);
  for (const Method method : methods) {
    CAPTURE(label(method));
    armed = true;
    const auto integrator = make_cvode_integrator(plant, method, {});
    REQUIRE(integrator->restart(0.0, state(0.3, 0.1), 1.0) == Status::ok);
    CHECK_THROWS_WITH_AS(run(*integrator, 1.0), "no tension here", std::domain_error);
    CHECK(integrator->time() > 0.01);
    CHECK(integrator->time() <= 0.05);
    const double time = integrator->time();
    const VectorXd last = integrator->state();
    CHECK(integrator->step() == Status::interrupted);
    CHECK(integrator->time() == time);
    CHECK(integrator->state() == last);

    CHECK_THROWS_AS(integrator->restart(0.06, last, 1.0), std::domain_error);
    CHECK(integrator->step() == Status::not_started);

    armed = false;
    REQUIRE(integrator->restart(0.0, state(0.3, 0.1), 1.0) == Status::ok);
    REQUIRE(run(*integrator, 1.0) == Status::ok);
    const auto fresh = make_cvode_integrator(plant, method, {});
    REQUIRE(fresh->restart(0.0, state(0.3, 0.1), 1.0) == Status::ok);
    REQUIRE(run(*fresh, 1.0) == Status::ok);
    CHECK(integrator->state() == fresh->state());
  }
}

TEST_CASE("each failure has its status, keeps the last good state, and prints nothing") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Model model(amouri2020());
  struct Failure {
    Status status;
    TensionInput input;
    double latest;  // [s]
  };
  const Failure failures[] = {
      {Status::bending_limit, pull(5000.0), 1.0},
      // So strong that the equations of motion overflow.
      {Status::non_finite_state, pull_by([](double t, double) { return t < 0.1 ? 1.0 : 1e308; }),
       0.1},
      // Different at every instant, so that no step is short enough.
      {Status::step_too_small,
       pull_by([](double t, double) { return 5.0 + (t < 0.1 ? 0.0 : 5.0 * std::sin(1e18 * t)); }),
       0.2},
      // Different at every bending angle, so that Newton's method finds no end.
      {Status::tolerance_not_met, pull_by([](double t, double q) {
         return 5.0 + (t < 0.1 ? 0.0 : 5.0 * std::sin(1e18 * q));
       }),
       0.2},
  };
  for (const Method method : methods) {
    for (const Failure& failure : failures) {
      CAPTURE(label(method));
      CAPTURE(name(failure.status));
      Plant plant(model, failure.input);
      const auto integrator = make_cvode_integrator(plant, method, tolerances(1e-8));
      REQUIRE(integrator->restart(0.0, state(0.1, 0.0), 5.0) == Status::ok);
      CapturedErrors errors;
      CHECK(run(*integrator, 5.0) == failure.status);
      CHECK(errors.size() == 0);
      CHECK(integrator->time() <= failure.latest);
      CHECK(integrator->time() > 0.0);
      CHECK(plant.check(integrator->state().data()) == Status::ok);

      const double time = integrator->time();
      const VectorXd last = integrator->state();
      CHECK(integrator->step() == failure.status);
      CHECK(integrator->time() == time);
      CHECK(integrator->state() == last);
    }

    const TensionInput none = pull(0.0), overflowing = pull(1e308);
    Plant plant(model, none), strong(model, overflowing);
    const auto integrator = make_cvode_integrator(plant, method, {});
    CHECK(integrator->step() == Status::not_started);
    CHECK(integrator->restart(0.0, state(10.0, 0.0), 1.0) == Status::bending_limit);
    CHECK(integrator->step() == Status::bending_limit);
    CHECK(integrator->restart(0.0, state(0.0, 0.0, infinity), 1.0) == Status::non_finite_state);
    CHECK(integrator->restart(0.0, state(0.0, 0.0), 1.0) == Status::ok);
    CHECK(integrator->step() == Status::ok);
    CHECK(make_cvode_integrator(strong, method, {})->restart(0.0, state(0.0, 0.0), 1.0) ==
          Status::non_finite_state);

    Options few;
    few.max_steps = 20;
    const Trajectory cut = run(model, pull(5.0), state(0.0, 0.0), Eigen::Vector2d(0.0, 1.0),
                               method, few);
    CHECK(cut.status == Status::step_limit);
    CHECK(cut.stats.steps == 20);
  }
}

TEST_CASE("a jump of the tension function between break points is passed") {
  const Model model(amouri2020());
  const VectorXd times = VectorXd::LinSpaced(51, 0.0, 2.0), rest = state(0.0, 0.5);
  const TensionInput jump = pull_by([](double t, double) { return t < 0.777 ? 1.0 : 20.0; });
  const TensionInput table = TensionInput::table(
      Eigen::Vector2d(0.0, 0.777), Eigen::Matrix<double, 2, 3>{{1.0, 0.0, 0.0}, {20.0, 0.0, 0.0}},
      TensionInput::Interpolation::previous);
  const Trajectory truth = reference(model, table, rest, times);
  for (const Method method : methods) {
    CAPTURE(label(method));
    CHECK(distance(run(model, jump, rest, times, method, tolerances(1e-12)), truth) <=
          tight_error);
  }
}

TEST_CASE("counts what it does, over restarts too") {
  const Model model(amouri2020());
  long calls = 0;
  const TensionInput input = pull_by([&calls](double t, double) {
    ++calls;
    return std::fmod(t, 0.2) < 0.1 ? 0.0 : 5.0;
  });
  Plant plant(model, input);
  for (const Method method : methods) {
    CAPTURE(label(method));
    const auto integrator = make_cvode_integrator(plant, method, {});
    CHECK(integrator->stats().steps == 0);
    calls = 0;
    long steps = 0, rejected = 0;
    VectorXd y = state(0.2, 0.0);
    for (int segment = 0; segment < 3; ++segment) {
      REQUIRE(integrator->restart(segment, y, segment + 1.0) == Status::ok);
      CHECK(integrator->stats().rejected == rejected);  // carried over
      while (integrator->time() < segment + 1.0) {
        REQUIRE(integrator->step() == Status::ok);
        ++steps;
      }
      CHECK(integrator->stats().rejected > rejected);
      rejected = integrator->stats().rejected;
      y = integrator->state();
    }
    const Stats stats = integrator->stats();
    CHECK(stats.steps == steps);
    CHECK(stats.evaluations + stats.jacobians == calls);
    CHECK(stats.jacobians > 0);
    // A Jacobian by differences would cost four evaluations more each.
    CHECK(stats.jacobians < steps / 4);
    CHECK(stats.evaluations < 2 * (steps + rejected));
  }
}

TEST_CASE("max_step limits the steps") {
  const Model model(amouri2020());
  const TensionInput input = pull(0.0);
  Plant plant(model, input);
  Options options = tolerances(1e-4);
  options.max_step = 1e-3;
  for (const Method method : methods) {
    const auto integrator = make_cvode_integrator(plant, method, options);
    REQUIRE(integrator->restart(0.0, state(0.1, 0.0), 0.1) == Status::ok);
    while (integrator->time() < 0.1) {
      const double before = integrator->time();
      REQUIRE(integrator->step() == Status::ok);
      CHECK(integrator->time() - before <= options.max_step * (1.0 + 1e-9));
    }
  }
}

TEST_CASE("allocates nothing after the first step") {
#ifdef CDCR_COUNTS_ALLOCATIONS
  const Model model(heavy_robot());
  const TensionInput input = pull(5.0);
  Plant plant(model, input);
  for (const Method method : methods) {
    CAPTURE(label(method));
    const auto integrator = make_cvode_integrator(plant, method, {});
    const VectorXd start = state(0.3, 0.1);
    VectorXd y = start;
    REQUIRE(integrator->restart(0.0, start, 1.0) == Status::ok);
    REQUIRE(integrator->step() == Status::ok);
    const long before = allocations;
    Status worst = Status::ok;
    for (int i = 0; i < 3; ++i) {
      worst = std::max(worst, integrator->restart(0.0, start, 1.0));
      while (worst == Status::ok && integrator->time() < 1.0) {
        worst = integrator->step();
        integrator->interpolate(integrator->time() * (1.0 - 1e-15), y);
      }
    }
    const long after = allocations;
    CHECK(worst == Status::ok);
    CHECK(after == before);
  }
  CHECK(allocations > 0);  // the counter counts
#endif
}

TEST_CASE("makes every method, and refuses bad options and restarts") {
  const Model model(amouri2020());
  const TensionInput input = pull(5.0);
  Plant plant(model, input);
  for (const Method method : {Method::rk4, Method::dopri5, Method::bdf, Method::adams}) {
    const auto integrator = make_cvode_integrator(plant, method, {});
    REQUIRE(integrator->restart(0.0, state(0.2, 0.0), 0.1) == Status::ok);
    CHECK(run(*integrator, 0.1) == Status::ok);
    CHECK(integrator->time() == 0.1);
    CHECK_THROWS_AS(make_cvode_integrator(plant, method, tolerances(0.0)), std::invalid_argument);
  }
  for (const Method method : methods) {
    const auto integrator = make_cvode_integrator(plant, method, {});
    CHECK_THROWS_WITH_AS(
        integrator->restart(1.0, VectorXd::Zero(3), 0.5),
        "restart takes 4 states and t_stop > t, got 3 states, t = 1 s and t_stop = 0.5 s",
        std::invalid_argument);
    CHECK_THROWS_AS(integrator->restart(1.0, state(0.0, 0.0), 1.0), std::invalid_argument);
  }
}

}  // namespace
}  // namespace cdcr::test
