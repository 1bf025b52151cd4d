// Methods bdf and adams: how exact they are, where they stop, what the output grid changes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cdcr/dynamics.hpp"
#include "support/cvode_runs.hpp"

namespace cdcr::test {
namespace {

TEST_SUITE_BEGIN("cvode");

TEST_CASE("agrees with Dormand-Prince under damping, gravity and tables with jumps") {
  const Model model(heavy_robot());
  const VectorXd times = even_times(0.0, 3.0, 301);
  const VectorXd t = Eigen::Vector4d(0.3, 0.77, 1.0, 2.0);
  MatrixXd tension(4, 3);
  tension << 2.0, 0.0, 1.0, 0.0, 6.0, 0.5, 8.0, 0.0, 0.0, 0.0, 0.0, 3.0;
  for (const auto kind :
       {CommandInput::Interpolation::previous, CommandInput::Interpolation::linear}) {
    const CommandInput input = CommandInput::table(t, tension, kind);
    const VectorXd y = state(0.4, -0.3, 1.0, 2.0);
    const Trajectory truth = reference(model, input, y, times);
    for (const Method method : cvode_methods) {
      CAPTURE(label(method));
      const Trajectory found = run(model, input, y, times, method, tight);
      CHECK(distance(found, truth) <= tolerance::cvode_tight);
      CHECK(found.tension == truth.tension);
    }
  }
}

TEST_CASE("default tolerances keep step-tension within some 1e-6 rad over 10 s") {
  const Model model(amouri2020());
  const VectorXd times = even_times(0.0, 10.0, 10001);
  const Trajectory truth = reference(model, pull(5.0), state(0.0, 0.0), times);
  for (const Method method : cvode_methods) {
    CAPTURE(label(method));
    const Trajectory found = run(model, pull(5.0), state(0.0, 0.0), times, method);
    CHECK(distance(found, truth) <= tolerance::cvode_default);
  }
}

TEST_CASE("undamped energy over 1000 s at default tolerances") {
  // No bound follows from the tolerances: BDF damps by itself, so this states what it does.
  const Model model(amouri2020());
  const VectorXd times = Eigen::Vector2d(0.0, 1000.0);
  Data data(model);
  for (const Method method : cvode_methods) {
    const Trajectory found = run(model, pull(0.0), state(0.7, 0.2, -1.0, 3.0), times, method);
    REQUIRE(found.status == Status::ok);
    double energy[2];
    for (int i = 0; i < 2; ++i) {
      const VectorXd q = found.q.row(i).transpose(), qd = found.qd.row(i).transpose();
      energy[i] = potential_energy(model, data, q) + kinetic_energy(model, data, q, qd);
    }
    const double drift = std::abs(energy[1] / energy[0] - 1.0);
    MESSAGE("energy drift of ", label(method), " at default tolerances: ", drift);
    CHECK(drift < (method == Method::bdf ? 4e-4 : 5e-5));
  }
}

TEST_CASE("a tighter tolerance is a smaller error") {
  const Model model(amouri2020());
  const VectorXd times = even_times(0.0, 2.0, 101);
  const VectorXd y = state(0.8, 0.0, 0.0, 3.0);
  const Trajectory truth = reference(model, pull(1.0, 2.0), y, times);
  for (const Method method : cvode_methods) {
    CAPTURE(label(method));
    double before = 1.0;
    for (const double rtol : {1e-5, 1e-7, 1e-9, 1e-11}) {
      CAPTURE(rtol);
      const Options options = tolerances(rtol, 0.01 * rtol);
      const Trajectory found = run(model, pull(1.0, 2.0), y, times, method, options);
      const double error = distance(found, truth).value;
      CHECK(error < 0.2 * before);
      before = error;
    }
  }
}

TEST_CASE("stops exactly where asked, however short the way") {
  const Model model(amouri2020());
  const CommandInput input = pull(5.0);
  RobotOde ode(model, input);
  for (const Method method : cvode_methods) {
    CAPTURE(label(method));
    const auto integrator = make_cvode_integrator(ode, method, {});
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
  const CommandInput input = CommandInput::table(t, tension, CommandInput::Interpolation::previous);
  for (const Method method : cvode_methods) {
    CAPTURE(label(method));
    const VectorXd y = state(0.0, 0.0);
    const Trajectory fine = run(model, input, y, even_times(0.0, 2.0, 1025), method);
    for (const Index stride : {1024, 128, 4}) {
      const VectorXd times = even_times(0.0, 2.0, 1024 / stride + 1);
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
  const CommandInput input = pull(5.0);
  RobotOde ode(model, input);
  for (const Method method : cvode_methods) {
    CAPTURE(label(method));
    const auto integrator = make_cvode_integrator(ode, method, {});
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

TEST_CASE("the stop time changes nothing long before it, not even the first step") {
  const Model model(amouri2020());
  const CommandInput input = pull(5.0);
  RobotOde ode(model, input);
  for (const Method method : cvode_methods) {
    CAPTURE(label(method));
    const auto near = make_cvode_integrator(ode, method, {});
    const auto far = make_cvode_integrator(ode, method, {});
    REQUIRE(near->restart(0.0, state(0.0, 0.0), 0.5) == Status::ok);
    REQUIRE(far->restart(0.0, state(0.0, 0.0), 1000.0) == Status::ok);
    while (near->time() < 0.4) {
      REQUIRE(near->step() == Status::ok);
      REQUIRE(far->step() == Status::ok);
      CHECK(near->time() == far->time());
      CHECK(near->state() == far->state());
    }
  }
}

TEST_CASE("rests where nothing pulls, in a few steps") {
  const Model model(amouri2020());
  for (const Method method : cvode_methods) {
    CAPTURE(label(method));
    const Trajectory still =
        run(model, pull(0.0), state(0.0, 0.0), even_times(0.0, 10.0, 101), method);
    REQUIRE(still.status == Status::ok);
    CHECK(still.q.isZero(0.0));
    CHECK(still.qd.isZero(0.0));
    CHECK(still.stats.steps < 30);
  }
}

TEST_CASE("sets out from rest in the straight configuration") {
  const Model model(amouri2020());
  const VectorXd times = even_times(0.0, 1.0, 101), rest = state(0.0, 0.0);
  // Tension that grows from zero leaves even the acceleration zero at the start.
  const CommandInput growing = CommandInput::table(
      Eigen::Vector2d(0.0, 1.0), Eigen::Matrix<double, 2, 3>{{0.0, 0.0, 0.0}, {5.0, 0.0, 2.0}},
      CommandInput::Interpolation::linear);
  for (const CommandInput& input : {pull(3.0, 4.0), growing}) {
    const Trajectory truth = reference(model, input, rest, times);
    for (const Method method : cvode_methods) {
      CAPTURE(label(method));
      CHECK(distance(run(model, input, rest, times, method, tight), truth) <=
            tolerance::cvode_tight);
    }
  }
}

TEST_CASE("a jump of the tension function between break points is passed") {
  const Model model(amouri2020());
  const VectorXd times = even_times(0.0, 2.0, 51), rest = state(0.0, 0.5);
  const CommandInput jump = pull_by([](double t, double) { return t < 0.777 ? 1.0 : 20.0; });
  const CommandInput table = CommandInput::table(
      Eigen::Vector2d(0.0, 0.777), Eigen::Matrix<double, 2, 3>{{1.0, 0.0, 0.0}, {20.0, 0.0, 0.0}},
      CommandInput::Interpolation::previous);
  const Trajectory truth = reference(model, table, rest, times);
  for (const Method method : cvode_methods) {
    CAPTURE(label(method));
    CHECK(distance(run(model, jump, rest, times, method, tight), truth) <= tolerance::cvode_jump);
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
