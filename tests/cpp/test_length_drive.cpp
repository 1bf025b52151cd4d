// Cables driven by length: energy, the rigid limit, slack events, and stiff runs by all methods.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "cdcr/cvode.hpp"
#include "cdcr/statics.hpp"
#include "support/cable_robots.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"

namespace cdcr::test {
namespace {

/// Energy over 10 s and hundreds of swings of the cables, errors added up; bdf damps by itself.
constexpr double kept_by_dopri5 = 4e-8, kept_by_adams = 1e-7, kept_by_bdf = 5e-6;
/// Times of slack events [s] at rtol 1e-12.
constexpr double event_time = 1e-8;
/// Pull at an event over the largest pull of the run.
constexpr double event_pull = 1e-9;
/// Slope of log |q - q*| over log k; the next order is gone at the stiffnesses tried.
constexpr double slope_off = 0.05;
/// States [rad] of stiff runs at rtol 1e-8, or by fixed steps just below the limit of stability.
constexpr double stiff_states = 1e-6;

const std::vector<Method> every_method = {Method::rk4, Method::dopri5, Method::bdf, Method::adams,
                                          Method::dop853};

std::string label(Method method) {
  const char* const names[] = {"rk4", "dopri5", "bdf", "adams", "dop853"};
  return names[static_cast<int>(method)];
}

Trajectory go(const Model& model, const VectorXd& q0, const VectorXd& qd0, const VectorXd& times,
              const CommandInput& input, Method method, const Options& options) {
  Trajectory run = simulate(model, q0, qd0, times, input, method, options, make_cvode_integrator);
  CAPTURE(run.message);
  REQUIRE(run.status == Status::ok);
  return run;
}

VectorXd pulls_at(const Model& model, const Trajectory& run, Index row) {
  const VectorXd q = run.q.row(row).transpose(), qd = run.qd.row(row).transpose();
  VectorXd pull(model.num_cables());
  for (Index j = 0; j < pull.size(); ++j) {
    pull[j] = cable_pull(model, j, q, qd, run.command(row, j));
  }
  return pull;
}

/// Every cable's events in turn: slack, taut, slack, ...
bool alternate(const std::vector<SlackEvent>& events, Index num_cables) {
  for (Index j = 0; j < num_cables; ++j) {
    const SlackEvent* last = nullptr;
    for (const SlackEvent& event : events) {
      if (event.cable != j) continue;
      if (last != nullptr && (last->slack == event.slack || !(last->time < event.time)))
        return false;
      last = &event;
    }
  }
  return true;
}

TEST_SUITE_BEGIN("length_drive");

TEST_CASE("undamped, motion and springs keep their energy while cables fall slack and tighten") {
  Robot robot = parts_with_cables(3, 2e3, 0.0);
  robot.gravity = {0.0, 0.0, 9.81};
  const Model model(robot);
  VectorXd q0(6), shape(6);
  q0 << 0.3, -0.2, 0.1, 0.3, -0.2, 0.1;
  shape << 0.4, 0.1, 0.3, 0.2, 0.1, 0.2;
  const VectorXd command = lengths_of(model, shape);
  const auto energy_of = [&](const Trajectory& run) {
    VectorXd energy = total_energies(model, run);
    for (Index i = 0; i < energy.size(); ++i) {
      energy[i] += cable_energy(model, run.q.row(i).transpose(), command);
    }
    return energy;
  };
  struct Row {
    Method method;
    double rtol, kept;
  };
  for (const auto& [method, rtol, kept] :
       {Row{Method::dopri5, 1e-11, kept_by_dopri5}, Row{Method::adams, 1e-11, kept_by_adams},
        Row{Method::bdf, 1e-10, kept_by_bdf}}) {
    const Trajectory run =
        go(model, q0, VectorXd::Zero(6), even_times(0.0, 10.0, 101),
           CommandInput::constant(command), method, tolerances(rtol, 1e-2 * rtol));
    const VectorXd energy = energy_of(run);
    const double drift = (energy.array() - energy[0]).abs().maxCoeff() / std::abs(energy[0]);
    MESSAGE(label(method) << ", rtol " << rtol << ": energy off by " << drift << " of " << energy[0]
                          << " J in 10 s, " << run.stats.steps << " steps, "
                          << run.slack_events.size() << " slack events");
    CHECK(Residual{drift} <= kept);
    CHECK(alternate(run.slack_events, model.num_cables()));
    if (method != Method::dopri5) CHECK(run.slack_events.size() > 10);
  }
}

TEST_CASE("the shape reached tends to the one commanded as cables stiffen, like 1/k") {
  VectorXd shape(6);
  shape << 0.6, -0.2, -0.3, 0.5, 0.2, 0.4;
  std::vector<double> stiffness, distance;
  for (const double k : {1e5, 1e6, 1e7, 1e8}) {
    Robot robot = parts_with_cables(3, k, 0.0);
    robot.gravity = {0.0, 0.0, -9.81};
    const Model model(robot);
    const double pretension = 200.0;  // keeps every cable taut
    const VectorXd command = lengths_of(model, shape).array() - pretension / k;
    const Equilibrium found = equilibrium(model, command);
    REQUIRE(found.status == Status::ok);
    CHECK(found.stable);
    CHECK(tensions_of(model, found.q, VectorXd::Zero(6), command).minCoeff() > 0.0);
    stiffness.push_back(k);
    distance.push_back((found.q - shape).norm());
  }
  const double slope = fitted_order(stiffness, distance);
  MESSAGE("|q - q*| " << distance.front() << " rad at 1e5 N/m to " << distance.back()
                      << " rad at 1e8 N/m, slope " << slope);
  CHECK(std::abs(slope + 1.0) <= slope_off);
}

/// Table 1 with one cable driven by length, as long as the straight robot.
Model one_spring(double stiffness) {
  Robot robot = amouri2020();
  robot.sections[0].cable_angles = {0.0};
  robot.sections[0].cable_stiffness = stiffness;
  return Model(robot);
}

TEST_CASE("small swings: the cable is slack for half a swing of the backbone alone") {
  // theta < 0 stretches the cable: stiffness K + k r^2, else K; both half swings in closed form.
  const double k = 3e3, start = -1e-5;
  const Model model = one_spring(k);
  Data data(model);
  MatrixXd M(2, 2);
  mass_matrix(model, data, VectorXd::Zero(2), M);
  const double r = model.actuation_matrix()(0, 0), K = model.stiffness()[0], m = M(0, 0);
  const double taut = pi * std::sqrt(m / (K + k * r * r)), slack = pi * std::sqrt(m / K);
  for (const Method method : {Method::bdf, Method::adams}) {
    CAPTURE(label(method));
    const Trajectory run =
        go(model, Eigen::Vector2d(start, 0.0), VectorXd::Zero(2), Eigen::Vector2d(0.0, 10.0),
           CommandInput::constant(rest_command_of(model)), method, tolerances(1e-12, 1e-19));
    REQUIRE(run.slack_events.size() >= 6);
    double expected = 0.5 * taut, worst = 0.0;
    bool turns_slack = true;
    for (std::size_t i = 0; i < 6; ++i) {
      const SlackEvent& event = run.slack_events[i];
      worst = std::max(worst, std::abs(event.time - expected));
      CHECK(event.cable == 0);
      CHECK(event.slack == turns_slack);
      expected += turns_slack ? slack : taut;
      turns_slack = !turns_slack;
    }
    MESSAGE(label(method) << ": six events, off by at most " << worst << " s");
    CHECK(Residual{worst} <= event_time);
  }
}

/// Time of the first change of sign of cable 0's pull after t, by bisection on runs of dopri5.
double next_turn(const Model& model, const CommandInput& input, double& t, VectorXd& q,
                 VectorXd& qd) {
  const double pace = 2e-3;
  const auto pull_after = [&](double h, VectorXd& q_there, VectorXd& qd_there) {
    const Trajectory run =
        go(model, q, qd, Eigen::Vector2d(t, t + h), input, Method::dopri5, tightest());
    q_there = run.q.row(1).transpose();
    qd_there = run.qd.row(1).transpose();
    return pulls_at(model, run, 1)[0];
  };
  VectorXd q_there, qd_there;
  double before = pull_after(pace, q_there, qd_there);
  while (true) {
    q = q_there;
    qd = qd_there;
    t += pace;
    const double after = pull_after(pace, q_there, qd_there);
    if (before * after < 0.0) break;
    before = after;
  }
  double low = 0.0, high = pace;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (pull_after(middle, q_there, qd_there) * before > 0.0 ? low : high) = middle;
  }
  pull_after(high, q_there, qd_there);
  q = q_there;
  qd = qd_there;
  return t += high;
}

TEST_CASE("events of a large swing are the roots of the pull") {
  Robot robot = one_spring(500.0).robot();
  robot.gravity = {1.0, 0.5, -9.81};
  robot.sections[0].cable_damping = 2.0;
  const Model model(robot);
  const VectorXd q0 = Eigen::Vector2d(0.4, 0.3), qd0 = Eigen::Vector2d(-2.0, 1.0);
  const VectorXd command = rest_command_of(model).array() - 2e-3;
  const CommandInput input = CommandInput::constant(command);
  std::vector<double> roots;
  VectorXd q = q0, qd = qd0;
  double t = 0.0;
  for (int i = 0; i < 6; ++i) roots.push_back(next_turn(model, input, t, q, qd));
  for (const Method method : {Method::bdf, Method::adams}) {
    CAPTURE(label(method));
    const VectorXd ends = Eigen::Vector2d(0.0, roots.back() + 1e-3);
    const Options options = tolerances(1e-12, 1e-14);
    const auto events = go(model, q0, qd0, ends, input, method, options).slack_events;
    REQUIRE(events.size() == roots.size());
    VectorXd times(8);
    times << 0.0, Eigen::Matrix<double, 6, 1>::Zero(), ends[1];
    for (std::size_t i = 0; i < roots.size(); ++i) {
      CHECK(Residual{std::abs(events[i].time - roots[i])} <= event_time);
      times[static_cast<Index>(i) + 1] = events[i].time;
    }
    CHECK(alternate(events, 1));
    // The same run, looked at where it found the events.
    const Trajectory run = go(model, q0, qd0, times, input, method, options);
    REQUIRE(run.slack_events.size() == events.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
      const auto row = static_cast<Index>(i) + 1;
      CHECK(run.slack_events[i].time == events[i].time);
      CHECK(Residual{std::abs(pulls_at(model, run, row)[0]) /
                     std::abs(pulls_at(model, run, 0)[0])} <= event_pull);
      CHECK(run.tension(row, 0) <= std::abs(pulls_at(model, run, row)[0]));
    }
  }
}

TEST_CASE("a jump of the command that frees or grips a cable is an event at that time") {
  const Model model = one_spring(500.0);
  MatrixXd commands(3, 1);
  const double straight = model.straight_lengths()[0];
  commands << straight - 5e-3, straight + 0.1, straight - 0.1;
  const auto input = CommandInput::table(Vector3d(0.0, 0.5, 0.75), commands,
                                         CommandInput::Interpolation::previous);
  for (const Method method : {Method::bdf, Method::adams}) {
    const Trajectory run = go(model, Eigen::Vector2d(0.1, 0.0), VectorXd::Zero(2),
                              Eigen::Vector2d(0.0, 0.8), input, method, {});
    CHECK(alternate(run.slack_events, 1));
    const auto at = [&](double time) {
      return std::find_if(run.slack_events.begin(), run.slack_events.end(),
                          [=](const SlackEvent& event) { return event.time == time; });
    };
    CHECK(at(0.75) != run.slack_events.end());
    CHECK(run.slack_events.back().slack == (pulls_at(model, run, 1)[0] < 0.0));
  }
}

TEST_CASE("flags alternate and end as the pulls do, through hundreds of events") {
  Random random;
  INFO(random);
  for (int i = 0; i < 4; ++i) {
    Robot robot = parts_with_cables(2, random.logarithmic(1e2, 1e4), i % 2 == 0 ? 0.0 : 0.5);
    robot.gravity = random.vector(3, 10.0);
    const Model model(robot);
    const VectorXd command = lengths_of(model, random_bending(2, 0.5, random));
    const VectorXd q0 = random_bending(2, 1.0, random), qd0 = random.vector(4, 5.0);
    const Trajectory run =
        go(model, q0, qd0, even_times(0.0, 2.0, 3), CommandInput::constant(command), Method::bdf,
           tolerances(1e-8, 1e-10));
    CHECK(run.slack_events.size() > 10);
    CHECK(alternate(run.slack_events, model.num_cables()));
    const VectorXd pull = pulls_at(model, run, 2);
    for (Index j = 0; j < model.num_cables(); ++j) {
      const auto last = std::find_if(run.slack_events.rbegin(), run.slack_events.rend(),
                                     [j](const SlackEvent& event) { return event.cable == j; });
      if (last != run.slack_events.rend()) CHECK(last->slack == (pull[j] < 0.0));
    }
  }
}

TEST_CASE("a robot driven by tension has no slack events") {
  const Model model(parts_with_cables(2, 0.0, 0.0));
  for (const Method method : every_method) {
    const Trajectory run = go(model, VectorXd::Constant(4, 0.3), VectorXd::Zero(4),
                              Eigen::Vector2d(0.0, 1.0), no_tension(model), method, {});
    CHECK(run.slack_events.empty());
  }
}

TEST_CASE("a straight robot under its command for rest stays at rest") {
  for (const double damping : {0.0, 10.0}) {
    const Model model(parts_with_cables(5, 5e4, damping));
    for (const Method method : every_method) {
      CAPTURE(label(method));
      Options options;
      options.step = 1e-4;
      const Trajectory run =
          go(model, VectorXd::Zero(10), VectorXd::Zero(10), even_times(0.0, 0.5, 6),
             CommandInput::constant(rest_command_of(model)), method, options);
      CHECK(run.q == RowMatrixXd::Zero(6, 10));
      CHECK(run.qd == RowMatrixXd::Zero(6, 10));
      CHECK(run.slack_events.empty());
    }
  }
}

/// Five sections, each with three cables to a shape commanded, then another; all stay taut.
Trajectory stiff_run(double stiffness, double damping, Method method, const Options& options) {
  Robot robot = parts_with_cables(5, stiffness, damping);
  robot.gravity = {0.0, 0.0, -9.81};
  const Model model(robot);
  VectorXd shape(10);
  shape << 0.2, 0.1, -0.1, 0.2, 0.1, 0.0, 0.2, -0.1, 0.1, 0.1;
  MatrixXd command(2, 15);
  command.row(0) = rest_command_of(model).array() - 20.0 / stiffness;
  command.row(1) = lengths_of(model, shape).array() - 20.0 / stiffness;
  const auto input =
      CommandInput::table(Eigen::Vector2d(0.0, 0.2), command, CommandInput::Interpolation::linear);
  return go(model, VectorXd::Zero(10), VectorXd::Zero(10), even_times(0.0, 0.5, 11), input, method,
            options);
}

TEST_CASE("stiff five-section robot: all methods agree; damped cables cost dopri5 its steps") {
  std::vector<long> explicit_steps, implicit_steps;
  for (const double damping : {20.0, 500.0, 5000.0}) {
    const double stiffness = 5e4;
    const Trajectory truth =
        stiff_run(stiffness, damping, Method::dopri5, tolerances(1e-12, 1e-14));
    for (const Method method : every_method) {
      Options options = tolerances(1e-8, 1e-10);
      options.step = std::min(2e-5, 0.05 / damping);
      const Trajectory run = stiff_run(stiffness, damping, method, options);
      const double off = (run.q - truth.q).rowwise().norm().maxCoeff();
      MESSAGE("k = " << stiffness << " N/m, d = " << damping << " N s/m, " << label(method) << ": "
                     << run.stats.steps << " steps, " << run.stats.evaluations
                     << " evaluations, q off by " << off << " rad");
      CHECK(Residual{off} <= stiff_states);
      if (method == Method::dopri5) explicit_steps.push_back(run.stats.steps);
      if (method == Method::bdf) implicit_steps.push_back(run.stats.steps);
    }
  }
  CHECK(explicit_steps[2] > 5 * explicit_steps[1]);
  CHECK(implicit_steps[2] < 2 * implicit_steps[1]);
  CHECK(implicit_steps[2] < explicit_steps[2] / 10);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
