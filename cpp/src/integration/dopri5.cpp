#include "integration/dopri5.hpp"

#include <cmath>

namespace cdcr::detail {
namespace {

constexpr double beta = 0.04;

}  // namespace

Dopri5::Dopri5(RobotOde& ode, const Options& options)
    : EmbeddedPair(ode, Method::dopri5, options, {0.2, beta, 0.2 - 0.75 * beta, 10.0, 0.2, 0.9}) {
  for (VectorXd* v : {&k2_, &k3_, &k4_, &k5_, &k6_, &bend_, &turn_, &fifth_}) {
    v->setZero(ode.num_states());
  }
}

void Dopri5::make_stages(double h) {
  const Index n = y_.size();
  for (Index i = 0; i < n; ++i) trial_[i] = y_[i] + h * (1.0 / 5.0) * slope_[i];
  derivative(t_ + h / 5.0, trial_.data(), k2_.data());
  for (Index i = 0; i < n; ++i) {
    trial_[i] = y_[i] + h * (3.0 / 40.0 * slope_[i] + 9.0 / 40.0 * k2_[i]);
  }
  derivative(t_ + 0.3 * h, trial_.data(), k3_.data());
  for (Index i = 0; i < n; ++i) {
    trial_[i] = y_[i] + h * (44.0 / 45.0 * slope_[i] - 56.0 / 15.0 * k2_[i] + 32.0 / 9.0 * k3_[i]);
  }
  derivative(t_ + 0.8 * h, trial_.data(), k4_.data());
  for (Index i = 0; i < n; ++i) {
    trial_[i] = y_[i] + h * (19372.0 / 6561.0 * slope_[i] - 25360.0 / 2187.0 * k2_[i] +
                             64448.0 / 6561.0 * k3_[i] - 212.0 / 729.0 * k4_[i]);
  }
  derivative(t_ + 8.0 / 9.0 * h, trial_.data(), k5_.data());
  for (Index i = 0; i < n; ++i) {
    trial_[i] =
        y_[i] + h * (9017.0 / 3168.0 * slope_[i] - 355.0 / 33.0 * k2_[i] +
                     46732.0 / 5247.0 * k3_[i] + 49.0 / 176.0 * k4_[i] - 5103.0 / 18656.0 * k5_[i]);
  }
  derivative(t_ + h, trial_.data(), k6_.data());
  for (Index i = 0; i < n; ++i) {
    trial_[i] =
        y_[i] + h * (35.0 / 384.0 * slope_[i] + 500.0 / 1113.0 * k3_[i] + 125.0 / 192.0 * k4_[i] -
                     2187.0 / 6784.0 * k5_[i] + 11.0 / 84.0 * k6_[i]);
  }
  derivative(t_ + h, trial_.data(), new_slope_.data());
}

double Dopri5::error_norm(double h) {
  double sum = 0.0;
  for (Index i = 0; i < y_.size(); ++i) {
    const double error =
        h * (71.0 / 57600.0 * slope_[i] - 71.0 / 16695.0 * k3_[i] + 71.0 / 1920.0 * k4_[i] -
             17253.0 / 339200.0 * k5_[i] + 22.0 / 525.0 * k6_[i] - 1.0 / 40.0 * new_slope_[i]);
    const double scale = tolerance(i);
    sum += (error / scale) * (error / scale);
  }
  return std::sqrt(sum / static_cast<double>(y_.size()));
}

void Dopri5::prepare_interpolation(double h) {
  bend_ = h * slope_before_ - (y_ - y_before_);
  turn_ = (y_ - y_before_) - h * slope_ - bend_;
  fifth_ =
      h * (-12715105075.0 / 11282082432.0 * slope_before_ + 87487479700.0 / 32700410799.0 * k3_ -
           10690763975.0 / 1880347072.0 * k4_ + 701980252875.0 / 199316789632.0 * k5_ -
           1453857185.0 / 822651844.0 * k6_ + 69997945.0 / 29380423.0 * slope_);
}

void Dopri5::interpolate_in_step(double share, VectorXd& y) const {
  const double s = share, r = 1.0 - s;
  y = y_before_ + s * ((y_ - y_before_) + r * (bend_ + s * (turn_ + r * fifth_)));
}

}  // namespace cdcr::detail
