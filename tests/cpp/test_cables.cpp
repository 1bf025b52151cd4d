// What cables do: tensions, springs that never push, energies and the forces that belong to them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "cdcr/dynamics.hpp"
#include "cdcr/linearization.hpp"
#include "support/cable_robots.hpp"
#include "support/differences.hpp"
#include "support/residual.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

/// Cables that rub change their force over the sliding speed, which differences must resolve.
constexpr double rubbing_differences = 2e-6;

const Cable& cable_of(const Model& model, Index j) {
  return model.cables()[static_cast<std::size_t>(j)];
}

VectorXd rates_of(const Model& model, const VectorXd& qd) {
  return -model.actuation_matrix().transpose() * qd;
}

/// body(model, q, qd, command) for chains of 1 to 5 sections whose cables rub, or do not.
template <class Body>
void for_each_robot(bool rubbing, Body body) {
  Random random;
  for (int i = 0; i < 5 * test_count(); ++i) {
    Robot robot = rubbing_chain(random, 1 + i % 5);
    if (!rubbing) {
      for (Section& section : robot.sections) section.cable_friction = 0.0;
      for (Cable& cable : robot.cables) cable.friction.reset();
    }
    const Model model(robot);
    for (int k = 0; k < 5; ++k) {
      const VectorXd q = random_bending(model.num_sections(), 3.0, random);
      const VectorXd qd = random.vector(q.size(), random.logarithmic(1e-3, 10.0));
      const VectorXd command = random_command(model, q, 50.0, random);
      INFO(random, ", robot ", i, ", state ", k);
      body(model, q, qd, command);
    }
  }
}

TEST_SUITE_BEGIN("cables");

TEST_CASE("a tension is its command, or the pull of the spring, never below zero") {
  int slack = 0, taut = 0;
  for_each_robot(true, [&](const Model& model, const VectorXd& q, const VectorXd& qd,
                           const VectorXd& command) {
    const VectorXd tension = tensions_of(model, q, qd, command);
    const VectorXd length = lengths_of(model, q), rate = rates_of(model, qd);
    for (Index j = 0; j < model.num_cables(); ++j) {
      const Cable& cable = cable_of(model, j);
      if (!cable.length_driven()) {
        CHECK(tension[j] == command[j]);
        continue;
      }
      const double pull = cable.stiffness * (length[j] - command[j]) + cable.damping * rate[j];
      const double scale = cable.stiffness * length[j] + cable.damping * qd.norm();
      CHECK(residual(cable_pull(model, j, q, qd, command[j]), pull, scale) <= tolerance::rounding);
      CHECK(tension[j] == std::max(0.0, cable_pull(model, j, q, qd, command[j])));
      ++(tension[j] > 0.0 ? taut : slack);
    }
  });
  CHECK(slack > 20);
  CHECK(taut > 20);
}

TEST_CASE("a cable commanded longer than it is pulls nothing at all") {
  for_each_robot(true, [&](const Model& model, const VectorXd& q, const VectorXd&,
                           const VectorXd& command) {
    const VectorXd still = VectorXd::Zero(q.size());
    VectorXd loose = command;
    for (Index j = 0; j < model.num_cables(); ++j) {
      loose[j] = cable_of(model, j).length_driven() ? lengths_of(model, q)[j] * (1.0 + 1e-12) : 0.0;
    }
    CHECK(tensions_of(model, q, still, loose) == VectorXd::Zero(model.num_cables()));
    CHECK(cable_force_of(model, q, still, loose) == still);
    CHECK(friction_power(model, q, still, loose) == 0.0);
    CHECK(cable_energy(model, q, loose) == 0.0);
  });
}

TEST_CASE("without friction the cables' power is minus tension times rate of length") {
  for_each_robot(false, [&](const Model& model, const VectorXd& q, const VectorXd& qd,
                            const VectorXd& command) {
    const VectorXd tension = tensions_of(model, q, qd, command), rate = rates_of(model, qd);
    const double scale =
        tension.dot(model.actuation_matrix().cwiseAbs().transpose() * qd.cwiseAbs());
    const double power = cable_force_of(model, q, qd, command).dot(qd);
    CHECK(residual(power, -tension.dot(rate), scale) <= tolerance::rounding);
  });
}

TEST_CASE("the actuation matrix is minus the slope of the lengths") {
  for_each_robot(
      false, [&](const Model& model, const VectorXd& q, const VectorXd&, const VectorXd&) {
        MatrixXd B(q.size(), model.num_cables());
        actuation_matrix(model, q, B);
        for (Index k = 0; k < q.size(); ++k) {
          const VectorXd slope = difference(
              [&](double s) {
                VectorXd moved = q;
                moved[k] += s;
                return VectorXd(lengths_of(model, moved));
              },
              0.02);
          CHECK(residual(B.row(k).transpose(), -slope, 1.0) <= tolerance::recursion_differences);
        }
      });
}

TEST_CASE("springs at rest pull down the slope of their energy") {
  const double h = 1e-4;
  for_each_robot(false, [&](const Model& model, const VectorXd& q, const VectorXd&,
                            const VectorXd& command) {
    VectorXd springs = command;  // tension-driven cables have no energy and shall not pull
    bool near_kink = false;
    double scale = 0.0;
    for (Index j = 0; j < model.num_cables(); ++j) {
      const Cable& cable = cable_of(model, j);
      if (!cable.length_driven()) {
        springs[j] = 0.0;
        continue;
      }
      const double stretch = lengths_of(model, q)[j] - command[j];
      near_kink = near_kink || std::abs(stretch) <= 2.0 * h * cable.radius;
      scale += cable.radius * cable.stiffness * std::abs(stretch);
    }
    if (near_kink) return;
    const VectorXd still = VectorXd::Zero(q.size());
    VectorXd slope(q.size());
    for (Index i = 0; i < q.size(); ++i) {  // exact for a quadratic, but for rounding
      const VectorXd step = h * VectorXd::Unit(q.size(), i);
      slope[i] = (cable_energy(model, q + step, springs) - cable_energy(model, q - step, springs)) /
                 (2.0 * h);
    }
    if (scale == 0.0) return;
    CHECK(residual(cable_force_of(model, q, still, springs), -slope, scale) <=
          tolerance::differences);
  });
}

TEST_CASE("tensions along a cable begin at its base and end where it ends") {
  for (const bool rubbing : {false, true}) {
    for_each_robot(rubbing, [&](const Model& model, const VectorXd& q, const VectorXd& qd,
                                const VectorXd& command) {
      const VectorXd tension = tensions_of(model, q, qd, command);
      const MatrixXd along = tensions_along_of(model, q, qd, command);
      CHECK(along.row(0) == tension.transpose());
      for (Index j = 0; j < model.num_cables(); ++j) {
        for (Index k = 1; k <= model.num_sections(); ++k) {
          const bool there = k - 1 <= cable_of(model, j).end_section;
          if (!there) CHECK(along(k, j) == 0.0);
          if (there && !rubbing) CHECK(along(k, j) == tension[j]);
          if (there && tension[j] > 0.0) CHECK(along(k, j) > 0.0);
        }
      }
    });
  }
}

TEST_CASE("the command for rest leaves the straight robot alone, to the last bit") {
  for_each_robot(
      true, [&](const Model& model, const VectorXd& q, const VectorXd&, const VectorXd&) {
        const VectorXd zero = VectorXd::Zero(q.size()), command = rest_command_of(model);
        CHECK(cable_force_of(model, zero, zero, command) == zero);
        CHECK(tensions_of(model, zero, zero, command) == VectorXd::Zero(model.num_cables()));
        for (Index j = 0; j < model.num_cables(); ++j) {
          const double straight = model.straight_lengths()[j];
          CHECK(command[j] == (cable_of(model, j).length_driven() ? straight : 0.0));
        }
      });
}

TEST_CASE("forward dynamics is that of the cables' generalised force") {
  for_each_robot(true, [&](const Model& model, const VectorXd& q, const VectorXd& qd,
                           const VectorXd& command) {
    if (!model.has_inertia()) return;
    Data data(model);
    VectorXd commanded(q.size()), forced(q.size());
    forward_dynamics(model, data, q, qd, command, commanded);
    forward_dynamics_force(model, data, q, qd, cable_force_of(model, q, qd, command), forced);
    CHECK(commanded == forced);
  });
}

TEST_CASE("the Jacobian of the motion holds through springs, dampers and friction") {
  Random random;
  INFO(random);
  for (int i = 0; i < 3 * test_count(); ++i) {
    Robot robot = rubbing_chain(random, 1 + i % 5);
    robot.sliding_speed = random.logarithmic(1e-2, 1e-1);
    const Model model(robot);
    if (!model.has_inertia()) continue;
    Data data(model);
    const Index m = model.num_coordinates();
    VectorXd y(2 * m);
    y << random_bending(model.num_sections(), 2.0, random), random.vector(m, 3.0);
    const VectorXd command = random_command(model, y.head(m), 50.0, random);
    MatrixXd A(2 * m, 2 * m), B(2 * m, model.num_cables()), expected(m, 2 * m);
    linearize(model, data, y.head(m), y.tail(m), command, A, B);
    const auto rate = [&](const VectorXd& at) {
      VectorXd qdd(m);
      forward_dynamics(model, data, at.head(m), at.tail(m), command, qdd);
      return qdd;
    };
    for (Index c = 0; c < 2 * m; ++c) {
      const double h = 1e-5;
      const VectorXd step = h * VectorXd::Unit(2 * m, c);
      expected.col(c) =
          (8.0 * (rate(y + step) - rate(y - step)) - (rate(y + 2 * step) - rate(y - 2 * step))) /
          (12.0 * h);
    }
    CAPTURE(i);
    CHECK(residual(A.bottomRows(m), expected) <= rubbing_differences);
  }
}

TEST_CASE("a cable that is paid out by no tension is dragged as by next to none") {
  Robot robot = amouri2020();
  robot.sections[0].cable_viscosity = 5.0;
  robot.sections[0].cable_friction = 0.7;
  const Model model(robot);
  const Eigen::Vector2d q(0.3, 0.2), qd(-0.4, 0.1);
  VectorXd none(2), next_to_none(2);
  cable_force(model, q, qd, VectorXd::Zero(3), none);
  cable_force(model, q, qd, VectorXd::Constant(3, 1e-12), next_to_none);
  CHECK(none.norm() > 1e-4);
  CHECK(residual(next_to_none, none) <= 1e-9L);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
