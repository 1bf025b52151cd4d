// The model against the slow sum over elements: mass matrix, energies, their derivatives.
#include <doctest/doctest.h>

#include <cmath>

#include "cdcr/dynamics.hpp"
#include "support/cases.hpp"
#include "support/element_sum.hpp"
#include "support/residual.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

TEST_SUITE_BEGIN("element_sum");

TEST_CASE("mass matrix") {
  for_each_case(2.0 * pi, [](const Model& model, Data& data, const State& state) {
    const ElementSum sum(model.robot());
    MatrixXd M(2, 2);
    mass_matrix(model, data, state.q, M);
    CHECK(residual(M, sum.mass_matrix(state.q.cast<Real>())) <= tolerance::model);
  });
}

TEST_CASE("kinetic and potential energy") {
  for_each_case(2.0 * pi, [](const Model& model, Data& data, const State& state) {
    const ElementSum sum(model.robot());
    const Real2 q = state.q.cast<Real>(), qd = state.qd.cast<Real>();
    // Near 2 pi a robot has little inertia in one direction: T may be small, its error is not.
    const double speed = static_cast<double>(sum.mass_matrix(q).norm() * qd.squaredNorm());
    CHECK(residual(kinetic_energy(model, data, state.q, state.qd), sum.kinetic_energy(q, qd),
                   speed) <= tolerance::model);
    const Real U = sum.potential_energy(q);
    CHECK(residual(potential_energy(model, data, state.q), U,
                   std::max(std::abs(U), sum.weight_scale())) <= tolerance::model);
  });
}

TEST_CASE("bias is Lagrange's") {
  for_each_case(2.0 * pi, [](const Model& model, Data& data, const State& state) {
    const ElementSum sum(model.robot());
    VectorXd h(2);
    bias(model, data, state.q, state.qd, h);
    const Real2 q = state.q.cast<Real>(), qd = state.qd.cast<Real>();
    const Real2 reference = sum.bias(q, qd);
    const double scale =
        static_cast<double>(reference.norm() + sum.weight_scale() + sum.kinetic_energy(q, qd));
    CHECK(residual(h, reference, scale) <= tolerance::model);
  });
}

TEST_CASE("gradient and hessian of the potential energy") {
  for_each_case(2.0 * pi, [](const Model& model, Data& data, const State& state) {
    const ElementSum sum(model.robot());
    const Real2 q = state.q.cast<Real>();
    VectorXd gradient(2);
    MatrixXd hessian(2, 2);
    potential_gradient(model, data, state.q, gradient);
    potential_hessian(model, data, state.q, hessian);
    const double scale = model.stiffness()[0] + static_cast<double>(sum.weight_scale());
    CHECK(residual(gradient, sum.potential_gradient(q), scale) <= tolerance::model);
    CHECK(residual(hessian, sum.potential_hessian(q), scale) <= tolerance::model_second);
  });
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
