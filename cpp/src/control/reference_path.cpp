#include "cdcr/reference_path.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/arguments.hpp"
#include "base/constants.hpp"

namespace cdcr {
namespace {

using Matrix2 = Eigen::Matrix<double, 2, 2, Eigen::DontAlign>;

/// Powers of the time since its begin, of the quintic that has value, rate and acceleration at both
/// ends, h [s] apart. Rows are components.
void set_quintic(double h, const MatrixXd& from, const MatrixXd& to, Eigen::Ref<MatrixXd> powers) {
  const auto step = to.col(0) - from.col(0);
  const auto v0 = from.col(1), a0 = from.col(2), v1 = to.col(1), a1 = to.col(2);
  powers.col(0) = from.col(0);
  powers.col(1) = v0;
  powers.col(2) = a0 / 2.0;
  powers.col(3) =
      (20.0 * step - (8.0 * v1 + 12.0 * v0) * h - (3.0 * a0 - a1) * h * h) / (2.0 * h * h * h);
  powers.col(4) = (-30.0 * step + (14.0 * v1 + 16.0 * v0) * h + (3.0 * a0 - 2.0 * a1) * h * h) /
                  (2.0 * std::pow(h, 4));
  powers.col(5) = (12.0 * step - 6.0 * (v1 + v0) * h + (a1 - a0) * h * h) / (2.0 * std::pow(h, 5));
}

/// What the third and the fourth derivative at the begin of a quintic owe to (rate, acceleration)
/// at its two ends and to its step, eq. (85). At its end they are the same with the ends exchanged
/// and the signs of those odd in time reversed.
struct Jerk {
  explicit Jerk(double h) {
    const double h2 = h * h, h3 = h2 * h, h4 = h3 * h;
    near << -36.0 / h2, -9.0 / h, 192.0 / h3, 36.0 / h2;
    far << -24.0 / h2, 3.0 / h, 168.0 / h3, -24.0 / h2;
    step << 60.0 / h3, -360.0 / h4;
  }
  /// Time reversed: third derivative and rate change their sign, the step too.
  static Matrix2 reversed(const Matrix2& m) {
    Matrix2 r = m;
    r(0, 1) = -m(0, 1);
    r(1, 0) = -m(1, 0);
    return r;
  }
  Matrix2 near, far;
  Eigen::Matrix<double, 2, 1, Eigen::DontAlign> step;
};

/// Rates and accelerations at the points of the smoothest way through them: block tridiagonal
/// equations, since jerk and snap are continuous at each point but the first and the last.
void solve_spline(const VectorXd& times, const MatrixXd& points, MatrixXd& rates,
                  MatrixXd& accelerations) {
  const Index n = times.size(), inner = n - 2;
  rates = accelerations = MatrixXd::Zero(n, points.cols());
  if (inner < 1) return;
  std::vector<Matrix2> upper(static_cast<std::size_t>(inner));
  std::vector<MatrixXd> right(static_cast<std::size_t>(inner));
  for (Index i = 0; i < inner; ++i) {
    const Jerk before(times[i + 1] - times[i]), after(times[i + 2] - times[i + 1]);
    // Of the piece before, at its end, minus the piece after, at its begin.
    Matrix2 diagonal = Jerk::reversed(before.near) - after.near;
    const Matrix2 lower = Jerk::reversed(before.far);
    MatrixXd rhs(2, points.cols());
    rhs.row(0) = after.step[0] * (points.row(i + 2) - points.row(i + 1)) -
                 before.step[0] * (points.row(i + 1) - points.row(i));
    rhs.row(1) = after.step[1] * (points.row(i + 2) - points.row(i + 1)) +
                 before.step[1] * (points.row(i + 1) - points.row(i));
    const auto k = static_cast<std::size_t>(i);
    if (i > 0) {
      diagonal -= lower * upper[k - 1];
      rhs -= lower * right[k - 1];
    }
    const Matrix2 inverse = diagonal.inverse();
    upper[k] = -(inverse * after.far);
    right[k] = inverse * rhs;
  }
  MatrixXd next = MatrixXd::Zero(2, points.cols());
  for (Index i = inner - 1; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    next = (right[k] - upper[k] * next).eval();
    rates.row(i + 1) = next.row(0);
    accelerations.row(i + 1) = next.row(1);
  }
}

void require_points(const char* item, const MatrixXd& points, Index rows) {
  detail::require(points.rows() == rows && points.cols() > 0 && points.allFinite(), item,
                  " must be ", rows, " rows of finite values, one for each time, got ",
                  points.rows(), " by ", points.cols(), points.allFinite() ? "" : ", not finite");
}

void require_times(const VectorXd& times) {
  detail::require(times.size() >= 2, "a path needs two times or more, got ", times.size());
  detail::require_increasing("times of a path", times.data(), times.size());
}

constexpr const char* beyond_doubles =
    "values, rates and accelerations of a path must be finite all along it";

/// Values that are finite at points may not be between them, nor their rates.
ReferencePath within_doubles(ReferencePath path, const VectorXd& times) {
  Setpoint at(path.size());
  for (Index i = 0; i + 1 < times.size(); ++i) {
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double t = times[i] + share * (times[i + 1] - times[i]);
      path.evaluate(t, at);
      detail::require(at.value.allFinite() && at.rate.allFinite() && at.acceleration.allFinite(),
                      beyond_doubles, ", but are not at ", t, " s");
    }
  }
  return path;
}

}  // namespace

ReferencePath::ReferencePath(const VectorXd& times, Index size)
    : size_(size),
      times_(times),
      coefficients_(MatrixXd::Zero(std::max<Index>(1, times.size() - 1) * size, 6)) {}

ReferencePath ReferencePath::of_parts(const VectorXd& times, const MatrixXd& coefficients,
                                      const MatrixXd& turn, Index size) {
  const Index pieces = std::max<Index>(1, times.size() - 1);
  const bool turns = turn.size() != 0;
  const bool fits = times.size() > 0 && size > 0 && coefficients.cols() == 6 &&
                    coefficients.rows() == (turns ? 1 : pieces * size) &&
                    (!turns || (turn.rows() == size && turn.cols() == 4));
  detail::require(fits, "the parts of a path do not fit together");
  detail::require_increasing("times of a path", times.data(), times.size());
  ReferencePath path(times, size);
  path.coefficients_ = coefficients;
  path.helix_ = turn;
  return path;
}

ReferencePath ReferencePath::constant(const VectorXd& value) {
  detail::require(value.size() > 0, "a path must have one value or more");
  ReferencePath path(VectorXd::Zero(1), value.size());
  path.coefficients_.col(0) = value;
  return path;
}

ReferencePath ReferencePath::hermite(const VectorXd& times, const MatrixXd& values,
                                     const MatrixXd& rates, const MatrixXd& accelerations) {
  require_times(times);
  require_points("values of a path", values, times.size());
  require_points("rates of a path", rates, times.size());
  require_points("accelerations of a path", accelerations, times.size());
  detail::require(rates.cols() == values.cols() && accelerations.cols() == values.cols(),
                  "values, rates and accelerations of a path must have as many columns, got ",
                  values.cols(), ", ", rates.cols(), " and ", accelerations.cols());
  const Index size = values.cols();
  ReferencePath path(times, size);
  MatrixXd from(size, 3), to(size, 3);
  for (Index i = 0; i + 1 < times.size(); ++i) {
    from << values.row(i).transpose(), rates.row(i).transpose(), accelerations.row(i).transpose();
    to << values.row(i + 1).transpose(), rates.row(i + 1).transpose(),
        accelerations.row(i + 1).transpose();
    set_quintic(times[i + 1] - times[i], from, to, path.coefficients_.middleRows(i * size, size));
  }
  return within_doubles(std::move(path), times);
}

ReferencePath ReferencePath::spline(const VectorXd& times, const MatrixXd& points) {
  require_times(times);
  require_points("points of a path", points, times.size());
  MatrixXd rates, accelerations;
  solve_spline(times, points, rates, accelerations);
  return hermite(times, points, rates, accelerations);
}

ReferencePath ReferencePath::polygon(const MatrixXd& corners, double duration) {
  detail::require_positive("duration of a path", duration, "s");
  detail::require(corners.rows() >= 2, "a polygon needs two corners or more, got ", corners.rows());
  require_points("corners of a path", corners, corners.rows());
  VectorXd times = VectorXd::Zero(corners.rows());
  for (Index i = 1; i < times.size(); ++i) {
    const double length = (corners.row(i) - corners.row(i - 1)).stableNorm();
    detail::require(length > 0.0, "corners of a path must differ from those before, got corner ",
                    i + 1, " twice");
    times[i] = times[i - 1] + length;
    detail::require(std::isfinite(times[i]),
                    "corners of a path must be a finite way apart, corners ", i, " and ", i + 1,
                    " are not");
  }
  times *= duration / times[times.size() - 1];
  const MatrixXd zero = MatrixXd::Zero(corners.rows(), corners.cols());
  return hermite(times, corners, zero, zero);
}

ReferencePath ReferencePath::helix(const VectorXd& center, const VectorXd& x, const VectorXd& y,
                                   const VectorXd& climb, double turns, double duration,
                                   bool rest_to_rest) {
  const Index size = center.size();
  detail::require(size > 0, "the center of a path must have one value or more");
  detail::require_finite("center of a path", center, size);
  detail::require_finite("x of a path", x, size);
  detail::require_finite("y of a path", y, size);
  detail::require_finite("climb of a path", climb, size);
  detail::require(std::isfinite(turns), "turns of a path must be finite, got ", turns);
  detail::require_positive("duration of a path", duration, "s");
  ReferencePath path(Eigen::Vector2d(0.0, duration), size);
  MatrixXd from = MatrixXd::Zero(1, 3), to = from;
  to(0, 0) = 2.0 * detail::pi * turns;
  if (!rest_to_rest) from(0, 1) = to(0, 1) = to(0, 0) / duration;
  path.coefficients_.setZero(1, 6);
  set_quintic(duration, from, to, path.coefficients_);
  path.helix_.resize(size, 4);
  path.helix_ << center, x, y, climb / (2.0 * detail::pi);
  // More than the angle's largest rate and the root of its largest acceleration, from rest to rest.
  const double fastest = std::fmax(1.0, 4.0 * (detail::pi * std::abs(turns) + 1.0) / duration);
  const VectorXd reach = x.cwiseAbs() + y.cwiseAbs() + std::abs(turns) * climb.cwiseAbs();
  detail::require(
      (center.cwiseAbs() + reach).allFinite() && (2.0 * fastest * fastest * reach).allFinite(),
      beyond_doubles, ", but are not with ", turns, " turns in a duration of ", duration, " s");
  return path;
}

ReferencePath ReferencePath::circle(const VectorXd& center, const VectorXd& x, const VectorXd& y,
                                    double turns, double duration, bool rest_to_rest) {
  return helix(center, x, y, VectorXd::Zero(center.size()), turns, duration, rest_to_rest);
}

ReferencePath ReferencePath::delayed(double delay) const {
  detail::require(std::isfinite(delay) && std::isfinite(end() + delay),
                  "delay must be finite, and the path's end after it, got ", delay);
  ReferencePath path = *this;
  path.times_.array() += delay;
  return path;
}

void ReferencePath::evaluate(double t, Setpoint& setpoint) const noexcept {
  const double inside = std::fmin(std::fmax(t, start()), end());
  const double moving = t >= start() && t <= end() && !is_constant() ? 1.0 : 0.0;
  const double* const first = times_.data();
  const double* const last = first + times_.size();
  const Index pieces = std::max<Index>(1, times_.size() - 1);
  const Index piece =
      std::clamp<Index>(std::upper_bound(first, last, inside) - first - 1, 0, pieces - 1);
  const double s = inside - times_[piece];
  const auto horner = [&](Index row, double& value, double& rate, double& acceleration) {
    const auto c = coefficients_.row(row);
    value = c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))));
    rate =
        moving * (c[1] + s * (2.0 * c[2] + s * (3.0 * c[3] + s * (4.0 * c[4] + s * 5.0 * c[5]))));
    acceleration = moving * (2.0 * c[2] + s * (6.0 * c[3] + s * (12.0 * c[4] + s * 20.0 * c[5])));
  };
  if (helix_.size() == 0) {
    for (Index i = 0; i < size_; ++i) {
      horner(piece * size_ + i, setpoint.value[i], setpoint.rate[i], setpoint.acceleration[i]);
    }
    return;
  }
  double a = 0.0, rate = 0.0, acceleration = 0.0;
  horner(0, a, rate, acceleration);
  const double c = std::cos(a), n = std::sin(a);
  for (Index i = 0; i < size_; ++i) {
    const double x = helix_(i, 1), y = helix_(i, 2), climb = helix_(i, 3);
    const double along = c * y - n * x + climb, across = -c * x - n * y;
    setpoint.value[i] = helix_(i, 0) + c * x + n * y + a * climb;
    setpoint.rate[i] = rate * along;
    setpoint.acceleration[i] = acceleration * along + rate * rate * across;
  }
}

}  // namespace cdcr
