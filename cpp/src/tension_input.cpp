#include "cdcr/tension_input.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace cdcr {
namespace {

void require_increasing(const std::vector<double>& times, const char* item) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1])) {
      std::ostringstream text;
      text << item << " must be finite and strictly increasing, got " << times[i] << " s at index "
           << i;
      if (i > 0) text << " after " << times[i - 1] << " s";
      throw std::invalid_argument(text.str());
    }
  }
}

void require_pulling(double value, const std::string& item) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    std::ostringstream text;
    text << item << " must be finite and >= 0 N (a cable cannot push), got " << value;
    throw std::invalid_argument(text.str());
  }
}

}  // namespace

TensionInput TensionInput::constant(const VectorXd& tension) {
  for (Index j = 0; j < tension.size(); ++j) {
    require_pulling(tension[j], "tension[" + std::to_string(j) + "]");
  }
  TensionInput input;
  input.num_cables_ = tension.size();
  input.values_ = tension;
  return input;
}

TensionInput TensionInput::table(const VectorXd& times, const MatrixXd& tensions,
                                 Interpolation interpolation) {
  if (times.size() == 0 || tensions.rows() != times.size()) {
    throw std::invalid_argument("a tension table needs one row of tensions for each time, got " +
                                std::to_string(times.size()) + " times and " +
                                std::to_string(tensions.rows()) + " rows");
  }
  TensionInput input;
  input.times_.assign(times.data(), times.data() + times.size());
  require_increasing(input.times_, "the times of a tension table");
  for (Index i = 0; i < tensions.rows(); ++i) {
    for (Index j = 0; j < tensions.cols(); ++j) {
      require_pulling(tensions(i, j),
                      "tension[" + std::to_string(i) + ", " + std::to_string(j) + "]");
    }
  }
  input.num_cables_ = tensions.cols();
  input.values_ = tensions.transpose();
  input.interpolation_ = interpolation;
  return input;
}

TensionInput TensionInput::function(Function function, Index num_cables,
                                    std::vector<double> break_points) {
  if (!function) throw std::invalid_argument("the tension function is empty");
  require_increasing(break_points, "break_points");
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
