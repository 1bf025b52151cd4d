#include "cdcr/signal.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "base/arguments.hpp"

namespace cdcr {
namespace {

void require_times(const char* item, const std::vector<double>& times, bool with_jumps = false) {
  detail::require_increasing(item, times.data(), static_cast<Index>(times.size()), with_jumps);
}

}  // namespace

Signal Signal::constant(const VectorXd& value) {
  Signal signal;
  signal.size_ = value.size();
  signal.values_ = value;
  return signal;
}

Signal Signal::table(const char* item, const VectorXd& times, const MatrixXd& values,
                     Interpolation interpolation) {
  detail::require(times.size() > 0 && values.rows() == times.size(), item,
                  " needs one row of values for each time, got ", times.size(), " times and ",
                  values.rows(), " rows");
  Signal signal;
  signal.times_.assign(times.data(), times.data() + times.size());
  require_times(detail::sentence("the times of ", item).c_str(), signal.times_,
                interpolation == Interpolation::linear);
  signal.size_ = values.cols();
  signal.values_ = values.transpose();
  signal.interpolation_ = interpolation;
  return signal;
}

Signal Signal::function(const char* item, Function function, Index size,
                        std::vector<double> break_points) {
  detail::require(static_cast<bool>(function), item, " is empty");
  require_times("break_points", break_points);
  Signal signal;
  signal.size_ = size;
  signal.times_ = signal.given_ = std::move(break_points);
  signal.function_ = std::move(function);
  return signal;
}

Signal Signal::since(double start) const {
  Signal signal = *this;
  for (double& time : signal.times_) time -= start;
  signal.start_ += start;
  return signal;
}

Index Signal::segment(double t) const noexcept {
  return std::upper_bound(times_.begin(), times_.end(), t) - times_.begin();
}

bool Signal::is_constant(Index segment) const noexcept {
  assert(segment >= 0 && segment <= static_cast<Index>(times_.size()));
  if (function_) return false;
  return interpolation_ == Interpolation::previous || segment == 0 || segment >= values_.cols();
}

void Signal::evaluate(double t, Index segment, const ConstVectorRef& q, const ConstVectorRef& qd,
                      VectorRef value) const {
  assert(segment >= 0 && segment <= static_cast<Index>(times_.size()) && value.size() == size_);
  if (function_) {
    // A break point belongs to the segment after it; the one before sees the value just before it.
    double at = start_ + t;
    if (segment > 0) at = std::max(at, given_[segment - 1]);
    if (segment < static_cast<Index>(given_.size())) {
      at = std::min(at, std::nextafter(given_[segment], -HUGE_VAL));
    }
    function_(at, q, qd, value);
    return;
  }
  const Index from = std::clamp<Index>(segment - 1, 0, values_.cols() - 1);
  if (is_constant(segment)) {
    value = values_.col(from);
    return;
  }
  const double share = (t - times_[from]) / (times_[from + 1] - times_[from]);
  value = values_.col(from) + share * (values_.col(from + 1) - values_.col(from));
}

}  // namespace cdcr
