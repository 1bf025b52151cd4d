// The polynomials a, b, G_A, G_S and their derivatives, directly.
#include <doctest/doctest.h>

#include <cmath>

#include "cdcr/model.hpp"
#include "dynamics/parts.hpp"
#include "support/cases.hpp"
#include "support/element_sum.hpp"
#include "support/residual.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

using Group = detail::ShapeTable::Group;
using Four = Eigen::Matrix<Real, 4, 1>;

Four read(const Model& model, Group group, double sigma) {
  const auto values = detail::single_of(model).table(group, sigma);
  return Four(values[0], values[1], values[2], values[3]);
}

/// a, b, G_A, G_S by the sum over elements; sigma must not be small, where b = (M11 - a)/sigma
/// loses its digits even in extended precision.
Four summed(const ElementSum& sum, Real sigma) {
  const Real theta = std::sqrt(sigma);
  const Real22 M = sum.mass_matrix(Real2(theta, 0.0L));
  return Four(M(1, 1), (M(0, 0) - M(1, 1)) / sigma, sum.G_A(theta), sum.G_S(theta));
}

/// Sizes of a, b, G_A, G_S and of their derivatives: the values at the straight section.
Four scales(const Model& model) {
  const Four inertia = read(model, Group::inertia, 0.0), weight = read(model, Group::gravity, 0.0);
  return Four(inertia[0], std::abs(inertia[1]) + inertia[0], weight[0], weight[1]);
}

/// The same in the order of a group.
Four scales(const Model& model, Group group) {
  const Four all = scales(model);
  if (group == Group::inertia) return Four(all[0], all[1], all[0], all[1]);
  if (group == Group::gravity) return Four(all[2], all[3], all[2], all[3]);
  return all;
}

void check(const Four& actual, const Four& expected, const Four& scale, double tolerance) {
  for (int f = 0; f < 4; ++f) {
    INFO("function ", f);
    CHECK(residual(actual[f], expected[f], scale[f]) <= tolerance);
  }
}

TEST_SUITE_BEGIN("shape_table");

TEST_CASE("a, b, G_A, G_S are sums over elements") {
  for_each_case(2.0 * pi, [](const Model& model, Data&, const State& state) {
    if (state.theta < 0.5) return;
    const double sigma = state.theta * state.theta;
    const Four a = read(model, Group::inertia, sigma), g = read(model, Group::gravity, sigma);
    check(Four(a[0], a[1], g[0], g[1]), summed(ElementSum(model.robot()), sigma), scales(model),
          tolerance::model);
  });
}

TEST_CASE("first and second derivatives with respect to sigma") {
  for_each_case(2.0 * pi, [](const Model& model, Data&, const State& state) {
    if (state.theta < 0.5) return;
    const double sigma = state.theta * state.theta;
    const ElementSum sum(model.robot());
    const Four first = derivative<Four>([&](Real step) { return summed(sum, sigma + step); });
    // The second by differences of the first, once that is known to be right.
    const auto first_at = [&](Real step) {
      const auto at = static_cast<double>(sigma + step);
      const Four a = read(model, Group::inertia, at), g = read(model, Group::gravity, at);
      return Four(a[2], a[3], g[2], g[3]);
    };
    check(first_at(0.0L), first, scales(model), tolerance::model);
    check(read(model, Group::second, sigma), derivative<Four>(first_at, 1.0L / 32.0L),
          scales(model), tolerance::model_second);
  });
}

TEST_CASE("the pieces join: value and derivatives agree on both sides") {
  Random random;
  for (const NamedRobot& sample : sample_robots(random)) {
    const Model model(sample.robot);
    for (int piece = 1; piece < 4; ++piece) {
      INFO(random, ", robot: ", sample.name, ", joint ", piece);
      // A joint lies at each multiple of pi^2; one rounding error to either side of it.
      const double joint = piece * pi * pi;
      for (const Group group : {Group::inertia, Group::gravity, Group::second}) {
        const Four before = read(model, group, joint * (1.0 - 1e-15));
        const Four after = read(model, group, joint * (1.0 + 1e-15));
        check(after, before, scales(model, group),
              group == Group::second ? tolerance::model_second : tolerance::model);
      }
    }
  }
}

TEST_CASE("at the straight section: the first terms of the series, by hand") {
  // With A = 1/2 - y^2/24 and S = 1 - y^2/6 at y = x theta, for one disk at the tip and nothing
  // else: a = m l^2/4 + I_t, G_A = m/2, G_S = m, G_A' = -m/24, G_S' = -m/6.
  Robot robot = amouri2020();
  robot.sections[0].num_disks = 1;
  robot.sections[0].backbone_mass = 0.0;
  const Model model(robot);
  const double m = 0.0082, l = 0.802, I_t = m * 0.04 * 0.04 / 16.0;
  const Four inertia = read(model, Group::inertia, 0.0), weight = read(model, Group::gravity, 0.0);
  CHECK(residual(inertia[0], m * l * l / 4.0 + I_t) <= tolerance::rounding);
  CHECK(residual(weight[0], m / 2.0) <= tolerance::rounding);
  CHECK(residual(weight[1], m) <= tolerance::rounding);
  CHECK(residual(weight[2], -m / 24.0) <= tolerance::rounding);
  CHECK(residual(weight[3], -m / 6.0) <= tolerance::rounding);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
