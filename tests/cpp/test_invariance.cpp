// What a robot does not depend on: where its base frame points, and how finely its sections are
// cut.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "cdcr/dynamics.hpp"
#include "cdcr/kinematics.hpp"
#include "support/chain_cases.hpp"
#include "support/residual.hpp"
#include "support/split.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

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

VectorXd gradient_at(const Model& model, Data& data, const VectorXd& q) {
  VectorXd gradient(q.size());
  potential_gradient(model, data, q, gradient);
  return gradient;
}

TEST_SUITE_BEGIN("invariance");

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
          tolerance::turned);
    CHECK(residual(potential_energy(other, other_data, state.q),
                   potential_energy(model, data, state.q),
                   std::abs(potential_energy(model, data, state.q)) + weight) <= tolerance::turned);
    CHECK(residual(mass_matrix_at(other, other_data, state.q),
                   mass_matrix_at(model, data, state.q)) <= tolerance::recursion);
    CHECK(residual(tip(other, state.q).p, R * tip(model, state.q).p) <= tolerance::turned);
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
      CHECK(residual(found.p, whole.p, total_length(model.robot())) <= tolerance::recursion);
      CHECK(residual(found.R, whole.R) <= tolerance::recursion);
    }
    VectorXd lengths(model.num_cables()), fine_lengths(model.num_cables());
    cable_lengths(model, state.q, lengths);
    cable_lengths(fine, q, fine_lengths);
    CHECK(residual(fine_lengths, lengths, total_length(model.robot())) <= tolerance::recursion);

    const double U = potential_energy(model, data, state.q);
    const double weight = static_cast<double>(sum.weight_scale()[0]);
    CHECK(residual(potential_energy(fine, fine_data, q), U, std::abs(U) + weight) <=
          tolerance::recursion);
    CHECK(residual(kinetic_energy(fine, fine_data, q, qd),
                   kinetic_energy(model, data, state.q, state.qd)) <= tolerance::recursion);

    // The parts feel together what the whole feels: dU/dq and c qd, by the chain rule.
    const VectorXd whole = gradient_at(model, data, state.q);
    CHECK(residual(gathered(gradient_at(fine, fine_data, q), parts), whole,
                   largest(whole) + weight) <= tolerance::recursion);
    const VectorXd h = bias_at(model, data, state.q, state.qd);
    const VectorXd felt = gathered(bias_at(fine, fine_data, q, qd), parts);
    const MatrixXd M = mass_matrix_at(model, data, state.q);
    const RealVector scale = bias_scale(model, sum, M.cast<Real>(), state);
    CHECK(residual(felt, h, static_cast<double>(scale.maxCoeff())) <= tolerance::recursion);
  });
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
