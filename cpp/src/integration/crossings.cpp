#include "integration/crossings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace cdcr::detail {
namespace {

constexpr Index num_nodes = 5;  // evenly over a step, its ends among them
constexpr int most_iterations = 100;
// An extreme is looked at when a parabola puts it beyond zero, or this near for its values.
constexpr double near_zero = 0.1;

}  // namespace

Crossings::Crossings(VectorXd dead_band, Index num_states, Values values)
    : evaluate_(std::move(values)),
      dead_band_(std::move(dead_band)),
      signs_(VectorXd::Zero(dead_band_.size())),
      values_(signs_),
      y_(VectorXd::Zero(num_states)),
      nodes_(dead_band_.size(), num_nodes) {}

const std::vector<Crossing>& Crossings::start(double t, const VectorXd& y) {
  found_.clear();
  resume(t, y);
  for (Index i = 0; i < signs_.size(); ++i) {
    if (std::abs(values_[i]) <= dead_band_[i]) continue;
    const double sign = values_[i] > 0.0 ? 1.0 : -1.0;
    if (sign * signs_[i] < 0.0) {
      found_.push_back({t, i, sign > 0.0});
    } else {
      signs_[i] = sign;
    }
  }
  return found_;
}

void Crossings::resume(double t, const VectorXd& y) {
  if (signs_.size() == 0) return;
  evaluate_(t, y, values_);
  nodes_.col(num_nodes - 1) = values_;
}

void Crossings::accept(const Crossing& crossing) {
  signs_[crossing.function] = crossing.rising ? 1.0 : -1.0;
}

double Crossings::value(Integrator& integrator, double t, Index function) {
  integrator.interpolate(t, y_);
  evaluate_(t, y_, values_);
  return values_[function];
}

const std::vector<Crossing>& Crossings::find(Integrator& integrator, double begin) {
  found_.clear();
  if (signs_.size() == 0) return found_;
  const double end = integrator.time();
  std::array<double, num_nodes> times{};
  nodes_.col(0) = nodes_.col(num_nodes - 1);
  for (Index k = 0; k < num_nodes; ++k) {
    const double share = static_cast<double>(k) / (num_nodes - 1);
    times[k] = k + 1 < num_nodes ? begin + share * (end - begin) : end;
    if (k == 0) continue;
    integrator.interpolate(times[k], y_);
    evaluate_(times[k], y_, values_);
    nodes_.col(k) = values_;
  }
  for (Index i = 0; i < signs_.size(); ++i) {
    points_.clear();
    for (Index k = 0; k < num_nodes; ++k) points_.push_back({times[k], nodes_(i, k)});
    add_extremes(integrator, i);
    double sign = signs_[i];
    for (std::size_t k = 1; k < points_.size(); ++k) {
      const double now = points_[k].value;
      if (std::abs(now) <= dead_band_[i]) continue;
      if (sign == 0.0) {
        sign = signs_[i] = now > 0.0 ? 1.0 : -1.0;
      } else if (now * sign < 0.0) {
        sign = -sign;
        found_.push_back({locate(integrator, points_[k - 1], points_[k], i), i, sign > 0.0});
      }
    }
  }
  std::stable_sort(found_.begin(), found_.end(),
                   [](const Crossing& a, const Crossing& b) { return a.time < b.time; });
  return found_;
}

/// Adds the points between nodes at which a function comes near zero and turns back.
void Crossings::add_extremes(Integrator& integrator, Index function) {
  const double spacing = points_[1].time - points_[0].time;
  const std::vector<Point> nodes = points_;
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
    const double before = nodes[k - 1].value, here = nodes[k].value, after = nodes[k + 1].value;
    const double slope = 0.5 * (after - before), bend = before - 2.0 * here + after;
    const bool one_side = before * here > 0.0 && here * after > 0.0;
    if (!one_side || bend == 0.0 || std::abs(slope) >= std::abs(bend)) continue;
    const double extreme = here - 0.5 * slope * slope / bend;
    if (here * bend < 0.0 || extreme * here > near_zero * here * here) continue;
    const double t = nodes[k].time - slope / bend * spacing;
    points_.push_back({t, value(integrator, t, function)});
  }
  std::sort(points_.begin(), points_.end(),
            [](const Point& a, const Point& b) { return a.time < b.time; });
}

/// The first time known to lie beyond the crossing, by the Illinois method.
double Crossings::locate(Integrator& integrator, Point before, Point after, Index function) {
  const double beyond = after.value > 0.0 ? 1.0 : -1.0;
  if (before.value * beyond >= 0.0) return before.time;  // by rounding already there
  const double resolution = 2.0 * std::numeric_limits<double>::epsilon() * std::abs(after.time);
  for (int i = 0; i < most_iterations && after.time - before.time > resolution; ++i) {
    const double share = before.value / (before.value - after.value);
    double t = before.time + share * (after.time - before.time);
    if (!(t > before.time && t < after.time)) t = 0.5 * (before.time + after.time);
    const double now = value(integrator, t, function);
    if (now * beyond >= 0.0) {
      after = {t, now};
      before.value *= 0.5;
      if (now == 0.0) break;
    } else {
      before = {t, now};
      after.value *= 0.5;
    }
  }
  return after.time;
}

}  // namespace cdcr::detail
