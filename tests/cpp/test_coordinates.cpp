// Bending vectors for computing, bending and orientation angles for people.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "cdcr/coordinates.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/tolerances.hpp"

namespace cdcr::test {
namespace {

struct Angles {
  RowMatrixXd theta, phi;
};

Angles along(const RowMatrixXd& q) {
  Angles angles;
  polar_along(q, angles.theta, angles.phi);
  return angles;
}

/// Rows q(t) for t = 0 to 1.
RowMatrixXd sampled(int num_samples, const std::function<Eigen::Vector2d(double)>& q) {
  RowMatrixXd rows(num_samples, 2);
  for (int i = 0; i < num_samples; ++i) rows.row(i) = q(i / (num_samples - 1.0)).transpose();
  return rows;
}

double largest_jump(const RowMatrixXd& values) {
  double found = 0.0;
  for (Index i = 1; i < values.rows(); ++i) {
    found = std::max(found, std::abs(values(i, 0) - values(i - 1, 0)));
  }
  return found;
}

void check_same_vectors(const RowMatrixXd& q, const Angles& angles) {
  for (Index i = 0; i < q.rows(); ++i) {
    const Eigen::Vector2d back = bending(angles.theta(i, 0), angles.phi(i, 0));
    CHECK(residual(back, q.row(i).transpose(), 1.0) <= tolerance::rounding);
  }
}

TEST_SUITE_BEGIN("coordinates");

TEST_CASE("polar and bending undo each other") {
  Random random;
  for (int i = 0; i < 20 * test_count(); ++i) {
    INFO(random);
    const double theta = random.logarithmic(1e-12, 9.0), phi = random.uniform(-pi, pi);
    const Eigen::Vector2d q = bending(theta, phi);
    const Polar back = polar(q[0], q[1]);
    CHECK(residual(back.theta, theta) <= tolerance::rounding);
    CHECK(residual(back.phi, phi, pi) <= tolerance::rounding);
    CHECK(bending(-theta, phi) == -q);
  }
}

TEST_CASE("the straight section has phi = 0, whatever the signs of its zeros") {
  for (const double x : {0.0, -0.0}) {
    for (const double y : {0.0, -0.0}) {
      CHECK(polar(x, y).theta == 0.0);
      CHECK(polar(x, y).phi == 0.0);
      CHECK_FALSE(std::signbit(polar(x, y).phi));
    }
  }
}

TEST_CASE("phi lies in -pi exclusive to pi inclusive") {
  CHECK(polar(-1.0, 0.0).phi == pi);
  CHECK(polar(-1.0, -0.0).phi == pi);
  CHECK(polar(0.0, -1.0).phi == -0.5 * pi);
}

TEST_CASE("no under- or overflow of theta") {
  CHECK(residual(polar(3e-200, 4e-200).theta, 5e-200) <= tolerance::rounding);
  CHECK(residual(polar(3e200, 4e200).theta, 5e200) <= tolerance::rounding);
}

TEST_CASE("along a circle phi counts the turns") {
  for (const double turns : {3.0, -2.5}) {
    const RowMatrixXd q =
        sampled(400, [&](double t) { return bending(0.4, 1.0 + 2.0 * pi * turns * t); });
    const Angles angles = along(q);
    check_same_vectors(q, angles);
    CHECK(residual(angles.phi(399, 0) - angles.phi(0, 0), 2.0 * pi * turns) <= tolerance::rounding);
    CHECK(angles.theta.minCoeff() > 0.0);
  }
}

TEST_CASE("a swing through straight changes the sign of theta and not phi") {
  for (int k = 0; k < 12; ++k) {
    const double phi = -pi + 0.01 + k * pi / 6.0;
    INFO("phi = ", phi);
    // 101 samples hit the straight section, 100 step over it.
    for (const int num_samples : {101, 100}) {
      const RowMatrixXd q = sampled(num_samples, [&](double t) { return bending(0.5 - t, phi); });
      const Angles angles = along(q);
      check_same_vectors(q, angles);
      CHECK(angles.theta(0, 0) > 0.0);
      CHECK(residual(angles.theta(num_samples - 1, 0), -0.5) <= tolerance::rounding);
      CHECK(largest_jump(angles.phi) <= tolerance::cancelled);
    }
  }
}

TEST_CASE("a pendulum that swings many times keeps one phi") {
  const RowMatrixXd q =
      sampled(997, [](double t) { return bending(0.7 * std::cos(40.0 * t), 2.9); });
  const Angles angles = along(q);
  check_same_vectors(q, angles);
  for (Index i = 0; i < q.rows(); ++i) {
    CHECK(residual(angles.phi(i, 0), 2.9) <= tolerance::cancelled);
    CHECK(residual(angles.theta(i, 0), 0.7 * std::cos(40.0 * static_cast<double>(i) / 996.0),
                   1.0) <= tolerance::cancelled);
  }
}

TEST_CASE("a near miss of the straight section turns phi and keeps theta positive") {
  const RowMatrixXd q = sampled(2001, [](double t) { return Eigen::Vector2d(0.5 - t, 0.01); });
  const Angles angles = along(q);
  check_same_vectors(q, angles);
  CHECK(angles.theta.minCoeff() > 0.0);
  CHECK(angles.phi(2000, 0) - angles.phi(0, 0) > 3.0);
}

TEST_CASE("a straight start takes the direction that follows") {
  const RowMatrixXd q = sampled(11, [](double t) { return bending(t, 2.0); });
  const Angles angles = along(q);
  check_same_vectors(q, angles);
  CHECK(angles.theta(0, 0) == 0.0);
  CHECK(residual(angles.phi(0, 0), 2.0) <= tolerance::rounding);
}

TEST_CASE("a straight sample keeps the phi before it") {
  RowMatrixXd q(4, 2);
  q << 0.0, 0.3, 0.0, 0.0, -0.0, -0.0, 0.3, 0.0;
  const Angles angles = along(q);
  CHECK(angles.theta(1, 0) == 0.0);
  CHECK(angles.phi(1, 0) == angles.phi(0, 0));
  CHECK(angles.phi(2, 0) == angles.phi(0, 0));
  check_same_vectors(q, angles);
}

TEST_CASE("a section that never bends has phi = 0") {
  const Angles angles = along(RowMatrixXd::Zero(5, 2));
  CHECK(angles.theta == RowMatrixXd::Zero(5, 1));
  CHECK(angles.phi == RowMatrixXd::Zero(5, 1));
}

TEST_CASE("no samples give no angles") {
  const Angles angles = along(RowMatrixXd(0, 4));
  CHECK(angles.theta.rows() == 0);
  CHECK(angles.theta.cols() == 2);
}

TEST_CASE("sections are independent of each other") {
  const RowMatrixXd one = sampled(50, [](double t) { return bending(0.5 - t, 0.3); });
  const RowMatrixXd two = sampled(50, [](double t) { return bending(0.2, 9.0 * t); });
  RowMatrixXd q(50, 4);
  q << one, two;
  const Angles both = along(q);
  CHECK(both.theta.col(0) == along(one).theta.col(0));
  CHECK(both.phi.col(1) == along(two).phi.col(0));
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
