#include "cdcr/sensor.hpp"

#include <cmath>

#include "base/constants.hpp"
#include "base/sizes.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/kinematics.hpp"
#include "control/steps.hpp"

namespace cdcr {
namespace {

Index size_of(const Model& model, const Sensor& sensor) {
  switch (sensor.kind) {
    case Sensor::Kind::lengths:
    case Sensor::Kind::tensions:
      return model.num_cables();
    case Sensor::Kind::tip:
      return 3;
    case Sensor::Kind::curvature:
      return 2 * static_cast<Index>(sensor.places.size());
    default:
      return model.num_coordinates();
  }
}

void check(const Model& model, const Sensor& sensor) {
  detail::require_not_negative("noise of a sensor", sensor.noise, "in the unit of its values");
  detail::require(std::isfinite(sensor.bias), "bias of a sensor must be finite, got ", sensor.bias);
  detail::require(sensor.kind != Sensor::Kind::curvature || !sensor.places.empty(),
                  "a sensor of curvature needs places");
  for (const Place& place : sensor.places) {
    detail::require(detail::is_section(model, place.section) && detail::is_fraction(place.fraction),
                    "places of a sensor must be sections 0 to ", model.num_sections() - 1,
                    " and fractions 0 to 1, got section ", place.section, " and fraction ",
                    place.fraction);
  }
}

}  // namespace

SensorChannel::SensorChannel(const Model& model, const Sensor& sensor, double step)
    : model_(model),
      sensor_(sensor),
      every_(sensor.period == 0.0
                 ? 1
                 : detail::whole_steps("period of a sensor", sensor.period, step, 1)),
      delay_(detail::whole_steps("delay of a sensor", sensor.delay, step, 0)) {
  check(model, sensor);
  value_ = measured_ = VectorXd::Zero(size_of(model, sensor));
  late_ = MatrixXd::Zero(value_.size(), delay_ + 1);
  sent_.assign(static_cast<std::size_t>(delay_ + 1), 0);
}

void SensorChannel::reset(const ConstVectorRef& q, const ConstVectorRef& qd,
                          const ConstVectorRef& command) noexcept {
  random_state_ = sensor_.seed;
  measure(q, qd, command, value_);
  value_.array() += sensor_.bias;
  std::fill(sent_.begin(), sent_.end(), 0);
}

bool SensorChannel::step(long long steps, const ConstVectorRef& q, const ConstVectorRef& qd,
                         const ConstVectorRef& command) noexcept {
  const Index columns = delay_ + 1;
  const auto now = static_cast<Index>(steps % columns), due = (now + 1) % columns;
  sent_[static_cast<std::size_t>(now)] = steps % every_ == 0 ? 1 : 0;
  if (sent_[static_cast<std::size_t>(now)] != 0) {
    measure(q, qd, command, measured_);
    measured_.array() += sensor_.bias;
    if (sensor_.noise > 0.0) {
      for (Index i = 0; i < measured_.size(); ++i) measured_[i] += sensor_.noise * normal();
    }
    late_.col(now) = measured_;
  }
  if (sent_[static_cast<std::size_t>(due)] == 0) return false;
  value_ = late_.col(due);
  return true;
}

void SensorChannel::measure(const ConstVectorRef& q, const ConstVectorRef& qd,
                            const ConstVectorRef& command, VectorRef out) noexcept {
  switch (sensor_.kind) {
    case Sensor::Kind::coordinates:
      out = q;
      return;
    case Sensor::Kind::rates:
      out = qd;
      return;
    case Sensor::Kind::lengths:
      cable_lengths(model_, q, out);
      return;
    case Sensor::Kind::tensions:
      cable_tensions(model_, q, qd, command, out);
      return;
    case Sensor::Kind::tip:
      out = tip(model_, q).p;
      return;
    case Sensor::Kind::curvature:
      for (Index i = 0; i < out.size(); ++i) {
        out[i] = curvature(sensor_.places[static_cast<std::size_t>(i / 2)], q, i % 2);
      }
      return;
  }
}

/// The bending there over the length, cpp/rods.md eq. (51).
double SensorChannel::curvature(const Place& place, const ConstVectorRef& q,
                                Index axis) const noexcept {
  const Section& section = model_.robot().sections[static_cast<std::size_t>(place.section)];
  const Index first = model_.first_coordinate(place.section);
  const double x = 2.0 * place.fraction - 1.0;
  double sum = 0.0, before = 0.0, legendre = 1.0;
  for (int j = 0; j <= section.bending_order; ++j) {
    sum += legendre * q[first + Index{2} * j + axis];
    const double next = ((2.0 * j + 1.0) * x * legendre - j * before) / (j + 1.0);
    before = legendre;
    legendre = next;
  }
  return sum / section.length;
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
