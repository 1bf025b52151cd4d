// Energy is kept without damping, and otherwise goes where the power balance says.
#include <doctest/doctest.h>

#include <cmath>

#include "cdcr/kinematics.hpp"
#include "cdcr/simulate.hpp"
#include "support/cases.hpp"
#include "support/element_sum.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

const Eigen::Vector2d q_start(0.7, 0.2), qd_start(-1.0, 3.0);

/// Largest change of the energy of the undamped robot of Table 1 over `duration`, relative.
double drift(Method method, const Options& options, double duration) {
  const Model model(amouri2020());
  const Trajectory run = simulate(model, q_start, qd_start, even_times(0.0, duration, 2001),
                                  no_tension(model), method, options);
  REQUIRE(run.status == Status::ok);
  const VectorXd energies = total_energies(model, run);
  return largest(energies.array().matrix() - VectorXd::Constant(2001, energies[0])) / energies[0];
}

/// Times at the Gauss points of `count` equal intervals of [0, end], and end.
VectorXd gauss_times(double end, int count) {
  VectorXd times(count * num_gauss + 2);
  times[0] = 0.0;
  for (int i = 0; i < count; ++i) {
    // The nodes come in decreasing order.
    for (int k = 0; k < num_gauss; ++k) {
      const auto node = static_cast<double>(gauss().node[num_gauss - 1 - k]);
      times[1 + i * num_gauss + k] = end * (i + node) / count;
    }
  }
  times[count * num_gauss + 1] = end;
  return times;
}

/// Power that cables and damper give to the robot: -F.ldot - c |qd|^2.
double power(const Model& model, const VectorXd& qd, const VectorXd& tension) {
  const VectorXd length_rate = -model.actuation_matrix().transpose() * qd;
  return -tension.dot(length_rate) - model.damping()[0] * qd.squaredNorm();
}

/// Change of the energy along a run against the integral of the power.
void check_balance(const Model& model, const CommandInput& input, double end) {
  constexpr int count = 40;
  const Trajectory run = simulate(model, q_start, qd_start, gauss_times(end, count), input,
                                  Method::dopri5, tolerances(1e-12, 1e-14));
  REQUIRE(run.status == Status::ok);
  double work = 0.0, activity = 0.0;
  for (Index i = 0; i < count * num_gauss; ++i) {
    const auto weight = static_cast<double>(gauss().weight[i % num_gauss]) * end / count;
    const double p = power(model, run.qd.row(i + 1).transpose(), run.tension.row(i + 1));
    work += weight * p;
    activity += weight * std::abs(p);
  }
  const VectorXd energies = total_energies(model, run);
  const double change = energies[energies.size() - 1] - energies[0];
  CHECK(residual(change, work, activity + std::abs(energies[0])) <= tolerance::balance);
  CHECK(activity > 0.0);
}

Model damped_tilted() {
  Robot robot = amouri2020();
  robot.gravity = {3.0, -4.0, -8.0};
  robot.payload = 0.02;
  robot.sections[0].damping = 2e-3;
  return Model(robot);
}

TEST_SUITE_BEGIN("energy");

TEST_CASE("undamped energy over 1000 s, Dormand-Prince at rtol 1e-12: below 1e-8") {
  const double found = drift(Method::dopri5, tolerances(1e-12, 1e-14), 1000.0);
  MESSAGE("energy drift of dopri5 at rtol 1e-12: ", found);
  CHECK(found < 1e-8);
}

TEST_CASE("undamped energy over 1000 s, Dormand-Prince at its default tolerances") {
  Options options;
  options.max_steps = 100000000;
  const double found = drift(Method::dopri5, options, 1000.0);
  MESSAGE("energy drift of dopri5 at default tolerances: ", found);
  CHECK(found < 1e-4);
}

TEST_CASE("undamped energy over 1000 s, Runge-Kutta with steps of 1 ms") {
  const double found = drift(Method::rk4, fixed_step(1e-3), 1000.0);
  MESSAGE("energy drift of rk4 with 1 ms steps: ", found);
  CHECK(found < 1e-5);
}

TEST_CASE("power balance under constant tensions") {
  check_balance(damped_tilted(), CommandInput::constant(Eigen::Vector3d(5.0, 1.0, 0.0)), 2.0);
}

TEST_CASE("power balance along ramps") {
  MatrixXd rows(3, 3);
  rows << 0.0, 1.0, 2.0, 6.0, 0.0, 1.0, 0.0, 3.0, 0.0;
  check_balance(damped_tilted(),
                CommandInput::table(Eigen::Vector3d(0.0, 1.0, 2.0), rows,
                                    CommandInput::Interpolation::linear),
                2.0);
}

TEST_CASE("power balance of a feedback law") {
  const auto law = [](double, const ConstVectorRef& q, const ConstVectorRef& qd,
                      VectorRef tension) {
    tension << 2.0 + std::sin(q[0]) + 0.1 * std::cos(qd[0]), 1.0, 2.0 + std::cos(q[1]);
  };
  check_balance(damped_tilted(), CommandInput::function(law, 3), 2.0);
}

TEST_CASE("damping alone only ever takes energy") {
  const Model model = damped_tilted();
  const Trajectory run =
      simulate(model, q_start, qd_start, even_times(0.0, 20.0, 4001), no_tension(model));
  const VectorXd energies = total_energies(model, run);
  for (Index i = 1; i < energies.size(); ++i) {
    CHECK(energies[i] <= energies[i - 1] + 1e-12 * std::abs(energies[0]));
  }
}

TEST_CASE("the angular momentum about Z of the free round robot is kept") {
  // Nothing tells one direction from another, so q_x p_y - q_y p_x with p = M qd is constant.
  const Model model(amouri2020());
  Data data(model);
  const Trajectory run = simulate(model, q_start, qd_start, even_times(0.0, 100.0, 501),
                                  no_tension(model), Method::dopri5, tolerances(1e-12, 1e-14));
  MatrixXd M(2, 2);
  double first = 0.0;
  for (Index i = 0; i < run.t.size(); ++i) {
    const VectorXd q = run.q.row(i), qd = run.qd.row(i);
    mass_matrix(model, data, q, M);
    const VectorXd p = M * qd;
    const double momentum = q[0] * p[1] - q[1] * p[0];
    if (i == 0) first = momentum;
    CHECK(residual(momentum, first) <= tolerance::conserved);
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
