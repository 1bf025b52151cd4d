#include <algorithm>
#include <cmath>
#include <utility>

#include "base/arguments.hpp"
#include "cdcr/tension_input.hpp"

namespace cdcr {
namespace {

using detail::require;
using detail::require_increasing;
using detail::sentence;

template <class Item>
void require_pulling(double value, const Item& item) {
  require(value >= 0.0 && std::isfinite(value), item,
          " must be finite and >= 0 N (a cable cannot push), got ", value);
}

}  // namespace

TensionInput TensionInput::constant(const VectorXd& tension) {
  for (Index j = 0; j < tension.size(); ++j) {
    require_pulling(tension[j], sentence("tension[", j, "]"));
  }
  TensionInput input;
  input.num_cables_ = tension.size();
  input.values_ = tension;
  return input;
}

TensionInput TensionInput::table(const VectorXd& times, const MatrixXd& tensions,
                                 Interpolation interpolation) {
  require(times.size() > 0 && tensions.rows() == times.size(),
          "a tension table needs one row of tensions for each time, got ", times.size(),
          " times and ", tensions.rows(), " rows");
  TensionInput input;
  input.times_.assign(times.data(), times.data() + times.size());
  require_increasing("the times of a tension table", times.data(), times.size());
  for (Index i = 0; i < tensions.rows(); ++i) {
    for (Index j = 0; j < tensions.cols(); ++j) {
      require_pulling(tensions(i, j), sentence("tension[", i, ", ", j, "]"));
    }
  }
  input.num_cables_ = tensions.cols();
  input.values_ = tensions.transpose();
  input.interpolation_ = interpolation;
  return input;
}

TensionInput TensionInput::function(Function function, Index num_cables,
                                    std::vector<double> break_points) {
  require(static_cast<bool>(function), "the tension function is empty");
  require_increasing("break_points", break_points.data(), static_cast<Index>(break_points.size()));
  TensionInput input;
  input.num_cables_ = num_cables;
  input.times_ = std::move(break_points);
  input.function_ = std::move(function);
  return input;
}

Index TensionInput::segment(double t) const noexcept {
  return std::upper_bound(times_.begin(), times_.end(), t) - times_.begin();
}

bool TensionInput::holds(Index segment) const noexcept {
  if (function_) return false;
  return interpolation_ == Interpolation::previous || segment == 0 || segment >= values_.cols();
}

void TensionInput::evaluate(double t, Index segment, const ConstVectorRef& q,
                            const ConstVectorRef& qd, VectorRef tension) const {
  if (function_) {
    // A break point belongs to the segment after it; the one before sees the value just before it.
    const bool beyond = segment < static_cast<Index>(times_.size()) && t >= times_[segment];
    function_(beyond ? std::nextafter(times_[segment], -HUGE_VAL) : t, q, qd, tension);
    return;
  }
  const Index from = std::clamp<Index>(segment - 1, 0, values_.cols() - 1);
  if (holds(segment)) {
    tension = values_.col(from);
    return;
  }
  const double share = (t - times_[from]) / (times_[from + 1] - times_[from]);
  tension = values_.col(from) + share * (values_.col(from + 1) - values_.col(from));
}

}  // namespace cdcr
