#include "integration/dop853.hpp"

#include <cmath>
#include <iterator>
#include <limits>

#include "integration/dop853_coefficients.hpp"

namespace cdcr::detail {
namespace {

// Of the steps' control. The reference code has 0 and 0.9, which rejects a fifth of the steps of a
// robot that swings: at the same error these take an eighth fewer evaluations.
constexpr double beta = 0.04, safety = 0.8;
// How far stability reaches: step times eigenvalue.
constexpr double stable = 6.1;

// NOLINTBEGIN(readability-redundant-parentheses): none are there
/// A weighted sum of slopes, which lie n apart: of one state.
template <const auto& terms>
double sum_of(const double* slopes, Index n) {
  double sum = 0.0;
  for (const dop853::Term& term : terms) sum += term.weight * slopes[term.slope * n];
  return sum;
}

/// y + h times such a sum. The last slope is the latest: all else is ready before it comes.
template <const auto& terms>
double moved_by(double y, double h, const double* slopes, Index n) {
  constexpr std::size_t count = std::size(terms) - 1;
  double sum = 0.0;
  for (std::size_t k = 0; k < count; ++k) sum += terms[k].weight * slopes[terms[k].slope * n];
  return (y + h * sum) + (h * terms[count].weight) * slopes[terms[count].slope * n];
}
// NOLINTEND(readability-redundant-parentheses)

template <int N>
constexpr Index count_of(const VectorXd& y) {
  return N == Eigen::Dynamic ? y.size() : N;
}

}  // namespace

Dop853::Dop853(RobotOde& ode, const Options& options)
    : EmbeddedPair(ode, Method::dop853, options,
                   {0.125, beta, 0.125 - 0.2 * beta, 6.0, 1.0 / 3.0, safety}),
      of_decay_((ode.model().num_deflections() > 0 ? 0.05 : 0.15) * stable),
      slopes_(MatrixXd::Zero(ode.num_states(), 16)),
      dense_(MatrixXd::Zero(ode.num_states(), 7)),
      last_argument_(VectorXd::Zero(ode.num_states())) {}

// One section, with its four states, has code of its own: loops that are unrolled.
void Dop853::make_stages(double h) {
  y_.size() == 4 ? make_stages_of<4>(h) : make_stages_of<Eigen::Dynamic>(h);
}
double Dop853::error_norm(double h) {
  return y_.size() == 4 ? error_norm_of<4>(h) : error_norm_of<Eigen::Dynamic>(h);
}
void Dop853::prepare_interpolation(double h) {
  y_.size() == 4 ? prepare_interpolation_of<4>(h) : prepare_interpolation_of<Eigen::Dynamic>(h);
}

template <int N>
void Dop853::make_stages_of(double h) {
  const Index n = count_of<N>(y_);
  const auto argument = [&](const auto& moved) {
    for (Index i = 0; i < n; ++i) trial_[i] = moved(y_[i], h, slopes_.data() + i, n);
  };
  const auto slope = [&](int k) {
    derivative(t_ + dop853::share[k] * h, trial_.data(), slopes_.col(k).data());
  };
  slopes_.col(0) = slope_;
  argument(moved_by<dop853::state_1>);
  slope(1);
  argument(moved_by<dop853::state_2>);
  slope(2);
  argument(moved_by<dop853::state_3>);
  slope(3);
  argument(moved_by<dop853::state_4>);
  slope(4);
  argument(moved_by<dop853::state_5>);
  slope(5);
  argument(moved_by<dop853::state_6>);
  slope(6);
  argument(moved_by<dop853::state_7>);
  slope(7);
  argument(moved_by<dop853::state_8>);
  slope(8);
  argument(moved_by<dop853::state_9>);
  slope(9);
  argument(moved_by<dop853::state_10>);
  slope(10);
  argument(moved_by<dop853::state_11>);
  slope(11);
  last_argument_.swap(trial_);
  argument(moved_by<dop853::state_12>);
  slope(12);
  new_slope_ = slopes_.col(12);
}

template <int N>
double Dop853::error_norm_of(double h) const {
  const Index n = count_of<N>(y_);
  double fifth = 0.0, third = 0.0;
  for (Index i = 0; i < n; ++i) {
    const double inverse = 1.0 / tolerance(i);
    const double error_5 = inverse * sum_of<dop853::error_5>(slopes_.data() + i, n);
    const double error_3 = inverse * sum_of<dop853::error_3>(slopes_.data() + i, n);
    fifth += error_5 * error_5;
    third += error_3 * error_3;
  }
  if (!new_slope_.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  const double both = fifth + 0.01 * third;
  return both == 0.0 ? 0.0 : h * fifth / std::sqrt(both * static_cast<double>(n));
}

// The last two slopes tell the eigenvalue of what the stages disagree about (Hairer and Wanner,
// "Solving Ordinary Differential Equations II", section IV.2). Where it has long died out, it
// decays: then errors hold the step from a sixth of the stable one on, the tighter the tolerance
// the sooner; from a twentieth where cables that stick and slip stir it up again and again.
bool Dop853::is_held_by_stability() const noexcept {
  double change = 0.0, along = 0.0, way = 0.0;
  for (Index i = 0; i < y_.size(); ++i) {
    const double of_slope = slope_[i] - slopes_(i, 11), of_state = y_[i] - last_argument_[i];
    change += of_slope * of_slope;
    along += of_slope * of_state;
    way += of_state * of_state;
  }
  const double h = last_step();
  return -h * along > of_decay_ * way || h * h * change > stable * stable * way;
}

template <int N>
void Dop853::prepare_interpolation_of(double h) {
  const Index n = count_of<N>(y_);
  const auto slope = [&](const auto& moved, int k) {
    auto at = dense_.col(0);  // scratch, until it is set below
    for (Index i = 0; i < n; ++i) at[i] = moved(y_before_[i], h, slopes_.data() + i, n);
    derivative(t_before_ + dop853::share[k] * h, at.data(), slopes_.col(k).data());
  };
  slope(moved_by<dop853::state_13>, 13);
  slope(moved_by<dop853::state_14>, 14);
  slope(moved_by<dop853::state_15>, 15);
  dense_.col(0) = y_ - y_before_;
  dense_.col(1) = h * slope_before_ - dense_.col(0);
  dense_.col(2) = 2.0 * dense_.col(0) - h * (slope_ + slope_before_);
  const auto coefficient = [&](const auto& sum, int k) {
    for (Index i = 0; i < n; ++i) dense_(i, k) = h * sum(slopes_.data() + i, n);
  };
  coefficient(sum_of<dop853::dense_3>, 3);
  coefficient(sum_of<dop853::dense_4>, 4);
  coefficient(sum_of<dop853::dense_5>, 5);
  coefficient(sum_of<dop853::dense_6>, 6);
}

void Dop853::interpolate_in_step(double share, VectorXd& y) const {
  for (Index i = 0; i < y.size(); ++i) {
    double sum = share * dense_(i, 6);
    for (Index k = 6; k-- > 0;) sum = (k % 2 == 0 ? share : 1.0 - share) * (sum + dense_(i, k));
    y[i] = y_before_[i] + sum;
  }
}

}  // namespace cdcr::detail
