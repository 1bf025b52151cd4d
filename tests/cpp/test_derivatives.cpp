// Derivatives of the motion and of the potential energy against the same recursions run as a whole
// on dual numbers: they agree to rounding.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <memory>

#include "cdcr/dynamics.hpp"
#include "cdcr/linearization.hpp"
#include "cdcr/statics.hpp"
#include "chain/forward.hpp"
#include "chain/gradient.hpp"
#include "derivatives/dual.hpp"
#include "loads/total_force.hpp"
#include "support/cable_robots.hpp"
#include "support/chain_cases.hpp"
#include "support/residual.hpp"
#include "support/rod_robots.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

using detail::Dual;

struct Point {
  VectorXd q, qd, command;
  Wrenches wrenches;
};

/// (d, 2 d + num_cables): accelerations by q, qd and commands.
template <class Section>
MatrixXd accelerations_on_duals(const Model& model, const Point& at) {
  const detail::Chain& chain = detail::chain_of(model);
  const Index d = model.num_coordinates(), c = model.num_cables();
  const auto state = std::make_unique<detail::ChainState<Section>>();
  std::vector<Dual> x, force(static_cast<std::size_t>(d)), qdd(force.size());
  for (const VectorXd* part : {&at.q, &at.qd, &at.command}) {
    for (const double value : *part) x.emplace_back(value);
  }
  MatrixXd J(d, 2 * d + c);
  for (Index first = 0; first < J.cols(); first += Dual::width) {
    const int count = static_cast<int>(std::min<Index>(Dual::width, J.cols() - first));
    for (int k = 0; k < count; ++k) x[first + k].slopes[k] = 1.0;
    detail::total_force<Dual>(model, x.data(), x.data() + d, x.data() + 2 * d, at.wrenches,
                              force.data());
    state->update_position(chain, x.data());
    state->update_velocity(chain, x.data() + d);
    const Dual* given = force.data();
    if constexpr (Section::m == Eigen::Dynamic) {
      forward_dynamics_of_many(chain, *state, given, qdd.data());
    } else {
      forward_dynamics(chain, *state, given, qdd.data());
    }
    for (int k = 0; k < count; ++k) {
      for (Index i = 0; i < d; ++i) J(i, first + k) = qdd[i].slopes[k];
      x[first + k].slopes[k] = 0.0;
    }
  }
  return J;
}

/// Derivatives of dU/dq less the force of wrenches.
template <class Section>
MatrixXd gradients_on_duals(const Model& model, const Point& at) {
  const detail::Chain& chain = detail::chain_of(model);
  const auto state = std::make_unique<detail::ChainState<Section>>();
  MatrixXd H = MatrixXd::Zero(at.q.size(), at.q.size());
  detail::differentiate(at.q.size(), at.q.data(), H, 1.0, [&](const Dual* x, Dual* y) {
    std::vector<Dual> pull(static_cast<std::size_t>(at.q.size()), Dual(0.0));
    detail::add_wrench_force(chain, x, at.wrenches, pull.data());
    state->update_position(chain, x);
    potential_gradient(chain, *state, x, y);
    for (Index i = 0; i < at.q.size(); ++i) y[i] -= pull[i];
  });
  return H;
}

/// The condition of the mass matrix, which both ways divide by.
double condition(const Model& model, Data& data, const VectorXd& q) {
  MatrixXd M(q.size(), q.size());
  mass_matrix(model, data, q, M);
  const VectorXd size = M.diagonal().cwiseSqrt().cwiseInverse();
  const VectorXd eigenvalues =
      (size.asDiagonal() * M * size.asDiagonal()).selfadjointView<Eigen::Lower>().eigenvalues();
  return eigenvalues.maxCoeff() / eigenvalues.minCoeff();
}

template <class Section>
void check(const Model& model, Data& data, const Point& at) {
  const Index d = model.num_coordinates(), c = model.num_cables();
  MatrixXd A(2 * d, 2 * d), B(2 * d, c), alone(2 * d, 2 * d), K(d, d);
  linearize(model, data, at.q, at.qd, at.command, at.wrenches, A, B);
  state_jacobian(model, data, at.q, at.qd, at.command, at.wrenches, alone);
  CHECK(residual(alone, A) <= tolerance::rounding);
  const MatrixXd J = accelerations_on_duals<Section>(model, at);
  const double bound = tolerance::rounding * condition(model, data, at.q);
  CHECK(residual(A.bottomLeftCorner(d, d), J.leftCols(d)) <= bound);
  // The straight robot without damping has none; then a frequency is the scale.
  const double rate = std::sqrt(largest(J.leftCols(d))) + largest(J.middleCols(d, d));
  CHECK(residual(A.bottomRightCorner(d, d), J.middleCols(d, d), rate) <= bound);
  if (c > 0) CHECK(residual(B.bottomRows(d), J.rightCols(c)) <= bound);

  const auto w = static_cast<Index>(at.wrenches.size());
  MatrixXd on_q(d, d), on_qd(d, d), on_command(d, c), on_wrenches(d, 6 * w);
  acceleration_derivatives(model, data, at.q, at.qd, at.command, at.wrenches, on_q, on_qd,
                           on_command, on_wrenches);
  CHECK(residual(on_q, A.bottomLeftCorner(d, d)) <= tolerance::rounding);
  CHECK(residual(on_qd, A.bottomRightCorner(d, d)) <= tolerance::rounding);
  if (c > 0) CHECK(residual(on_command, B.bottomRows(d)) <= tolerance::rounding);
  if (w > 0) {  // they are linear in the wrenches
    VectorXd components(6 * w), with(d), without(d);
    for (Index i = 0; i < w; ++i)
      components.segment<6>(6 * i) << at.wrenches[i].force, at.wrenches[i].moment;
    forward_dynamics(model, data, at.q, at.qd, at.command, at.wrenches, with);
    forward_dynamics(model, data, at.q, at.qd, at.command, without);
    CHECK(residual(VectorXd(on_wrenches * components), VectorXd(with - without),
                   largest(with) + largest(without)) <= bound);
  }

  static_stiffness(model, data, at.q, VectorXd::Zero(c), at.wrenches, K);
  if (model.has_plain_cables()) {
    CHECK(residual(K, gradients_on_duals<Section>(model, at)) <= tolerance::recursion);
  }
}

TEST_SUITE_BEGIN("derivatives");

TEST_CASE("one section in closed form") {
  Random random;
  for_each_case(1.7 * pi, [&](const Model& model, Data& data, const State& state) {
    for (const int num_wrenches : {0, 1}) {
      check<detail::ConstantCurvature<Dual>>(
          model, data,
          {state.q, state.qd, state.tension, random_wrenches(model, num_wrenches, random)});
    }
  });
}

TEST_CASE("arcs: those of the whole chain on dual numbers") {
  Random random;
  for_each_chain({1, 2, 3, 8, 20}, [&](const Model& model, Data& data, const ChainState& state) {
    check<detail::ConstantCurvature<Dual>>(
        model, data, {state.q, state.qd, state.tension, random_wrenches(model, 2, random)});
  });
}

TEST_CASE("arcs with cables that rub or are driven by length") {
  Random random;
  for (const int n : {1, 2, 3, 6}) {
    for (const double friction : {0.0, 1.0}) {
      INFO(random, ", sections: ", n, ", friction: ", friction);
      Robot robot = rubbing_chain(random, n);
      for (Section& section : robot.sections) section.cable_friction *= friction;
      for (Cable& cable : robot.cables) {
        if (cable.friction) *cable.friction *= friction;
      }
      const Model model(robot);
      Data data(model);
      const VectorXd q = random_shape(model, random);
      check<detail::ConstantCurvature<Dual>>(
          model, data,
          {q, random.vector(q.size(), 3.0), random_command(model, q, 10.0, random),
           random_wrenches(model, 1, random)});
    }
  }
}

TEST_CASE("rods, mixed with arcs, under cables of every kind") {
  Random random;
  Robot many = rod_robot();  // sections of few and of many coordinates
  many.sections = {rod_section(1, 0, locked), rod_section(0, locked, locked),
                   rod_section(locked, locked, locked), rod_section(4, 3, 2),
                   rod_section(2, locked, 0)};
  many.cables.clear();
  many.payload_position = {0.01, 0.02, 0.03};
  Robot rubbing = rod_robot();
  for (Section& section : rubbing.sections) section.cable_friction = 0.2;
  for (const Robot& robot : {rod_robot(), many, rubbing}) {
    INFO(random, ", sections: ", robot.sections.size());
    const Model model(robot);
    Data data(model);
    const RodState s(model, 0.5, random);
    check<detail::Rod<Dual>>(model, data,
                             {s.q, s.qd, s.command, random_wrenches(model, 2, random)});
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
