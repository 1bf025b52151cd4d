// Beyond the model's range, and for input that is no number, the answer is NaN and never a crash.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "cdcr/dynamics.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/linearization.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"

namespace cdcr::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

using Function = std::function<double(const Model&, const VectorXd& q, const VectorXd& qd)>;

struct NamedFunction {
  std::string name;
  Function largest_result;  // NaN when any result is NaN
};

/// Everything in dynamics.hpp and linearization.hpp that depends on the shape.
std::vector<NamedFunction> functions_of_shape() {
  const auto tension = [](const Model& model) { return VectorXd::Ones(model.num_cables()); };
  const Eigen::Vector2d one(1.0, 1.0);
  return {
      {"mass_matrix",
       [](const Model& model, const VectorXd& q, const VectorXd&) {
         Data data(model);
         MatrixXd M = MatrixXd::Zero(2, 2);
         mass_matrix(model, data, q, M);
         return largest(M);
       }},
      {"bias",
       [](const Model& model, const VectorXd& q, const VectorXd& qd) {
         Data data(model);
         VectorXd h = VectorXd::Zero(2);
         bias(model, data, q, qd, h);
         return largest(h);
       }},
      {"forward_dynamics",
       [=](const Model& model, const VectorXd& q, const VectorXd& qd) {
         Data data(model);
         VectorXd qdd = VectorXd::Zero(2);
         forward_dynamics(model, data, q, qd, tension(model), qdd);
         return largest(qdd);
       }},
      {"inverse_dynamics",
       [=](const Model& model, const VectorXd& q, const VectorXd& qd) {
         Data data(model);
         VectorXd force = VectorXd::Zero(2);
         inverse_dynamics(model, data, q, qd, one, force);
         return largest(force);
       }},
      {"kinetic_energy",
       [](const Model& model, const VectorXd& q, const VectorXd& qd) {
         Data data(model);
         return kinetic_energy(model, data, q, qd);
       }},
      {"potential_energy",
       [](const Model& model, const VectorXd& q, const VectorXd&) {
         Data data(model);
         return potential_energy(model, data, q);
       }},
      {"potential_gradient",
       [](const Model& model, const VectorXd& q, const VectorXd&) {
         Data data(model);
         VectorXd gradient = VectorXd::Zero(2);
         potential_gradient(model, data, q, gradient);
         return largest(gradient);
       }},
      {"potential_hessian",
       [](const Model& model, const VectorXd& q, const VectorXd&) {
         Data data(model);
         MatrixXd H = MatrixXd::Zero(2, 2);
         potential_hessian(model, data, q, H);
         return largest(H);
       }},
      {"linearize",
       [=](const Model& model, const VectorXd& q, const VectorXd& qd) {
         Data data(model);
         MatrixXd A = MatrixXd::Zero(4, 4), B = MatrixXd::Zero(4, model.num_cables());
         linearize(model, data, q, qd, tension(model), A, B);
         return largest(A);
       }},
  };
}

std::vector<NamedRobot> weightless_and_upright() {
  Robot upright = amouri2020();
  upright.gravity = {0.0, 0.0, -9.81};
  return {{"Table 1", amouri2020()}, {"upright", upright}};
}

void check_all_nan(const VectorXd& q) {
  const Eigen::Vector2d qd(1.0, -2.0);
  for (const NamedRobot& sample : weightless_and_upright()) {
    const Model model(sample.robot);
    for (const NamedFunction& f : functions_of_shape()) {
      INFO(sample.name, ", ", f.name, ", q = ", q[0], ", ", q[1]);
      CHECK(std::isnan(f.largest_result(model, q, qd)));
    }
  }
}

TEST_SUITE_BEGIN("limits");

TEST_CASE("up to the bending limit everything is a number") {
  const Eigen::Vector2d qd(1.0, -2.0);
  for (const NamedRobot& sample : weightless_and_upright()) {
    const Model model(sample.robot);
    for (const NamedFunction& f : functions_of_shape()) {
      for (const double theta : {0.0, pi, 2.0 * pi, 0.999999 * max_bending, max_bending}) {
        INFO(sample.name, ", ", f.name, ", theta = ", theta);
        CHECK(std::isfinite(f.largest_result(model, Eigen::Vector2d(theta, 0.0), qd)));
      }
    }
  }
}

TEST_CASE("beyond the bending limit everything is NaN") {
  check_all_nan(Eigen::Vector2d(1.000001 * max_bending, 0.0));
  check_all_nan(Eigen::Vector2d(-7.0, 7.0));
  check_all_nan(Eigen::Vector2d(1e200, 1e200));  // sigma is infinite
}

TEST_CASE("a bending vector that is no number gives NaN") {
  check_all_nan(Eigen::Vector2d(nan, 0.0));
  check_all_nan(Eigen::Vector2d(0.0, nan));
  check_all_nan(Eigen::Vector2d(inf, 0.0));
  check_all_nan(Eigen::Vector2d(0.0, -inf));
}

TEST_CASE("a rate that is no number gives NaN where rates matter") {
  const Model model(amouri2020());
  const Eigen::Vector2d q(0.3, -0.2);
  for (const NamedFunction& f : functions_of_shape()) {
    if (f.name == "mass_matrix" || f.name.rfind("potential", 0) == 0) continue;
    INFO(f.name);
    CHECK(std::isnan(f.largest_result(model, q, Eigen::Vector2d(nan, 0.0))));
    CHECK_FALSE(std::isfinite(f.largest_result(model, q, Eigen::Vector2d(inf, 0.0))));
  }
}

TEST_CASE("kinematics of a bending vector that is no number is NaN") {
  const Model model(amouri2020());
  for (const Eigen::Vector2d& q : {Eigen::Vector2d(nan, 0.0), Eigen::Vector2d(0.0, inf)}) {
    MatrixXd J = MatrixXd::Zero(6, 2);
    jacobian(model, q, 0, 0.5, J);
    CHECK(std::isnan(largest(tip(model, q).p)));
    CHECK(std::isnan(largest(tip(model, q).R)));
    CHECK(std::isnan(largest(J)));
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
