// Natural frequencies and mode shapes: closed forms, orthogonality, damping, and loss of stability.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "cdcr/dynamics.hpp"
#include "cdcr/linearization.hpp"
#include "cdcr/modes.hpp"
#include "cdcr/statics.hpp"
#include "support/cases.hpp"
#include "support/chain_cases.hpp"
#include "support/residual.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

/// Eigenvectors of matrices whose condition is up to about 1e4.
constexpr double eigen = 1e-10;

TEST_SUITE_BEGIN("modes");

TEST_CASE("one straight section swings at w^2 = K/a in every direction") {
  Robot robot = amouri2020();
  robot.sections[0].damping = 1e-3;
  const Model model(robot);
  Data data(model);
  const VectorXd straight = VectorXd::Zero(2), none = VectorXd::Zero(3);
  MatrixXd M(2, 2);
  mass_matrix(model, data, straight, M);
  const double a = M(0, 0), K = model.stiffness()[0];
  const Modes found = modes(model, straight, none);
  const double w = std::sqrt(K / a);
  CHECK(std::abs(w - 9.0965) < 5e-5);
  CHECK(residual(found.frequency, Eigen::Vector2d::Constant(w)) <= eigen);
  CHECK(residual(found.squared_frequency, Eigen::Vector2d::Constant(K / a)) <= eigen);
  CHECK(residual(MatrixXd(found.shape.transpose() * found.shape),
                 MatrixXd(MatrixXd::Identity(2, 2) / a)) <= eigen);
  const double zeta = 1e-3 / (2.0 * a * w);
  CHECK(residual(found.damping_ratio, Eigen::Vector2d::Constant(zeta)) <= eigen);
  for (Index i = 0; i < 4; ++i) {
    CHECK(residual(std::abs(found.eigenvalues[i]), w) <= eigen);
    CHECK(residual(-found.eigenvalues[i].real(), zeta * w) <= eigen);
  }
  CHECK(found.stable);
}

TEST_CASE("modes are orthonormal in M, diagonal in K, and A has their eigenvalues") {
  Random random;
  INFO(random);
  for (const int n : {1, 2, 3, 6}) {
    CAPTURE(n);
    Robot robot = random_chain(random, n);
    robot.gravity *= 0.1;
    for (Section& section : robot.sections) section.damping = 0.0;
    const Model model(robot);
    const Index m = 2 * n;
    Data data(model);
    const VectorXd q = random_bending(n, 1.0, random);
    const VectorXd none = VectorXd::Zero(model.num_cables());
    MatrixXd M(m, m), K(m, m);
    mass_matrix(model, data, q, M);
    potential_hessian(model, data, q, K);
    const Modes found = modes(model, q, none);
    const MatrixXd unit = found.shape.transpose() * M * found.shape;
    const MatrixXd squares = found.shape.transpose() * K * found.shape;
    CHECK(residual(unit, MatrixXd::Identity(m, m)) <= eigen);
    CHECK(residual(squares, MatrixXd(found.squared_frequency.asDiagonal())) <= eigen);
    // Without damping the eigenvalues of the motion are +-i w where the shape is at rest; about a
    // shape held there they miss nothing but the force that holds it, which M^-1 turns with q.
    const Equilibrium rest = equilibrium(model, none);
    if (rest.status != Status::ok || !rest.stable) continue;
    const Modes at_rest = modes(model, rest.q, none);
    CHECK(at_rest.stable);
    for (Index i = 0; i < m; ++i) {
      CHECK(residual(std::abs(at_rest.eigenvalues[2 * i].imag()), at_rest.frequency[i],
                     at_rest.frequency[m - 1]) <= eigen);
    }
  }
}

TEST_CASE("a column that has buckled has a negative square and no frequency") {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  robot.payload = 0.5;
  const Modes found = modes(Model(robot), VectorXd::Zero(2), VectorXd::Zero(3));
  CHECK(found.squared_frequency[0] < 0.0);
  CHECK(found.frequency[0] == 0.0);
  CHECK(found.damping_ratio[0] == 0.0);
  CHECK_FALSE(found.stable);
  CHECK(found.eigenvalues.real().maxCoeff() > 0.0);
}

TEST_CASE("springs of cables raise the frequency by what they add to the stiffness") {
  Robot robot = amouri2020();
  robot.sections[0].cable_stiffness = 800.0;
  const Model model(robot), bare(amouri2020());
  const VectorXd straight = VectorXd::Zero(2);
  const VectorXd taut = model.straight_lengths().array() - 1e-3;
  const double r = robot.sections[0].cable_radius;
  const double with = model.stiffness()[0] + 1.5 * 800.0 * r * r;  // sum of e e^T = 3/2
  const double squared = modes(bare, straight, VectorXd::Zero(3)).squared_frequency[0];
  CHECK(residual(modes(model, straight, taut).squared_frequency[0],
                 squared * with / model.stiffness()[0]) <= eigen);
  const VectorXd slack = model.straight_lengths().array() + 1e-3;
  CHECK(residual(modes(model, straight, slack).squared_frequency[0], squared) <= eigen);
}

TEST_CASE("a follower force flutters: the eigenvalues tell, the static stiffness does not") {
  // Beck's column: a force along the tip's axis, towards the base, has no static buckling.
  Robot robot = amouri2020();
  Section part = robot.sections[0];
  part.length /= 4.0;
  part.backbone_mass /= 4.0;
  part.num_disks = 0;
  part.cable_angles.clear();
  robot.sections = {part, part, part, part};
  const Model model(robot);
  const double EI = part.stiffness() * part.length, l = 4.0 * part.length;
  const VectorXd straight = VectorXd::Zero(8), none(0);
  const auto under = [&](double share) {  // of Beck's load, 20.05 EI/l^2
    const Wrench push{
        3, 1.0, {0.0, 0.0, -share * 20.05 * EI / (l * l)}, Vector3d::Zero(), Wrench::Frame::local};
    return modes(model, straight, none, {push});
  };
  CHECK(under(0.9).eigenvalues.real().maxCoeff() <= 1e-9 * std::abs(under(0.9).eigenvalues[15]));
  CHECK_FALSE(under(1.2).stable);
  CHECK(under(1.2).eigenvalues.real().maxCoeff() > 0.1);
}

TEST_CASE("bad arguments and robots without inertia are refused") {
  const Model model(amouri2020());
  const VectorXd none = VectorXd::Zero(3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_SENTENCE(modes(model, VectorXd::Zero(3), none),
                        "q must be 2 finite values, got [0 0 0]");
  CHECK_THROWS_SENTENCE(modes(model, Eigen::Vector2d(nan, 0.0), none),
                        "q must be 2 finite values, got [nan   0]");
  CHECK_THROWS_SENTENCE(modes(model, Eigen::Vector2d(10.0, 0.0), none),
                        "q must bend each section by at most 3 pi rad, got 10 rad in section 1");
  CHECK_THROWS_SENTENCE(modes(model, VectorXd::Zero(2), -VectorXd::Ones(3)),
                        "tension must be 3 finite values >= 0 N (a cable cannot push), got "
                        "[-1 -1 -1]");
  Robot light = amouri2020();
  light.sections[0].backbone_mass = light.sections[0].disk_mass = 0.0;
  CHECK_THROWS_AS(static_cast<void>(modes(Model(light), VectorXd::Zero(2), none)),
                  std::invalid_argument);
}

TEST_CASE("what overflows is refused") {
  const std::string sentence =
      "are not finite: the masses, the stiffnesses or the loads are too large or too far apart for "
      "double precision";
  Robot stiff = amouri2020();
  stiff.sections.push_back(stiff.sections[0]);
  for (Section& section : stiff.sections) section.cable_stiffness = 1e306;
  CHECK_THROWS_SENTENCE(modes(Model(stiff), VectorXd::Zero(4), VectorXd::Zero(6)),
                        ("the modes at q = [0 0 0 0] " + sentence).c_str());
  Robot chain = amouri2020();
  chain.sections.resize(2, chain.sections[0]);
  Wrench huge;
  huge.section = 1;
  huge.force = Vector3d::Constant(1.7e308);
  CHECK_THROWS_SENTENCE(modes(Model(chain), VectorXd::Constant(4, 2.0), VectorXd::Zero(6), {huge}),
                        ("the modes at q = [2 2 2 2] " + sentence).c_str());
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
