#include <utility>

#include "control/measurement.hpp"
#include "estimation/kalman_parts.hpp"

namespace cdcr {

ExtendedKalman::ExtendedKalman(const Model& model, KalmanOptions options)
    : KalmanFilter(model, std::move(options)) {
  next_ = from_ = gain_ = Ph_ = Wh_ = x_;
  moved_ = P_;
  error_ = VectorXd::Zero(parts().most_values());
}

/// P becomes F P F^T + noise, with the slopes of the middle of the period, eq. (96).
void ExtendedKalman::predict(const VectorXd& command) noexcept {
  Parts& p = parts();
  p.motion.advance(x_, command, next_);
  from_ = 0.5 * (x_ + next_);
  p.motion.slopes(from_, command, p.slopes);
  p.transition.update(p.slopes);
  moved_.noalias() = p.transition.matrix() * P_;
  P_ = p.transition.noise();
  P_.noalias() += moved_ * p.transition.matrix().transpose();
  P_.triangularView<Eigen::StrictlyLower>() = P_.transpose();
  x_ = next_;
}

/// Value by value, since their errors are independent; the slopes are those of one point, eqs.
/// (99), (100).
void ExtendedKalman::correct(std::size_t sensor, const ConstVectorRef& told,
                             const VectorXd& command) noexcept {
  detail::MeasurementSlopes& one = parts().sensors[sensor];
  const Index size = told.size();
  one.update(x_, command);
  detail::find_error(one.sensor().kind, told, one.value(), error_.head(size));
  const double noise = one.sensor().noise * one.sensor().noise;
  double sum = 0.0;
  for (Index i = 0; i < size; ++i) {
    const auto h = one.slopes().row(i).transpose();
    const double innovation = error_[i] - h.dot(x_ - one.point());
    Ph_.noalias() = P_ * h;
    const double spread = h.dot(Ph_) + noise;
    gain_ = Ph_ / spread;
    x_ += innovation * gain_;
    P_.noalias() -= gain_ * Ph_.transpose();  // (I - K h^T) P
    Wh_.noalias() = P_ * h;
    P_.noalias() -= Wh_ * gain_.transpose();
    P_.noalias() += noise * gain_ * gain_.transpose();
    P_.triangularView<Eigen::StrictlyLower>() = P_.transpose();
    sum += innovation * innovation / spread;
  }
  note(sum, size);
}

}  // namespace cdcr
