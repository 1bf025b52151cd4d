// Robots of several sections against the slow sum over all their elements.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>

#include "cdcr/dynamics.hpp"
#include "support/cases.hpp"
#include "support/chain_cases.hpp"
#include "support/chain_sum.hpp"
#include "support/residual.hpp"

namespace cdcr::test {
namespace {

// Relative to the natural size of each coordinate, each a few times the largest residual seen in
// two hundred robots. The recursion adds a rounding or two for each section.
constexpr double rounding = 3e-14;
// Bent by a full turn, a section loses most of the inertia that its M_ii is compared with.
constexpr double inertia = 3e-14;
// As far as differences of differences in extended precision can tell.
constexpr double lagrange = 5e-14;

/// What the slow sum says about a state; made once, as it takes a third of a second at n = 8.
struct Reference {
  ChainState state;
  RealMatrix M;
  RealVector h, gradient, bias_scale;
  Real kinetic, potential;
};

struct Chain {
  Model model;
  ChainSum sum;
  std::vector<Reference> references;
};

Reference reference(const Model& model, const ChainSum& sum, const ChainState& state) {
  const RealVector q = state.q.cast<Real>(), qd = state.qd.cast<Real>();
  Reference r{state, sum.mass_matrix(q),        sum.bias(q, qd),        sum.potential_gradient(q),
              {},    sum.kinetic_energy(q, qd), sum.potential_energy(q)};
  r.bias_scale = bias_scale(model, sum, r.M, state);
  return r;
}

/// Random robots of 1 to 8 sections in turn.
const std::vector<Chain>& chains() {
  static const std::vector<Chain> all = [] {
    std::vector<Chain> made;
    Random random;
    for (int i = 0; i < test_count(); ++i) {
      const Robot robot = random_chain(random, 1 + i % 8);
      made.push_back({Model(robot), ChainSum(robot), {}});
      Chain& chain = made.back();
      for (const ChainState& state : chain_states(chain.model, random)) {
        chain.references.push_back(reference(chain.model, chain.sum, state));
      }
    }
    return made;
  }();
  return all;
}

/// body(model, data, sum, reference) for every robot in every sample state.
template <class Body>
void for_each_chain(Body body) {
  for (const Chain& chain : chains()) {
    Data data(chain.model);
    for (const Reference& r : chain.references) {
      INFO(Random(), ", sections: ", chain.model.num_sections(), ", state: ", r.state.name);
      body(chain.model, data, chain.sum, r);
    }
  }
}

/// Every entry against its own scale.
template <class Actual, class Expected, class Scale>
void check_each(const Eigen::MatrixBase<Actual>& actual,
                const Eigen::MatrixBase<Expected>& expected, const Eigen::MatrixBase<Scale>& scale,
                double tolerance) {
  const RealMatrix error = (actual.template cast<Real>() - expected.template cast<Real>())
                               .cwiseQuotient(scale.template cast<Real>());
  CHECK(residual(error, RealMatrix::Zero(error.rows(), error.cols()), 1.0) <= tolerance);
}

TEST_SUITE_BEGIN("sections");

TEST_CASE("mass matrix") {
  for_each_chain([](const Model& model, Data& data, const ChainSum&, const Reference& r) {
    MatrixXd M(model.num_coordinates(), model.num_coordinates());
    mass_matrix(model, data, r.state.q, M);
    const RealVector root = r.M.diagonal().cwiseSqrt();
    check_each(M, r.M, root * root.transpose(), inertia);
  });
}

TEST_CASE("kinetic and potential energy") {
  for_each_chain([](const Model& model, Data& data, const ChainSum& sum, const Reference& r) {
    const double T = kinetic_energy(model, data, r.state.q, r.state.qd);
    CHECK(residual(T, r.kinetic) <= rounding);
    const double U = potential_energy(model, data, r.state.q);
    const Real scale = std::abs(r.potential) + sum.weight_scale()[0];
    CHECK(residual(U, r.potential, scale) <= rounding);
  });
}

TEST_CASE("gradient of the potential energy") {
  for_each_chain([](const Model& model, Data& data, const ChainSum& sum, const Reference& r) {
    VectorXd gradient(model.num_coordinates());
    potential_gradient(model, data, r.state.q, gradient);
    check_each(gradient, r.gradient, sum.weight_scale() + r.gradient.cwiseAbs(), rounding);
  });
}

TEST_CASE("bias is Lagrange's") {
  for_each_chain([](const Model& model, Data& data, const ChainSum&, const Reference& r) {
    VectorXd h(model.num_coordinates());
    bias(model, data, r.state.q, r.state.qd, h);
    check_each(h, r.h, r.bias_scale, lagrange);
  });
}

TEST_CASE("accelerations solve M qdd + h = B F + Q, with Q of wrenches") {
  Random random;
  for_each_chain([&](const Model& model, Data& data, const ChainSum& sum, const Reference& r) {
    const ChainState& state = r.state;
    RealVector given = model.actuation_matrix().cast<Real>() * state.tension.cast<Real>();
    // Compared with what each coordinate would feel if nothing in M qdd cancelled.
    const auto check = [&](const VectorXd& qdd) {
      const RealVector felt = r.M.cwiseAbs() * qdd.cast<Real>().cwiseAbs();
      check_each(r.M * qdd.cast<Real>() + r.h, given, felt + r.bias_scale + given.cwiseAbs(),
                 lagrange);
    };
    VectorXd qdd(model.num_coordinates());
    forward_dynamics(model, data, state.q, state.qd, state.tension, qdd);
    check(qdd);

    const Wrenches wrenches = random_wrenches(model, 2, random);
    forward_dynamics(model, data, state.q, state.qd, state.tension, wrenches, qdd);
    for (const Wrench& wrench : wrenches) {
      given += sum.wrench_force(state.q.cast<Real>(), wrench);
    }
    check(qdd);
  });
}

TEST_CASE("one section by the general recursion is the closed form") {
  // A payload that resists turning, if only just: no closed form is made for it.
  Random random;
  for (int i = 0; i < test_count(); ++i) {
    Robot robot = random_robot(random);
    if (robot.payload == 0.0) robot.payload = 1e-3;
    const Model closed(robot);
    robot.payload_inertia = 1e-40 * Matrix3d::Identity();
    const Model general(robot);
    REQUIRE(closed.has_closed_form());
    REQUIRE(!general.has_closed_form());
    Data closed_data(closed), general_data(general);
    const ChainSum sum(robot);
    for (const ChainState& state : chain_states(closed, random)) {
      INFO(random, ", robot: ", i, ", state: ", state.name);
      MatrixXd M(2, 2), M_general(2, 2);
      mass_matrix(closed, closed_data, state.q, M);
      mass_matrix(general, general_data, state.q, M_general);
      check_each(M_general, M, MatrixXd::Constant(2, 2, largest(M)), rounding);

      const RealVector size = bias_scale(closed, sum, M.cast<Real>(), state);
      VectorXd h(2), h_general(2), qdd(2), qdd_general(2);
      bias(closed, closed_data, state.q, state.qd, h);
      bias(general, general_data, state.q, state.qd, h_general);
      check_each(h_general, h, size, rounding);

      forward_dynamics(closed, closed_data, state.q, state.qd, state.tension, qdd);
      forward_dynamics(general, general_data, state.q, state.qd, state.tension, qdd_general);
      // M^-1 magnifies what rounding does to the forces.
      const VectorXd felt = size.cast<double>() + M.cwiseAbs() * qdd.cwiseAbs();
      const VectorXd reach = M.inverse().cwiseAbs() * felt;
      check_each(qdd_general, qdd, reach, rounding);

      const double energy = potential_energy(closed, closed_data, state.q);
      CHECK(residual(potential_energy(general, general_data, state.q), energy,
                     std::abs(energy) + sum.weight_scale()[0]) <= rounding);
      const double speed = M.norm() * state.qd.squaredNorm();
      CHECK(residual(kinetic_energy(general, general_data, state.q, state.qd),
                     kinetic_energy(closed, closed_data, state.q, state.qd), speed) <= rounding);
    }
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
