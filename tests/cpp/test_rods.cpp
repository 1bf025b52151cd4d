// Rods, sections whose bending, twist and stretch vary along them: against the reference cases of
// an independent model, and the rules that their nodes are made of. Their laws are in
// test_laws.cpp.
#include <doctest/doctest.h>

#include <cmath>
#include <sstream>

#include "chain/energy.hpp"
#include "chain/functions.hpp"
#include "derivatives/dual.hpp"
#include "section/rod_cable.hpp"
#include "support/allocations.hpp"
#include "support/cases.hpp"
#include "support/differences.hpp"
#include "support/residual.hpp"
#include "support/rods.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

using detail::Chain;
using detail::Rod;
using detail::RodCable;
using RodChain = detail::ChainState<Rod<double>>;

// Of the accelerations of the reference cases, ten times what is seen: with the default number of
// nodes, and with the largest. Mass matrix and pose are far better, since bending of high order has
// little mass.
constexpr double by_default = 2e-7, with_all_nodes = 2e-10;
constexpr double pose_by_default = 2e-8;

/// Largest relative errors over all reference cases.
struct Errors {
  double acceleration = 0.0, force = 0.0, mass_matrix = 0.0, energy = 0.0, pose = 0.0, cable = 0.0;
};

/// Lengths of all cables, and what they do at the tensions of the case.
struct CablePull {
  VectorXd lengths, force;
};

CablePull pull_of(const Chain& chain, const Json& reference, const VectorXd& q) {
  const VectorXd tension = reference["tension"].vector();
  CablePull pull{VectorXd::Zero(tension.size()), VectorXd::Zero(q.size())};
  for (Index j = 0; j < tension.size(); ++j) {
    const Json& cable = reference["cables"].items()[static_cast<std::size_t>(j)];
    const MatrixXd radius = cable["radius"].matrix(), angle = cable["angle"].matrix();
    for (Index i = 0; i < radius.rows(); ++i) {
      const auto& rod = *chain.sections[static_cast<std::size_t>(i)].rod;
      const Index first = chain.first[static_cast<std::size_t>(i)];
      const RodCable path(rod, {radius(i, 0), radius(i, 1), angle(i, 0), angle(i, 1)});
      pull.lengths[j] +=
          path.length(rod, q.data() + first, double{tension[j]}, pull.force.data() + first);
    }
  }
  return pull;
}

void add(double& worst, const Residual& residual) {
  worst = std::max(worst, residual.value);
}

Errors errors_with(int num_nodes) {
  Errors worst;
  const auto state = std::make_unique<RodChain>();
  for (const Json& reference : rod_cases()) {
    const Chain chain = rod_chain(reference, num_nodes);
    const VectorXd q = reference["q"].vector(), qd = reference["qd"].vector(),
                   force = reference["cable_force"].vector(), qdd = reference["qdd"].vector();
    state->update(chain, q.data(), qd.data());

    VectorXd found(q.size());
    detail::forward_motion(chain, *state, force.data(), found.data());
    add(worst.acceleration, residual(found, qdd, qdd.norm()));
    MatrixXd M(q.size(), q.size());
    detail::mass_matrix(chain, *state, M);
    add(worst.mass_matrix, residual(M, reference["mass_matrix"].matrix()));
    detail::inverse_motion(chain, *state, qdd.data(), found.data());
    add(worst.force, residual(found, force, (M.cwiseAbs() * qdd.cwiseAbs()).maxCoeff()));
    add(worst.energy, residual(detail::kinetic_energy(chain, *state, qd.data()),
                               reference["kinetic_energy"].number()));
    add(worst.energy, residual(detail::potential_energy(chain, *state, q.data()),
                               reference["potential_energy"].number()));

    Vector3d tip = Vector3d::Zero();
    double length = 0.0;
    for (Index i = 0; i < chain.num_sections(); ++i) {
      tip += state->sections[static_cast<std::size_t>(i)].r;
      length += chain.sections[static_cast<std::size_t>(i)].rod->length;
    }
    add(worst.pose, residual(tip, reference["tip_position"].vector(), length));
    add(worst.pose, residual(state->tip.rotation(), reference["tip_rotation"].matrix()));

    const CablePull pull = pull_of(chain, reference, q);
    add(worst.cable, residual(pull.lengths, reference["cable_lengths"].vector()));
    add(worst.cable, residual(pull.force, force, largest(force)));
  }
  return worst;
}

TEST_SUITE_BEGIN("rods");

TEST_CASE("reference cases, over the number of nodes") {
  const int default_nodes = detail::RodDescription().num_nodes;  // 0: by the orders
  std::ostringstream table;
  table << "nodes  accelerations  forces  mass matrix  energies  pose  cables";
  for (const int num_nodes : {default_nodes, 6, 8, 10, 12, 16, 24, detail::max_rod_nodes}) {
    const Errors errors = errors_with(num_nodes);
    table << "\n"
          << num_nodes << "  " << errors.acceleration << "  " << errors.force << "  "
          << errors.mass_matrix << "  " << errors.energy << "  " << errors.pose << "  "
          << errors.cable;
    if (num_nodes == default_nodes) {
      CHECK(Residual{errors.acceleration} <= by_default);
      CHECK(Residual{errors.force} <= by_default);
      CHECK(Residual{errors.mass_matrix} <= by_default);
      CHECK(Residual{errors.energy} <= by_default);
      CHECK(Residual{errors.pose} <= pose_by_default);
      CHECK(Residual{errors.cable} <= by_default);
    }
    if (num_nodes == detail::max_rod_nodes) {
      CHECK(Residual{errors.acceleration} <= with_all_nodes);
      CHECK(Residual{errors.force} <= with_all_nodes);
      CHECK(Residual{errors.mass_matrix} <= with_all_nodes);
      CHECK(Residual{errors.energy} <= with_all_nodes);
      CHECK(Residual{errors.pose} <= with_all_nodes);
      CHECK(Residual{errors.cable} <= with_all_nodes);
    }
  }
  MESSAGE(table.str());
}

TEST_CASE("the rule of a rod's mass is exact for polynomials") {
  const double taper = 0.6;
  const detail::RodMass rod{
      0.3, 0.01, 0.01 * taper, 0.002, {{0.25, 0.1, 0.05}, {0.5, 0.2, 0.03}, {1.0, 0.1, 0.05}}};
  // int x^p of mass and of moments of inertia over the backbone, d(x)^2 being a polynomial.
  const double a = 0.01, b = 0.01 * (taper - 1.0), inner2 = 0.002 * 0.002;
  const auto power = [](double p) { return 1.0 / (p + 1.0); };
  const auto squares = [&](double p) {  // int x^p d^2
    return a * a * power(p) + 2.0 * a * b * power(p + 1) + b * b * power(p + 2);
  };
  const auto fourths = [&](double p) {  // int x^p d^4
    return a * a * squares(p) + 2.0 * a * b * squares(p + 1) + b * b * squares(p + 2);
  };
  const double density = rod.backbone_mass / (squares(0) - inner2);
  for (const int n : {min_nodes, 7, 12, detail::max_rod_nodes}) {
    const detail::RodRule rule(rod, n);
    REQUIRE(static_cast<int>(rule.nodes.size()) == n);
    CHECK(rule.nodes.back().x == 1.0);
    CHECK(rule.frames.front().x == 0.0);
    CHECK(rule.frames.back().x == 1.0);
    for (int p = 0; p <= 2 * n - 1; ++p) {
      INFO(n, " nodes, power ", p);
      double mass = density * (squares(p) - inner2 * power(p));
      double inertia = density * (fourths(p) - inner2 * inner2 * power(p)) / 16.0;
      for (const Disk& disk : rod.disks) {
        mass += disk.mass * std::pow(disk.position, p);
        inertia += disk.mass * disk.diameter * disk.diameter / 16.0 * std::pow(disk.position, p);
      }
      double sum = 0.0, inertia_sum = 0.0;
      for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        sum += rule.mass[k] * std::pow(rule.nodes[k].x, p);
      }
      for (std::size_t k = 0; k < rule.frames.size(); ++k) {
        inertia_sum += rule.inertia[k] * std::pow(rule.frames[k].x, p);
      }
      if (p > 0) CHECK(residual(sum, mass) <= tolerance::cancelled);  // the base is left out
      // From 24 nodes on those of frames are weights of interpolation.
      const int num_frames = static_cast<int>(rule.frames.size());
      if (p <= (n < 24 ? 2 * num_frames - 3 : num_frames - 1)) {
        CHECK(residual(inertia_sum, inertia) <= tolerance::cancelled);
      }
      if (p > 2 * detail::num_neighbours - 1) continue;
      double from = 0.0;
      for (const detail::RodNode& node : rule.nodes) {
        double integral = 0.0;
        auto at = rule.frames.begin() + node.first_neighbour;
        for (const auto& [value, slope] : node.integral) {
          integral += value * std::pow(at->x, p);
          if (p > 0) integral += slope * p * std::pow(at->x, p - 1);
          ++at;
        }
        const double expected = std::pow(node.x, p + 1) - std::pow(from, p + 1);
        CHECK(residual(integral, expected / (p + 1), 1.0) <= tolerance::cancelled);
        from = node.x;
      }
    }
  }
}

TEST_CASE("a backbone without mass leaves the disks") {
  const detail::RodMass rod{0.0, 0.01, 0.01, 0.0, {{0.3, 0.1, 0.05}, {1.0, 0.2, 0.05}}};
  const detail::RodRule rule(rod, 12);
  for (int p = 1; p <= 12; ++p) {
    double sum = 0.0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      sum += rule.mass[k] * std::pow(rule.nodes[k].x, p);
    }
    CHECK(residual(sum, 0.1 * std::pow(0.3, p) + 0.2) <= tolerance::cancelled);
  }
}

TEST_CASE("on dual numbers, the gradient of the potential energy is its derivative") {
  using detail::Dual;
  const auto state = std::make_unique<RodChain>();
  const auto duals = std::make_unique<detail::ChainState<Rod<Dual>>>();
  for (const Json& reference : rod_cases()) {
    const Chain chain = rod_chain(reference, 8);
    const VectorXd q = reference["q"].vector();
    state->update_position(chain, q.data());
    VectorXd gradient(q.size());
    detail::weight_gradient(chain, *state, q.data(), gradient.data());
    MatrixXd slope = MatrixXd::Zero(q.size(), q.size());
    detail::differentiate(q.size(), q.data(), slope, 1.0, [&](const Dual* at, Dual* U) {
      duals->update_position(chain, at);
      U[0] = detail::potential_energy_of(chain, *duals, at);
    });
    CHECK(residual(slope.row(0).transpose(), gradient) <= tolerance::recursion);
  }
}

TEST_CASE("cables pull with the slope of their length, and straight ones as on an arc") {
  Random random;
  for (int i = 0; i < test_count(); ++i) {
    const bool straight = i % 2 == 0;
    INFO(random, ", cable ", i);
    Section section = amouri2020().sections[0];
    const detail::RodParameters rod(described_rod(section, 2, straight ? -1 : 1, 1));
    const double radius = random.uniform(0.01, 0.05), angle = random.uniform(-pi, pi);
    const double converging = random.uniform(0.5, 1.0), winding = random.uniform(-pi, pi);
    const RodCable cable(
        rod, straight ? CableRoute{radius, radius, angle, angle}
                      : CableRoute{radius, converging * radius, angle, angle + winding});
    VectorXd q = random.vector(rod.size(), 1.0), force = VectorXd::Zero(rod.size());
    q.tail(2) *= 0.1 * rod.length;
    const double tension = random.uniform(1.0, 10.0);
    const double length = cable.length(rod, q.data(), tension, force.data());
    for (Index k = 0; k < q.size(); ++k) {
      const double slope = difference(
          [&](double step) {
            VectorXd at = q, unused = q;
            at[k] += step;
            return cable.length(rod, at.data(), 0.0, unused.data());
          },
          1e-3);
      CHECK(residual(force[k], -tension * slope, tension) <= tolerance::recursion_differences);
    }
    if (!straight) continue;
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    CHECK(residual(length, rod.length + q[6] - x * q[0] - y * q[1]) <= tolerance::rounding);
    VectorXd expected = VectorXd::Zero(rod.size());
    expected.head(2) << tension * x, tension * y;
    expected[6] = -tension;
    CHECK(residual(force, expected) <= tolerance::rounding);
  }
}

TEST_CASE("cables summed up together pull as one by one, whatever their numbers of points") {
  Random random;
  const detail::RodParameters rod(described_rod(amouri2020().sections[0], 2, 1, 1));
  std::vector<RodCable> cables;
  for (const double winding : {0.0, 0.0, 6.0 * pi, -6.0 * pi, 1.0, 0.0}) {
    cables.emplace_back(rod, CableRoute{0.02, 0.01, 0.3, 0.3 + winding});
  }
  for (int i = 0; i < test_count(); ++i) {
    INFO(random);
    VectorXd q = random.vector(rod.size(), 1.0), together = VectorXd::Zero(rod.size()),
             alone = together;
    q.tail(2) *= 0.1 * rod.length;
    detail::RodCables<double> all(rod, q.data(), together.data());
    for (const RodCable& cable : cables) {
      const double tension = random.uniform(1.0, 10.0);
      const double length = cable.length(rod, q.data(), tension, alone.data());
      CHECK(residual(all.add(cable, tension), length) <= tolerance::rounding);
    }
    all.finish();
    CHECK(residual(together, alone) <= tolerance::rounding);
  }
}

TEST_CASE("motion of rods, and their cables, allocate nothing") {
  const auto state = std::make_unique<RodChain>();
  for (const Json& reference : rod_cases()) {
    const Chain chain = rod_chain(reference, 12);
    const VectorXd q = reference["q"].vector(), qd = reference["qd"].vector();
    VectorXd force = VectorXd::Zero(q.size()), qdd = force;
    MatrixXd M(q.size(), q.size());
    const detail::RodParameters& rod = *chain.sections[0].rod;
    const RodCable cable(rod, {0.01, 0.02, 0.0, 1.0});
    state->update_position(chain, q.data());  // takes room for the first time
    CHECK(allocations_of([&] { state->update(chain, q.data(), qd.data()); }) == 0);
    CHECK(allocations_of(
              [&] { detail::forward_motion(chain, *state, force.data(), qdd.data()); }) == 0);
    CHECK(allocations_of(
              [&] { detail::inverse_motion(chain, *state, qdd.data(), force.data()); }) == 0);
    CHECK(allocations_of([&] { detail::mass_matrix(chain, *state, M); }) == 0);
    CHECK(allocations_of([&] { cable.length(rod, q.data(), 1.0, force.data()); }) == 0);
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
