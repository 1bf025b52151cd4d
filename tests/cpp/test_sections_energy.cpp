// Energy of robots of several sections over 100 s: kept without damping, and otherwise it goes
// where the power balance says.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "cdcr/simulate.hpp"
#include "support/cases.hpp"
#include "support/element_sum.hpp"
#include "support/residual.hpp"
#include "support/runs.hpp"
#include "support/split.hpp"

namespace cdcr::test {
namespace {

// Dormand-Prince at rtol 1e-10, over some ten swings and a few hundred of the fastest mode.
constexpr double kept = 5e-9;
// The same against the integral of the power, on its dense output of fourth order.
constexpr double balance = 5e-9;

constexpr double duration = 100.0;

/// The robot of Table 1 cut into n sections, soft enough to swing once in ten seconds and as heavy
/// for its stiffness as the real one, tilted, with a payload.
Robot soft(int n, double damping) {
  Robot robot = amouri2020();
  robot.sections[0].youngs_modulus /= 200.0;
  robot.sections[0].damping = damping;
  robot.gravity = {0.02, -0.01, -0.03};
  robot.payload = 0.02;
  robot.payload_position = {0.01, 0.0, 0.03};
  robot.payload_inertia = Vector3d(2e-5, 3e-5, 4e-5).asDiagonal();
  return split(robot, n);
}

VectorXd start(const Model& model, const Eigen::Vector2d& whole) {
  return spread(whole, static_cast<int>(model.num_sections()));
}

constexpr int num_intervals = 1000;
constexpr Index stride = num_gauss + 1;

/// 0, then for each of equal intervals of [0, duration] its Gauss points and its end.
VectorXd gauss_times() {
  VectorXd times(1 + num_intervals * stride);
  times[0] = 0.0;
  for (Index i = 0; i < num_intervals; ++i) {
    const double first = static_cast<double>(i), width = duration / num_intervals;
    // The nodes come in decreasing order.
    for (Index k = 0; k < num_gauss; ++k) {
      const auto node = static_cast<double>(gauss().node[num_gauss - 1 - k]);
      times[1 + i * stride + k] = (first + node) * width;
    }
    times[(i + 1) * stride] = (first + 1.0) * width;
  }
  return times;
}

/// What cables and damping do to a robot.
struct Power {
  double given, taken;
};

Power power(const Model& model, const VectorXd& tension, const VectorXd& qd) {
  Power p{(model.actuation_matrix() * tension).dot(qd), 0.0};
  for (Index k = 0; k < qd.size(); ++k) p.taken += model.damping()[k / 2] * qd[k] * qd[k];
  return p;
}

TEST_SUITE_BEGIN("sections_energy");

TEST_CASE("undamped energy over 100 s") {
  for (const int n : {1, 3, 8}) {
    const Model model(soft(n, 0.0));
    const Trajectory run = simulate(model, start(model, {0.7, 0.2}), start(model, {-0.1, 0.3}),
                                    even_times(0.0, duration, 2001), no_tension(model),
                                    Method::dopri5, tolerances(1e-10, 1e-12));
    REQUIRE(run.status == Status::ok);
    const VectorXd energies = total_energies(model, run);
    const Residual drift =
        residual(energies, VectorXd::Constant(2001, energies[0]), energies.cwiseAbs().maxCoeff());
    MESSAGE(n, " sections: energy drift ", drift, ", steps ", run.stats.steps);
    CHECK(drift <= kept);
  }
}

TEST_CASE("damped and pulled, the energy is the work of cables less what damping takes") {
  for (const int n : {1, 3, 8}) {
    const Model model(soft(n, 2e-4));
    const VectorXd tension = Eigen::Vector3d(0.02, 0.005, 0.0);
    const Trajectory run =
        simulate(model, start(model, {0.7, 0.2}), start(model, {-0.1, 0.3}), gauss_times(),
                 CommandInput::constant(tension), Method::dopri5, tolerances(1e-10, 1e-12));
    REQUIRE(run.status == Status::ok);
    const VectorXd energies = total_energies(model, run);
    double work = 0.0, activity = 0.0, lost = 0.0, worst = 0.0;
    for (Index i = 0; i < num_intervals; ++i) {
      for (Index k = 0; k < num_gauss; ++k) {
        const auto weight = static_cast<double>(gauss().weight[k]) * duration / num_intervals;
        const Power p = power(model, tension, run.qd.row(1 + i * stride + k).transpose());
        work += weight * (p.given - p.taken);
        lost += weight * p.taken;
        activity += weight * (std::abs(p.given) + p.taken);
      }
      worst = std::max(worst, std::abs(energies[(i + 1) * stride] - energies[0] - work));
    }
    const Residual found{worst / activity};
    MESSAGE(n, " sections: power balance ", found, ", steps ", run.stats.steps, ", swings took ",
            lost, " J of ", energies[0] - energies.minCoeff(), " J");
    CHECK(found <= balance);
    CHECK(lost > 0.5 * (energies[0] - energies.minCoeff()));
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
