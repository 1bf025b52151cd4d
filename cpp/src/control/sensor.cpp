#include "cdcr/sensor.hpp"

#include <cmath>

#include "base/constants.hpp"
#include "control/measurement.hpp"
#include "control/steps.hpp"

namespace cdcr {

SensorChannel::SensorChannel(const Model& model, const Sensor& sensor, double step,
                             const std::string& name)
    : model_(model),
      sensor_(sensor),
      every_(sensor.period == 0.0
                 ? 1
                 : detail::whole_steps(("period of " + name).c_str(), sensor.period, step, 1)),
      delay_(detail::whole_steps(("delay of " + name).c_str(), sensor.delay, step, 0)) {
  detail::require_sensor(model, sensor, name);
  value_ = measured_ = error_ = VectorXd::Zero(detail::measurement_size(model, sensor));
  late_ = MatrixXd::Zero(value_.size(), delay_ + 1);
  sent_.assign(static_cast<std::size_t>(delay_ + 1), 0);
}

void SensorChannel::reset(const ConstVectorRef& q, const ConstVectorRef& qd,
                          const ConstVectorRef& command, const ConstVectorRef& on_base) noexcept {
  random_state_ = sensor_.seed;
  detail::measure(model_, sensor_, q, qd, command, on_base, value_);
  error_.setConstant(sensor_.bias);
  detail::add_error(sensor_.kind, error_, value_);
  std::fill(sent_.begin(), sent_.end(), 0);
}

bool SensorChannel::step(long long steps, const ConstVectorRef& q, const ConstVectorRef& qd,
                         const ConstVectorRef& command, const ConstVectorRef& on_base) noexcept {
  const Index columns = delay_ + 1;
  const auto now = static_cast<Index>(steps % columns), due = (now + 1) % columns;
  sent_[static_cast<std::size_t>(now)] = steps % every_ == 0 ? 1 : 0;
  if (sent_[static_cast<std::size_t>(now)] != 0) {
    detail::measure(model_, sensor_, q, qd, command, on_base, measured_);
    error_.setConstant(sensor_.bias);
    if (sensor_.noise > 0.0) {
      for (Index i = 0; i < error_.size(); ++i) error_[i] += sensor_.noise * normal();
    }
    detail::add_error(sensor_.kind, error_, measured_);
    late_.col(now) = measured_;
  }
  if (sent_[static_cast<std::size_t>(due)] == 0) return false;
  value_ = late_.col(due);
  return true;
}

/// splitmix64, by Sebastiano Vigna.
std::uint64_t SensorChannel::random() noexcept {
  std::uint64_t z = (random_state_ += 0x9e3779b97f4a7c15U);
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

/// A normal number, by Box and Muller.
double SensorChannel::normal() noexcept {
  constexpr double unit = 1.0 / 9007199254740992.0;  // 2^-53
  const double u = (static_cast<double>(random() >> 11U) + 0.5) * unit;
  const double v = static_cast<double>(random() >> 11U) * unit;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(detail::full_circle * v);
}

}  // namespace cdcr
