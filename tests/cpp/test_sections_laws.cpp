// Identities of robots of several sections, whatever the numbers.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "cdcr/dynamics.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/linearization.hpp"
#include "support/chain_cases.hpp"
#include "support/residual.hpp"
#include "support/split.hpp"

namespace cdcr::test {
namespace {

// Relative to the terms that are added, each with a rounding or two for every section; the
// recursion after its inverse, over the condition of the mass matrix.
constexpr double rounding = 1e-14;
// Weights cancel where gravity is turned, and rotations are orthonormal to rounding only.
constexpr double turned = 1e-13;
// Differences of eighth order in double precision, of energies and forces, in steps of 0.02 rad.
constexpr double differences = 1e-12;
// The same of accelerations, which change faster: steps of 0.003 rad.
constexpr double linearized = 1e-10;

/// body(model, data, state) for random robots of these numbers of sections in sample states.
template <class Body>
void for_each_chain(const std::vector<int>& numbers, Body body) {
  Random random;
  for (const int n : numbers) {
    const Model model(random_chain(random, n));
    Data data(model);
    for (const ChainState& state : chain_states(model, random)) {
      INFO(random, ", sections: ", n, ", state: ", state.name);
      body(model, data, state);
    }
  }
}

MatrixXd mass_matrix_at(const Model& model, Data& data, const VectorXd& q) {
  MatrixXd M(q.size(), q.size());
  mass_matrix(model, data, q, M);
  return M;
}

VectorXd bias_at(const Model& model, Data& data, const VectorXd& q, const VectorXd& qd) {
  VectorXd h(q.size());
  bias(model, data, q, qd, h);
  return h;
}

VectorXd inverse_at(const Model& model, Data& data, const ChainState& state, const VectorXd& qdd) {
  VectorXd force(qdd.size());
  inverse_dynamics(model, data, state.q, state.qd, qdd, force);
  return force;
}

VectorXd forward_at(const Model& model, Data& data, const ChainState& state,
                    const VectorXd& force) {
  VectorXd qdd(force.size());
  forward_dynamics_force(model, data, state.q, state.qd, force, qdd);
  return qdd;
}

VectorXd gradient_at(const Model& model, Data& data, const VectorXd& q) {
  VectorXd gradient(q.size());
  potential_gradient(model, data, q, gradient);
  return gradient;
}

/// Central difference of eighth order in double precision.
template <class Function>
auto difference(const Function& f, double h) {
  using Value = decltype(f(h));
  Value sum = (f(h) - f(-h)) * (4.0 / 5.0);
  sum -= (f(2 * h) - f(-2 * h)) * (1.0 / 5.0);
  sum += (f(3 * h) - f(-3 * h)) * (4.0 / 105.0);
  sum -= (f(4 * h) - f(-4 * h)) * (1.0 / 280.0);
  return Value(sum / h);
}

TEST_SUITE_BEGIN("sections_laws");

const std::vector<int> all_numbers = {1, 2, 3, 8, 20, 32};

TEST_CASE("the mass matrix is symmetric, positive definite, and half the energy's Hessian") {
  for_each_chain(all_numbers, [](const Model& model, Data& data, const ChainState& state) {
    const MatrixXd M = mass_matrix_at(model, data, state.q);
    CHECK(M == M.transpose());
    const VectorXd root = M.diagonal().cwiseSqrt();
    const MatrixXd scaled = root.cwiseInverse().asDiagonal() * M * root.cwiseInverse().asDiagonal();
    CHECK(Eigen::SelfAdjointEigenSolver<MatrixXd>(scaled).eigenvalues().minCoeff() > 0.0);
    const double expected = 0.5 * state.qd.dot(M * state.qd);
    const double scale = root.dot(state.qd.cwiseAbs());
    CHECK(residual(kinetic_energy(model, data, state.q, state.qd), expected, scale * scale) <=
          rounding);
  });
}

TEST_CASE("inverse dynamics is M qdd + h, column by column") {
  for_each_chain(all_numbers, [](const Model& model, Data& data, const ChainState& state) {
    const Index size = model.num_coordinates();
    const MatrixXd M = mass_matrix_at(model, data, state.q);
    const VectorXd h = bias_at(model, data, state.q, state.qd);
    CHECK(residual(inverse_at(model, data, state, VectorXd::Zero(size)), h) <= rounding);
    for (Index k = 0; k < size; ++k) {
      // So large that h is beside it.
      const double qdd = 1e3 * (1.0 + h.norm() / M.col(k).norm());
      const VectorXd force = inverse_at(model, data, state, qdd * VectorXd::Unit(size, k));
      CHECK(residual((force - h) / qdd, M.col(k), largest(M)) <= rounding);
    }
  });
}

TEST_CASE("forward dynamics undoes inverse dynamics, and the other way round") {
  Random random;
  for_each_chain(all_numbers, [&](const Model& model, Data& data, const ChainState& state) {
    const MatrixXd M = mass_matrix_at(model, data, state.q);
    const VectorXd h = bias_at(model, data, state.q, state.qd);
    const MatrixXd inverse = M.inverse();
    const VectorXd qdd = random.vector(model.num_coordinates(), 100.0);
    const VectorXd felt = M.cwiseAbs() * qdd.cwiseAbs() + h.cwiseAbs();
    const VectorXd found = forward_at(model, data, state, inverse_at(model, data, state, qdd));
    CHECK(residual(found, qdd, largest(inverse.cwiseAbs() * felt)) <= rounding);

    const VectorXd force = model.actuation_matrix() * state.tension;
    const VectorXd moved = forward_at(model, data, state, force);
    const VectorXd moving = M.cwiseAbs() * inverse.cwiseAbs() * (force.cwiseAbs() + h.cwiseAbs());
    CHECK(residual(inverse_at(model, data, state, moved), force, largest(moving)) <= rounding);
  });
}

TEST_CASE("bias at rest is the gradient of the potential energy") {
  for_each_chain(all_numbers, [](const Model& model, Data& data, const ChainState& state) {
    const VectorXd rest = VectorXd::Zero(state.q.size());
    CHECK(residual(bias_at(model, data, state.q, rest), gradient_at(model, data, state.q)) <=
          rounding);
  });
}

TEST_CASE("gradient and Hessian are the derivatives of the potential energy") {
  for_each_chain({1, 2, 3, 8, 20}, [](const Model& model, Data& data, const ChainState& state) {
    const Index size = model.num_coordinates();
    MatrixXd H(size, size);
    potential_hessian(model, data, state.q, H);
    CHECK(residual(H, H.transpose()) <= rounding);
    const VectorXd gradient = gradient_at(model, data, state.q);
    const ChainSum sum(model.robot());
    const double weight = static_cast<double>(sum.weight_scale()[0]);
    const double energy = std::abs(potential_energy(model, data, state.q)) + weight;
    for (Index k = 0; k < size; ++k) {
      const auto moved = [&](double step) {
        return VectorXd(state.q + step * VectorXd::Unit(size, k));
      };
      const double slope =
          difference([&](double step) { return potential_energy(model, data, moved(step)); }, 0.02);
      CHECK(residual(slope, gradient[k], energy) <= differences);
      const VectorXd column =
          difference([&](double step) { return gradient_at(model, data, moved(step)); }, 0.02);
      CHECK(residual(column, H.col(k), largest(H) + weight) <= differences);
    }
  });
}

TEST_CASE("A and B of the linearisation are the derivatives of forward dynamics") {
  Random random;
  for_each_chain({1, 2, 3, 5}, [&](const Model& model, Data& data, const ChainState& state) {
    if (state.name == "bent up to a full turn") return;  // nearly singular: derivatives explode
    const Index size = model.num_coordinates(), num_cables = model.num_cables();
    MatrixXd A(2 * size, 2 * size), B(2 * size, num_cables);
    const Wrenches wrenches = random_wrenches(model, 2, random);
    linearize(model, data, state.q, state.qd, state.tension, wrenches, A, B);
    CHECK(A.topLeftCorner(size, size) == MatrixXd::Zero(size, size));
    CHECK(A.topRightCorner(size, size) == MatrixXd::Identity(size, size));
    CHECK(B.topRows(size) == MatrixXd::Zero(size, num_cables));

    const auto acceleration = [&](const ChainState& at) {
      VectorXd qdd(size);
      forward_dynamics(model, data, at.q, at.qd, at.tension, wrenches, qdd);
      return qdd;
    };
    const double scale = largest(A.bottomRows(size)) + largest(acceleration(state));
    const auto check = [&](const VectorXd& column, double width, auto part, Index k) {
      const auto shifted = [&](double step) {
        ChainState moved = state;
        (moved.*part)[k] += step;
        return acceleration(moved);
      };
      CHECK(residual(column.tail(size), difference(shifted, width), scale) <= linearized);
    };
    for (Index k = 0; k < size; ++k) {
      check(A.col(k), 0.003, &ChainState::q, k);
      check(A.col(size + k), 0.1, &ChainState::qd, k);
    }
    for (Index j = 0; j < num_cables; ++j) check(B.col(j), 1.0, &ChainState::tension, j);
  });
}

TEST_CASE("turning the base and gravity together changes nothing") {
  Random random;
  for_each_chain({1, 2, 3, 8}, [&](const Model& model, Data& data, const ChainState& state) {
    const Matrix3d R =
        Eigen::AngleAxisd(random.uniform(-pi, pi), random.vector(3, 1.0).normalized())
            .toRotationMatrix();
    Robot robot = model.robot();
    robot.base_orientation = R * robot.base_orientation;
    robot.gravity = R * robot.gravity;
    const Model other(robot);
    Data other_data(other);
    const ChainSum sum(model.robot());
    const VectorXd h = bias_at(model, data, state.q, state.qd);
    const double weight = static_cast<double>(sum.weight_scale()[0]);
    CHECK(residual(bias_at(other, other_data, state.q, state.qd), h, largest(h) + weight) <=
          turned);
    CHECK(residual(potential_energy(other, other_data, state.q),
                   potential_energy(model, data, state.q),
                   std::abs(potential_energy(model, data, state.q)) + weight) <= turned);
    CHECK(residual(mass_matrix_at(other, other_data, state.q),
                   mass_matrix_at(model, data, state.q)) <= rounding);
    CHECK(residual(tip(other, state.q).p, R * tip(model, state.q).p) <= turned);
  });
}

TEST_CASE("cutting sections into parts that bend alike changes nothing") {
  Random random;
  for_each_chain({1, 2, 3}, [&](const Model& model, Data& data, const ChainState& state) {
    const int parts = random.integer(2, 8);
    INFO("parts: ", parts);
    const Model fine(split(model.robot(), parts));
    Data fine_data(fine);
    const VectorXd q = spread(state.q, parts), qd = spread(state.qd, parts);
    const ChainSum sum(model.robot());

    const double fraction = random.uniform(0.0, 1.0);
    for (Index i = 0; i < model.num_sections(); ++i) {
      const double along = fraction * parts;
      const auto part = static_cast<Index>(along);
      const Pose whole = pose(model, state.q, i, fraction);
      const Pose found = pose(fine, q, i * parts + part, along - static_cast<double>(part));
      CHECK(residual(found.p, whole.p, total_length(model.robot())) <= rounding);
      CHECK(residual(found.R, whole.R) <= rounding);
    }
    VectorXd lengths(model.num_cables()), fine_lengths(model.num_cables());
    cable_lengths(model, state.q, lengths);
    cable_lengths(fine, q, fine_lengths);
    CHECK(residual(fine_lengths, lengths, total_length(model.robot())) <= rounding);

    const double U = potential_energy(model, data, state.q);
    const double weight = static_cast<double>(sum.weight_scale()[0]);
    CHECK(residual(potential_energy(fine, fine_data, q), U, std::abs(U) + weight) <= rounding);
    CHECK(residual(kinetic_energy(fine, fine_data, q, qd),
                   kinetic_energy(model, data, state.q, state.qd)) <= rounding);

    // The parts feel together what the whole feels: dU/dq and c qd, by the chain rule.
    const VectorXd whole = gradient_at(model, data, state.q);
    CHECK(residual(gathered(gradient_at(fine, fine_data, q), parts), whole,
                   largest(whole) + weight) <= rounding);
    const VectorXd h = bias_at(model, data, state.q, state.qd);
    const VectorXd felt = gathered(bias_at(fine, fine_data, q, qd), parts);
    const MatrixXd M = mass_matrix_at(model, data, state.q);
    const RealVector scale = bias_scale(model, sum, M.cast<Real>(), state);
    CHECK(residual(felt, h, static_cast<double>(scale.maxCoeff())) <= rounding);
  });
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
