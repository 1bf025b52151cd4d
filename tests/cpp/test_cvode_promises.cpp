// Methods bdf and adams: failures, exceptions, counts, and the promises of cdcr/cvode.hpp.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>

#include "support/allocations.hpp"
#include "support/cvode_runs.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

/// What the process writes to stderr during its lifetime.
class CapturedErrors {
 public:
  CapturedErrors() {
    std::fflush(stderr);
    REQUIRE(dup2(fileno(file_), STDERR_FILENO) >= 0);
  }
  ~CapturedErrors() {
    restore();
    std::fclose(file_);
  }
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

TEST_SUITE_BEGIN("cvode_promises");

TEST_CASE("an exception of the tension function comes through and a restart recovers") {
  const Model model(amouri2020());
  bool armed = true;
  const CommandInput input = pull_by([&armed](double t, double) {
    if (armed && t > 0.05) throw std::domain_error("no tension here");
    return 5.0 + std::sin(3.0 * t);
  });
  RobotOde ode(model, input);
  for (const Method method : cvode_methods) {
    CAPTURE(label(method));
    armed = true;
    const auto integrator = make_cvode_integrator(ode, method, {});
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
    const auto fresh = make_cvode_integrator(ode, method, {});
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
    CommandInput input;
    double latest;  // [s]
  };
  int calls = 0;
  const Failure failures[] = {
      {Status::bending_limit, pull(5000.0), 1.0},
      // So strong that the equations of motion overflow.
      {Status::non_finite_state, pull_by([](double t, double) { return t < 0.1 ? 1.0 : 1e308; }),
       0.1},
      {Status::step_too_small, pull_by([](double t, double) { return 1.0 / std::abs(t - 0.1); }),
       0.1},
      // Another answer each time it is asked, so that Newton's method finds no end.
      {Status::tolerance_not_met, pull_by([&](double, double) {
         return ++calls < 200 ? 1.0 : 1e12 * (1.0 + std::sin(calls));
       }),
       5.0},
  };
  for (const Method method : cvode_methods) {
    for (const Failure& failure : failures) {
      CAPTURE(label(method));
      CAPTURE(std::string(name(failure.status)));
      calls = 0;
      RobotOde ode(model, failure.input);
      const auto integrator = make_cvode_integrator(ode, method, tolerances(1e-8, 1e-10));
      REQUIRE(integrator->restart(0.0, state(0.1, 0.0), 5.0) == Status::ok);
      CapturedErrors errors;
      CHECK(run(*integrator, 5.0) == failure.status);
      CHECK(errors.size() == 0);
      CHECK(integrator->time() <= failure.latest);
      CHECK(integrator->time() > 0.0);
      CHECK(ode.check(integrator->state().data()) == Status::ok);

      const double time = integrator->time();
      const VectorXd last = integrator->state();
      CHECK(integrator->step() == failure.status);
      CHECK(integrator->time() == time);
      CHECK(integrator->state() == last);
    }

    const CommandInput none = pull(0.0), overflowing = pull(1e308);
    RobotOde ode(model, none), strong(model, overflowing);
    const auto integrator = make_cvode_integrator(ode, method, {});
    CHECK(integrator->step() == Status::not_started);
    CHECK(integrator->restart(0.0, state(10.0, 0.0), 1.0) == Status::bending_limit);
    CHECK(integrator->step() == Status::bending_limit);
    CHECK(integrator->restart(0.0, state(0.0, 0.0, infinity), 1.0) == Status::non_finite_state);
    CHECK(integrator->restart(0.0, state(0.0, 0.0), 1.0) == Status::ok);
    CHECK(integrator->step() == Status::ok);
    CHECK(make_cvode_integrator(strong, method, {})->restart(0.0, state(0.0, 0.0), 1.0) ==
          Status::non_finite_state);

    // Slopes that are finite, though their squares are not.
    const CommandInput violent = pull(1e300);
    RobotOde wild(model, violent);
    const auto helpless = make_cvode_integrator(wild, method, {});
    REQUIRE(helpless->restart(0.0, state(0.1, 0.0), 1.0) == Status::ok);
    CHECK(run(*helpless, 1.0) != Status::ok);
    CHECK(ode.check(helpless->state().data()) == Status::ok);

    Options few;
    few.max_steps = 20;
    const Trajectory cut =
        run(model, pull(5.0), state(0.0, 0.0), Eigen::Vector2d(0.0, 1.0), method, few);
    CHECK(cut.status == Status::step_limit);
    CHECK(cut.stats.steps == 20);
  }
}

TEST_CASE("counts what it does, over restarts too") {
  const Model model(amouri2020());
  long calls = 0;
  const CommandInput input = pull_by([&calls](double t, double) {
    ++calls;
    return std::fmod(t, 0.2) < 0.1 ? 0.0 : 5.0;
  });
  RobotOde ode(model, input);
  for (const Method method : cvode_methods) {
    CAPTURE(label(method));
    const auto integrator = make_cvode_integrator(ode, method, {});
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
  const CommandInput input = pull(0.0);
  RobotOde ode(model, input);
  Options options = tolerances(1e-4, 1e-6);
  options.max_step = 1e-3;
  for (const Method method : cvode_methods) {
    const auto integrator = make_cvode_integrator(ode, method, options);
    REQUIRE(integrator->restart(0.0, state(0.1, 0.0), 0.1) == Status::ok);
    while (integrator->time() < 0.1) {
      const double before = integrator->time();
      REQUIRE(integrator->step() == Status::ok);
      CHECK(integrator->time() - before <= options.max_step * (1.0 + 1e-9));
    }
  }
}

TEST_CASE("allocates nothing after the first step") {
  const Model model(heavy_robot());
  const CommandInput input = pull(5.0);
  RobotOde ode(model, input);
  const VectorXd start = state(0.3, 0.1);
  for (const Method method : cvode_methods) {
    CAPTURE(label(method));
    const auto integrator = make_cvode_integrator(ode, method, {});
    VectorXd y = start;
    REQUIRE(integrator->restart(0.0, start, 1.0) == Status::ok);
    REQUIRE(integrator->step() == Status::ok);
    Status worst = Status::ok;
    const auto run_again = [&] {
      for (int i = 0; i < 3; ++i) {
        worst = std::max(worst, integrator->restart(0.0, start, 1.0));
        while (worst == Status::ok && integrator->time() < 1.0) {
          worst = integrator->step();
          integrator->interpolate(integrator->time() * (1.0 - 1e-15), y);
        }
      }
    };
    CHECK(allocations_of(run_again) == 0);
    CHECK(worst == Status::ok);
  }
  if (allocations_counted) {
    const auto set_up = [&] { return make_cvode_integrator(ode, Method::bdf, {}); };
    CHECK(allocations_of(set_up) > 10);
  }
}

TEST_CASE("makes every method, and refuses bad options and restarts") {
  const Model model(amouri2020());
  const CommandInput input = pull(5.0);
  RobotOde ode(model, input);
  for (const Method method :
       {Method::rk4, Method::dopri5, Method::dop853, Method::bdf, Method::adams}) {
    const auto integrator = make_cvode_integrator(ode, method, {});
    REQUIRE(integrator->restart(0.0, state(0.2, 0.0), 0.1) == Status::ok);
    CHECK(run(*integrator, 0.1) == Status::ok);
    CHECK(integrator->time() == 0.1);
    CHECK_THROWS_AS(make_cvode_integrator(ode, method, tolerances(0.0, 1e-12)),
                    std::invalid_argument);
  }
  for (const Method method : cvode_methods) {
    const auto integrator = make_cvode_integrator(ode, method, {});
    CHECK_THROWS_WITH_AS(
        integrator->restart(1.0, VectorXd::Zero(3), 0.5),
        "restart takes 4 states and t_stop > t, got 3 states, t = 1 s and t_stop = 0.5 s",
        std::invalid_argument);
    CHECK_THROWS_AS(integrator->restart(1.0, state(0.0, 0.0), 1.0), std::invalid_argument);
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
