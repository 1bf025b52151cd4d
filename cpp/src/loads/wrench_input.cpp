#include <algorithm>
#include <cmath>
#include <utility>

#include "base/arguments.hpp"
#include "cdcr/loads.hpp"

namespace cdcr {
namespace {

void check(const Profile& profile) {
  const auto& times = profile.times;
  detail::require(profile.function || profile.factors.size() == times.size(),
                  "a wrench's profile needs one factor for each time, got ", times.size(),
                  " times and ", profile.factors.size(), " factors");
  detail::require_increasing("the times of a wrench's profile", times.data(),
                             static_cast<Index>(times.size()));
  for (std::size_t i = 0; i < profile.factors.size(); ++i) {
    detail::require(std::isfinite(profile.factors[i]),
                    "the factors of a wrench's profile must be finite, got ", profile.factors[i],
                    " at index ", i);
  }
}

double factor(const Profile& profile, double t, double start, double end) {
  if (profile.function) {
    const double value = profile.function(t < end ? t : std::nextafter(end, -HUGE_VAL));
    detail::require(std::isfinite(value), "the profile of a wrench must give finite factors, got ",
                    value, " at t = ", t, " s");
    return value;
  }
  const auto& times = profile.times;
  if (times.empty()) return 1.0;
  // Held tables see the start of the stretch: no break point lies within one.
  const double at = profile.linear ? t : start;
  const auto next = std::upper_bound(times.begin(), times.end(), at);
  if (next == times.begin()) return profile.factors.front();
  const auto i = static_cast<std::size_t>(next - times.begin()) - 1;
  if (!profile.linear || next == times.end()) return profile.factors[i];
  const double share = (t - times[i]) / (times[i + 1] - times[i]);
  return profile.factors[i] + share * (profile.factors[i + 1] - profile.factors[i]);
}

}  // namespace

Loads::Loads(Wrenches wrenches) : wrenches_(std::move(wrenches)), profiles_(wrenches_.size()) {}

void Loads::add(const Wrench& wrench, Profile profile) {
  check(profile);
  if (profile.function || (profile.linear && profile.times.size() > 1)) hold_ = false;
  break_points_.insert(break_points_.end(), profile.times.begin(), profile.times.end());
  std::sort(break_points_.begin(), break_points_.end());
  break_points_.erase(std::unique(break_points_.begin(), break_points_.end()), break_points_.end());
  wrenches_.push_back(wrench);
  profiles_.push_back(std::move(profile));
}

void Loads::evaluate(double t, double start, double end, Wrenches& now) const {
  for (std::size_t i = 0; i < wrenches_.size(); ++i) {
    const double size = factor(profiles_[i], t, start, end);
    now[i].force = size * wrenches_[i].force;
    now[i].moment = size * wrenches_[i].moment;
  }
}

const Loads& no_loads() noexcept {
  static const Loads none;
  return none;
}

}  // namespace cdcr
