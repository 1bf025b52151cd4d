#include "cdcr/wrench_input.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "base/arguments.hpp"

namespace cdcr {
namespace {

constexpr const char* item = "a wrench's profile";

/// The factor as a signal of one value.
Signal signal_of(Profile profile) {
  if (profile.function) {
    const auto call = [f = std::move(profile.function)](double t, const ConstVectorRef& /*q*/,
                                                        const ConstVectorRef& /*qd*/,
                                                        VectorRef value) {
      value[0] = f(t);
      detail::require(std::isfinite(value[0]),
                      "the profile of a wrench must give finite factors, got ", value[0],
                      " at t = ", t, " s");
    };
    return Signal::function(item, call, 1, std::move(profile.times));
  }
  if (profile.times.empty() && profile.factors.empty()) {
    return Signal::constant(VectorXd::Ones(1));
  }
  const auto column = [](const std::vector<double>& v) {
    return VectorXd(Eigen::Map<const VectorXd>(v.data(), static_cast<Index>(v.size())));
  };
  for (std::size_t i = 0; i < profile.factors.size(); ++i) {
    detail::require(std::isfinite(profile.factors[i]), "the factors of ", item,
                    " must be finite, got ", profile.factors[i], " at index ", i);
  }
  return Signal::table(
      item, column(profile.times), column(profile.factors),
      profile.linear ? Signal::Interpolation::linear : Signal::Interpolation::previous);
}

}  // namespace

WrenchInput::WrenchInput(Wrenches wrenches)
    : wrenches_(std::move(wrenches)),
      factors_(wrenches_.size(), Signal::constant(VectorXd::Ones(1))) {}

void WrenchInput::add(const Wrench& wrench, Profile profile) {
  Signal factor = signal_of(std::move(profile));
  const std::vector<double>& times = factor.break_points();
  for (Index k = 0; k <= static_cast<Index>(times.size()); ++k) {
    hold_ = hold_ && factor.is_constant(k);
  }
  break_points_.insert(break_points_.end(), times.begin(), times.end());
  std::sort(break_points_.begin(), break_points_.end());
  break_points_.erase(std::unique(break_points_.begin(), break_points_.end()), break_points_.end());
  wrenches_.push_back(wrench);
  factors_.push_back(std::move(factor));
}

bool WrenchInput::has_unbroken_function() const noexcept {
  return std::any_of(factors_.begin(), factors_.end(),
                     [](const Signal& factor) { return factor.is_unbroken_function(); });
}

WrenchInput WrenchInput::since(double start) const {
  WrenchInput input = *this;
  for (Signal& factor : input.factors_) factor = factor.since(start);
  for (double& time : input.break_points_) time -= start;
  return input;
}

void WrenchInput::evaluate(double t, double start, Wrenches& now) const {
  assert(now.size() == wrenches_.size());
  const VectorXd no_state;
  Eigen::Matrix<double, 1, 1> factor;
  for (std::size_t i = 0; i < wrenches_.size(); ++i) {
    // No break point lies within a stretch, so its start tells the segment.
    factors_[i].evaluate(t, factors_[i].segment(start), no_state, no_state, factor);
    now[i].force = factor[0] * wrenches_[i].force;
    now[i].moment = factor[0] * wrenches_[i].moment;
  }
}

const WrenchInput& no_loads() noexcept {
  static const WrenchInput none;
  return none;
}

}  // namespace cdcr
