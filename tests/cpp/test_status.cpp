// Every way to fail, produced: the status, what stays, and the sentence that goes with it.
#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "cdcr/simulate.hpp"
#include "cdcr/statics.hpp"
#include "support/cases.hpp"
#include "support/runs.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

// not_started, invalid_tension and invalid_wrench come from the simulator (test_simulator.cpp),
// wrong_size from what takes vectors (test_assertions.cpp), tolerance_not_met from an implicit
// method (test_cvode_promises.cpp); all others are produced here.
const std::vector<Status> all = {
    Status::ok,
    Status::not_started,
    Status::step_limit,
    Status::step_too_small,
    Status::tolerance_not_met,
    Status::non_finite_state,
    Status::bending_limit,
    Status::invalid_tension,
    Status::not_converged,
    Status::interrupted,
    Status::wrong_size,
    Status::invalid_wrench,
};

const Eigen::Vector2d q_start(0.5, 0.0), at_rest(0.0, 0.0);
const std::vector<Method> own_methods = {Method::dopri5, Method::dop853, Method::rk4};

/// The run ended before its end and says so; what it keeps is sound.
void check_stopped(const Trajectory& run, Status status, Index all_samples) {
  CHECK(run.status == status);
  const std::string start = "Stopped at t = ";
  CHECK(run.message.substr(0, start.size()) == start);
  CHECK(run.message.find(std::string(" s (") + name(status) + "). ") != std::string::npos);
  CHECK(run.message.find(message(status)) != std::string::npos);
  CHECK(run.t.size() >= 1);
  CHECK(run.t.size() < all_samples);
  CHECK(run.q.rows() == run.t.size());
  CHECK(run.qd.rows() == run.t.size());
  CHECK(run.tension.rows() == run.t.size());
  CHECK(run.q.allFinite());
  CHECK(run.qd.allFinite());
  CHECK(run.q.rowwise().norm().maxCoeff() <= max_bending);
}

TEST_SUITE_BEGIN("status");

TEST_CASE("every status but ok has a sentence of its own and every one a name") {
  CHECK(std::string(message(Status::ok)).empty());
  std::set<std::string> sentences, names;
  for (const Status status : all) {
    const std::string text = message(status);
    sentences.insert(text);
    names.insert(name(status));
    if (status != Status::ok) CHECK(text.size() > 20);
    if (status != Status::ok) CHECK(text.back() == '.');
  }
  CHECK(sentences.size() == all.size());
  CHECK(names.size() == all.size());
  CHECK(std::string(name(Status::step_limit)) == "step_limit");
  CHECK(std::string(name(static_cast<Status>(99))) == "unknown");
  CHECK_FALSE(std::string(message(static_cast<Status>(99))).empty());
}

TEST_CASE("step_limit") {
  const Model model(amouri2020());
  Options options;
  options.max_steps = 10;
  for (const Method method : own_methods) {
    const Trajectory run = simulate(model, q_start, at_rest, even_times(0.0, 10.0, 1001),
                                    no_tension(model), method, options);
    check_stopped(run, Status::step_limit, 1001);
    CHECK(run.stats.steps == 10);
  }
}

TEST_CASE("max_steps that just suffice are no limit") {
  const Model model(amouri2020());
  Options options = fixed_step(0.125);
  options.max_steps = 8;
  const Trajectory run = simulate(model, q_start, at_rest, even_times(0.0, 1.0, 2),
                                  no_tension(model), Method::rk4, options);
  CHECK(run.status == Status::ok);
}

TEST_CASE("interrupted") {
  const Model model(amouri2020());
  for (const Method method : own_methods) {
    const Trajectory run =
        simulate(model, q_start, at_rest, even_times(0.0, 100.0, 1001), no_tension(model), method,
                 Options(), make_integrator, [](double t) { return t < 1.0; });
    check_stopped(run, Status::interrupted, 1001);
    CHECK(run.t[run.t.size() - 1] >= 0.9);
    CHECK(run.t[run.t.size() - 1] < 50.0);
  }
}

TEST_CASE("bending_limit") {
  const Model model(amouri2020());
  const CommandInput hard = CommandInput::constant(Eigen::Vector3d(300.0, 0.0, 0.0));
  for (const Method method : own_methods) {
    const Trajectory run =
        simulate(model, q_start, at_rest, even_times(0.0, 10.0, 10001), hard, method);
    check_stopped(run, Status::bending_limit, 10001);
    CHECK(run.q.rowwise().norm().maxCoeff() > 8.0);
  }
}

TEST_CASE("non_finite_state") {
  const Model model(amouri2020());
  const Eigen::Vector2d absurd(1e200, 0.0);
  for (const Method method : own_methods) {
    const Trajectory run =
        simulate(model, q_start, absurd, even_times(0.0, 1.0, 11), no_tension(model), method);
    check_stopped(run, Status::non_finite_state, 11);
    CHECK(run.t.size() == 1);
  }
}

TEST_CASE("step_too_small") {
  // Tensions that flicker faster than any step: no step meets the tolerance.
  const Model model(amouri2020());
  const auto flicker = [](double t, const ConstVectorRef&, const ConstVectorRef&, VectorRef F) {
    F.setConstant(0.0);
    F[0] = t > 0.1 ? 1e5 * (1.0 + std::sin(1e17 * t)) : 0.0;
  };
  const Trajectory run =
      simulate(model, q_start, at_rest, even_times(0.0, 1.0, 101),
               CommandInput::function(flicker, 3), Method::dopri5, tolerances(1e-14, 1e-18));
  check_stopped(run, Status::step_too_small, 101);
  CHECK(run.t[run.t.size() - 1] <= 0.1);
}

TEST_CASE("not_converged") {
  // The force overflows when squared, so nothing tells how far from rest the robot is.
  const Model model(amouri2020());
  Wrench wrench;
  wrench.force[0] = 1e200;
  const Equilibrium found = equilibrium(model, VectorXd::Zero(3), {}, {wrench});
  CHECK(found.status == Status::not_converged);
  CHECK(found.q.norm() <= max_bending);
}

TEST_CASE("a rest beyond the bending limit") {
  const Model model(amouri2020());
  const Equilibrium found = equilibrium(model, Eigen::Vector3d(1e200, 0.0, 0.0));
  CHECK(found.status == Status::bending_limit);
  CHECK(found.q.norm() <= max_bending);
}

TEST_CASE("a negative or non-finite tension from a function is refused with a sentence") {
  const Model model(amouri2020());
  const auto pushing = [](double t, const ConstVectorRef&, const ConstVectorRef&, VectorRef F) {
    F << 0.5 - t, 1.0, 0.0;
  };
  const auto broken = [](double, const ConstVectorRef&, const ConstVectorRef&, VectorRef F) {
    F.setConstant(NAN);
  };
  for (const Method method : own_methods) {
    CHECK_THROWS_AS(simulate(model, q_start, at_rest, even_times(0.0, 1.0, 11),
                             CommandInput::function(pushing, 3), method),
                    std::invalid_argument);
    CHECK_THROWS_SENTENCE(simulate(model, q_start, at_rest, even_times(0.0, 1.0, 11),
                                   CommandInput::function(broken, 3), method),
                          "the tension function must give finite values >= 0 N (a cable cannot "
                          "push), got [nan nan nan] at t = 0 s");
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
