#include "integration/dop853.hpp"

#include <cmath>
#include <limits>

#include "integration/dop853_coefficients.hpp"

namespace cdcr::detail {
namespace {

using Slopes = std::array<VectorXd, 16>;

/// The weighted sum of slopes.
template <std::size_t N>
void sum_of(const dop853::Term (&terms)[N], const Slopes& slopes, VectorXd& sum) {
  const Index n = sum.size();
  sum = terms[0].weight * slopes[static_cast<std::size_t>(terms[0].slope)];
  for (std::size_t k = 1; k < N; ++k) {
    const double weight = terms[k].weight;
    const double* slope = slopes[static_cast<std::size_t>(terms[k].slope)].data();
    for (Index i = 0; i < n; ++i) sum[i] += weight * slope[i];
  }
}

}  // namespace

Dop853::Dop853(RobotOde& ode, const Options& options)
    : EmbeddedPair(ode, options, {0.125, 0.0, 0.125, 6.0, 1.0 / 3.0}) {
  for (VectorXd& v : slopes_) v.setZero(ode.num_states());
  for (VectorXd& v : dense_) v.setZero(ode.num_states());
  error_5_.setZero(ode.num_states());
  error_3_.setZero(ode.num_states());
}

void Dop853::make_stages(double h) {
  const auto stage = [&](const auto& terms, std::size_t k) {
    sum_of(terms, slopes_, trial_);
    trial_ = y_ + h * trial_;
    derivative(t_ + dop853::share[k] * h, trial_, slopes_[k]);
  };
  slopes_[0] = slope_;
  stage(dop853::state_1, 1);
  stage(dop853::state_2, 2);
  stage(dop853::state_3, 3);
  stage(dop853::state_4, 4);
  stage(dop853::state_5, 5);
  stage(dop853::state_6, 6);
  stage(dop853::state_7, 7);
  stage(dop853::state_8, 8);
  stage(dop853::state_9, 9);
  stage(dop853::state_10, 10);
  stage(dop853::state_11, 11);
  stage(dop853::state_12, 12);
  new_slope_ = slopes_[12];
}

double Dop853::error_norm(double h) {
  sum_of(dop853::error_5, slopes_, error_5_);
  sum_of(dop853::error_3, slopes_, error_3_);
  double fifth = 0.0, third = 0.0;
  for (Index i = 0; i < y_.size(); ++i) {
    const double inverse = 1.0 / tolerance(i);
    fifth += error_5_[i] * inverse * error_5_[i] * inverse;
    third += error_3_[i] * inverse * error_3_[i] * inverse;
  }
  if (!new_slope_.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  const double both = fifth + 0.01 * third;
  return both == 0.0 ? 0.0 : h * fifth / std::sqrt(both * static_cast<double>(y_.size()));
}

void Dop853::prepare_interpolation(double h) {
  VectorXd& at = dense_[0];  // scratch, until it is set below
  const auto stage = [&](const auto& terms, std::size_t k) {
    sum_of(terms, slopes_, at);
    at = y_before_ + h * at;
    derivative(t_before_ + dop853::share[k] * h, at, slopes_[k]);
  };
  stage(dop853::state_13, 13);
  stage(dop853::state_14, 14);
  stage(dop853::state_15, 15);
  dense_[0] = y_ - y_before_;
  dense_[1] = h * slope_before_ - dense_[0];
  dense_[2] = 2.0 * dense_[0] - h * (slope_ + slope_before_);
  const auto coefficient = [&](const auto& terms, std::size_t k) {
    sum_of(terms, slopes_, dense_[k]);
    dense_[k] *= h;
  };
  coefficient(dop853::dense_3, 3);
  coefficient(dop853::dense_4, 4);
  coefficient(dop853::dense_5, 5);
  coefficient(dop853::dense_6, 6);
}

void Dop853::interpolate_in_step(double share, VectorXd& y) const {
  y = share * dense_[6];
  for (std::size_t k = 6; k-- > 0;) y = (k % 2 == 0 ? share : 1.0 - share) * (y + dense_[k]);
  y += y_before_;
}

}  // namespace cdcr::detail
