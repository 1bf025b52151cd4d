// References: the values asked for, derivatives that are derivatives, the smoothest way.
#include <doctest/doctest.h>

#include <cmath>

#include "cdcr/reference_path.hpp"
#include "support/allocations.hpp"
#include "support/cases.hpp"
#include "support/residual.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

namespace tolerance {
/// A handful of operations.
constexpr double rounding = 1e-13;
/// Central differences in steps of 1e-5 s.
constexpr double differences = 1e-7;
}  // namespace tolerance

Setpoint at(const ReferencePath& path, double t) {
  Setpoint found(path.size());
  path.evaluate(t, found);
  return found;
}

/// Whether rate and acceleration are the derivatives of the value at that time.
void check_derivatives(const ReferencePath& path, double t) {
  CAPTURE(t);
  const double h = 1e-5;
  const Setpoint here = at(path, t), before = at(path, t - h), after = at(path, t + h);
  CHECK(residual((after.value - before.value) / (2.0 * h), here.rate, 1.0) <=
        tolerance::differences);
  CHECK(residual((after.rate - before.rate) / (2.0 * h), here.acceleration, 1.0) <=
        tolerance::differences);
}

/// A way through four points, with pieces of different lengths.
const Eigen::Vector4d times(0.5, 1.0, 2.5, 3.0);
MatrixXd points() {
  MatrixXd rows(4, 2);
  rows << 0.1, -0.2, 0.4, 0.3, -0.5, 0.1, 0.2, 0.2;
  return rows;
}

/// Integral of the squared jerk, by Simpson's rule within pieces and differences of accelerations.
double squared_jerk(const ReferencePath& path) {
  const double h = 1e-5;
  double sum = 0.0;
  for (Index i = 0; i + 1 < times.size(); ++i) {
    constexpr int steps = 200;
    const double from = times[i] + 2.0 * h, to = times[i + 1] - 2.0 * h;
    for (int k = 0; k <= steps; ++k) {
      const double t = from + (to - from) * k / steps;
      const VectorXd jerk =
          (at(path, t + h).acceleration - at(path, t - h).acceleration) / (2.0 * h);
      const double weight = k == 0 || k == steps ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
      sum += weight / 3.0 * (to - from) / steps * jerk.squaredNorm();
    }
  }
  return sum;
}

TEST_SUITE_BEGIN("reference_path");

TEST_CASE("between two points it is the minimum-jerk motion, and stands still before and after") {
  MatrixXd ends(2, 1);
  ends << 1.0, 3.0;
  const ReferencePath path = ReferencePath::spline(Eigen::Vector2d(2.0, 6.0), ends);
  for (const double s : {0.0, 0.1, 0.5, 0.77, 1.0}) {
    const double expected = 1.0 + 2.0 * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    CHECK(residual(at(path, 2.0 + 4.0 * s).value[0], expected) <= tolerance::rounding);
  }
  for (const double t : {-1.0, 0.0, 7.0}) {
    const Setpoint still = at(path, t);
    CHECK(still.value[0] == doctest::Approx(t < 2.0 ? 1.0 : 3.0));
    CHECK(still.rate[0] == 0.0);
    CHECK(still.acceleration[0] == 0.0);
  }
}

TEST_CASE("a spline goes through its points with four continuous derivatives, from rest to rest") {
  const ReferencePath path = ReferencePath::spline(times, points());
  for (Index i = 0; i < times.size(); ++i) {
    const Setpoint here = at(path, times[i]);
    CHECK(residual(here.value, points().row(i).transpose(), 1.0) <= tolerance::rounding);
    if (i == 0 || i == 3) {
      CHECK(here.rate.norm() <= 1e-11);
      CHECK(here.acceleration.norm() <= 1e-10);
      continue;
    }
    check_derivatives(path, times[i]);
    // Jerk and its rate from the two sides, by one-sided differences of the acceleration.
    const double h = 1e-3;
    const auto jerk = [&](double t) {
      return VectorXd((at(path, t + h).acceleration - at(path, t - h).acceleration) / (2.0 * h));
    };
    const double out = 2e-3;
    const VectorXd left = jerk(times[i] - out), right = jerk(times[i] + out);
    const VectorXd middle = jerk(times[i]);
    // Of a function with a continuous fourth derivative the second difference is of third order.
    CHECK((left - 2.0 * middle + right).norm() <= 1e-2 * (1.0 + middle.norm()));
  }
  for (const double t : {0.7, 1.7, 2.9}) check_derivatives(path, t);
}

TEST_CASE("no other way through the same points has less jerk") {
  const double least = squared_jerk(ReferencePath::spline(times, points()));
  Random random;
  INFO(random);
  for (int k = 0; k < 5; ++k) {
    // Other rates and accelerations at the inner points.
    MatrixXd rates = MatrixXd::Zero(4, 2), accelerations = rates;
    const ReferencePath best = ReferencePath::spline(times, points());
    for (Index i = 1; i < 3; ++i) {
      rates.row(i) = at(best, times[i]).rate.transpose() + random.vector(2, 0.1).transpose();
      accelerations.row(i) =
          at(best, times[i]).acceleration.transpose() + random.vector(2, 0.1).transpose();
    }
    CHECK(squared_jerk(ReferencePath::hermite(times, points(), rates, accelerations)) >
          1.0001 * least);
  }
}

TEST_CASE("a polygon rests in its corners, a circle and a helix turn as often as asked") {
  MatrixXd corners(5, 3);
  corners << 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0, 0, 1;
  const ReferencePath square = ReferencePath::polygon(corners, 8.0);
  for (int i = 0; i < 5; ++i) {
    const Setpoint corner = at(square, 2.0 * i);
    CHECK(residual(corner.value, corners.row(i).transpose(), 1.0) <= tolerance::rounding);
    CHECK(corner.rate.norm() <= 1e-12);
  }
  const Vector3d center(0.1, 0.2, 0.3), x(0.05, 0.0, 0.0), y(0.0, 0.05, 0.0), up(0.0, 0.0, 0.02);
  for (const bool rest : {true, false}) {
    const ReferencePath helix = ReferencePath::helix(center, x, y, up, 1.5, 3.0, rest);
    CHECK(residual(at(helix, 0.0).value, center + x, 1.0) <= tolerance::rounding);
    CHECK(residual(at(helix, 3.0).value, center - x + 1.5 * up, 1.0) <= tolerance::rounding);
    CHECK((at(helix, 1e-12).rate.norm() < 1e-6) == rest);
    for (const double t : {0.4, 1.9}) check_derivatives(helix, t);
    const Setpoint later = at(helix.delayed(10.0), 11.2), sooner = at(helix, 1.2);
    CHECK(residual(later.value, sooner.value, 1.0) <= tolerance::rounding);
  }
}

TEST_CASE("evaluate allocates nothing; what is no path is refused") {
  const ReferencePath path = ReferencePath::spline(times, points());
  Setpoint found(2);
  CHECK(allocations_of([&] { path.evaluate(1.3, found); }) == 0);
  CHECK_THROWS_SENTENCE(ReferencePath::spline(Eigen::Vector2d(0.0, 1.0), points()),
                        "points of a path must be 2 rows of finite values, one for each time, got "
                        "4 by 2");
  CHECK_THROWS_SENTENCE(ReferencePath::spline(VectorXd::Zero(1), points().topRows(1)),
                        "a path needs two times or more, got 1");
  CHECK_THROWS_SENTENCE(ReferencePath::polygon(MatrixXd::Zero(2, 2), 1.0),
                        "corners of a path must differ from those before, got corner 2 twice");
  CHECK_THROWS_SENTENCE(ReferencePath::polygon(points(), 0.0),
                        "duration of a path must be > 0 s and finite, got 0");
  const VectorXd far = VectorXd::Constant(2, 1e308);
  CHECK_THROWS_SENTENCE(
      ReferencePath::circle(far, far, far, 1.0, 1.0),
      "values, rates and accelerations of a path must be finite all along it, but "
      "are not with 1 turns in a duration of 1 s");
  const Eigen::Vector2d center(1e308, 0.0), down(0.0, 1e300);
  CHECK_THROWS_SENTENCE(
      ReferencePath::circle(center, -center, down, 4.0, 1e6),
      "values, rates and accelerations of a path must be finite all along it, but "
      "are not with 4 turns in a duration of 1e+06 s");
  CHECK(ReferencePath::polygon(1e200 * points(), 1.0).end() == 1.0);
  CHECK_THROWS_SENTENCE(ReferencePath::polygon(1e308 * points(), 1.0),
                        "corners of a path must be a finite way apart, corners 3 and 4 are not");
  CHECK_THROWS_SENTENCE(path.delayed(1.7e308).delayed(1.7e308),
                        "delay must be finite, and the path's end after it, got 1.7e+308");
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
