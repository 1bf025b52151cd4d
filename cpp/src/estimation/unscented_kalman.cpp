#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

#include "base/arguments.hpp"
#include "control/measurement.hpp"
#include "estimation/kalman_parts.hpp"

namespace cdcr {
namespace {

// Of a variance: what is left of it below that is rounding.
constexpr double nothing = 1e-14;

/// The lower L of P = L L^T; a column is zero where P has nothing of its own left.
void set_root(const MatrixXd& P, MatrixXd& L) noexcept {
  L.setZero();
  for (Index j = 0; j < P.rows(); ++j) {
    const double left = P(j, j) - L.row(j).head(j).squaredNorm();
    if (!(left > nothing * P(j, j))) continue;
    L(j, j) = std::sqrt(left);
    for (Index i = j + 1; i < P.rows(); ++i) {
      L(i, j) = (P(i, j) - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
    }
  }
}

}  // namespace

UnscentedKalman::UnscentedKalman(const Model& model, KalmanOptions options, UnscentedOptions spread)
    : KalmanFilter(model, std::move(options)), spread_(spread) {
  const Index size = x_.size(), most = parts().most_values();
  const auto n = static_cast<double>(size);
  detail::require_positive("spread", spread_.spread, "1");
  detail::require(std::isfinite(spread_.beta), "beta must be finite, got ", spread_.beta);
  detail::require(n + spread_.kappa > 0.0 && std::isfinite(spread_.kappa), "kappa must be above -",
                  size, ", the size of the state, and finite, got ", spread_.kappa);
  const double square = spread_.spread * spread_.spread, scale = square * (n + spread_.kappa);
  reach_ = std::sqrt(scale);
  other_ = 0.5 / scale;
  middle_ = 1.0 - n / scale;
  middle_square_ = middle_ + 1.0 - square + spread_.beta;
  point_ = next_ = x_;
  root_ = P_;
  points_ = MatrixXd::Zero(size, 2 * size + 1);
  told_ = MatrixXd::Zero(most, 2 * size + 1);
  expected_ = error_ = mean_ = VectorXd::Zero(most);
  S_ = MatrixXd::Zero(most, most);
  C_ = gain_ = MatrixXd::Zero(most, size);
}

/// The estimate, and from there along each column of the root, eq. (101).
void UnscentedKalman::set_points() noexcept {
  set_root(P_, root_);
  points_.colwise() = x_;
  points_.middleCols(1, x_.size()) += reach_ * root_;
  points_.rightCols(x_.size()) -= reach_ * root_;
}

void UnscentedKalman::set_mean(const Eigen::Ref<const MatrixXd>& columns,
                               VectorRef mean) const noexcept {
  mean = other_ * columns.rightCols(columns.cols() - 1).rowwise().sum();
  mean += middle_ * columns.col(0);
}

void UnscentedKalman::predict(const VectorXd& command) noexcept {
  Parts& p = parts();
  set_points();
  for (Index i = 0; i < points_.cols(); ++i) {
    point_ = points_.col(i);
    p.motion.advance(point_, command, next_);
    points_.col(i) = next_;
  }
  point_ = 0.5 * (x_ + points_.col(0));
  p.motion.slopes(point_, command, p.slopes);  // for what noise adds alone
  p.transition.update(p.slopes);
  set_mean(points_, x_);
  points_.colwise() -= x_;
  P_ = p.transition.noise();
  P_.noalias() += other_ * points_ * points_.transpose();
  P_.noalias() += (middle_square_ - other_) * points_.col(0) * points_.col(0).transpose();
}

void UnscentedKalman::correct(std::size_t sensor, const ConstVectorRef& told,
                              const VectorXd& command) noexcept {
  detail::MeasurementSlopes& one = parts().sensors[sensor];
  const Sensor& how = one.sensor();
  const Index size = told.size();
  set_points();
  auto values = told_.topRows(size);
  for (Index i = 0; i < points_.cols(); ++i) {
    point_ = points_.col(i);
    one.update_value(point_, command);
    if (i == 0) expected_.head(size) = one.value();
    error_.head(size).setZero();
    detail::find_error(how.kind, one.value(), expected_.head(size), error_.head(size));
    values.col(i) = error_.head(size);
  }
  auto mean = mean_.head(size), error = error_.head(size);
  detail::find_error(how.kind, told, expected_.head(size), error);
  set_mean(values, mean);
  error -= mean;
  values.colwise() -= mean;
  points_.colwise() -= x_;
  auto S = S_.topLeftCorner(size, size);
  auto C = C_.topRows(size), gain = gain_.topRows(size);  // both transposed
  S.noalias() = other_ * values * values.transpose();
  S.noalias() += (middle_square_ - other_) * values.col(0) * values.col(0).transpose();
  S.diagonal().array() += how.noise * how.noise;
  // The first of the points is the estimate itself, and no weight changes that zero.
  C.noalias() = other_ * values * points_.transpose();
  gain = C;
  Eigen::Ref<MatrixXd> in_place(S);
  const Eigen::LLT<Eigen::Ref<MatrixXd>> llt(in_place);
  llt.solveInPlace(gain);
  x_.noalias() += gain.transpose() * error;
  P_.noalias() -= gain.transpose() * C;
  P_.triangularView<Eigen::StrictlyLower>() = P_.transpose();
  mean = error;
  llt.solveInPlace(mean);
  note(error.dot(mean), size);
}

}  // namespace cdcr
