#pragma once

#include "cdcr/sensor.hpp"

// What sensors measure, without period, delay, noise and bias.

namespace cdcr::detail {

/// How many values a sensor tells.
[[nodiscard]] Index measurement_size(const Model& model, const Sensor& sensor);
/// Throws std::invalid_argument, naming it, where a sensor does not fit the robot.
void require_sensor(const Model& model, const Sensor& sensor, const std::string& name);

/// The values at a state under commands; the wrench on the base (6) is read where it is felt.
/// Real-time safe.
void measure(const Model& model, const Sensor& sensor, const ConstVectorRef& q,
             const ConstVectorRef& qd, const ConstVectorRef& command, const ConstVectorRef& on_base,
             VectorRef out) noexcept;
/// value with an error: added, or, of an orientation, a turn about the axes of the tip.
void add_error(Sensor::Kind kind, const ConstVectorRef& error, VectorRef value) noexcept;
/// The error that makes `told` of `expected`: add_error the other way round.
void find_error(Sensor::Kind kind, const ConstVectorRef& told, const ConstVectorRef& expected,
                VectorRef error) noexcept;

/// Legendre's polynomials P_0 .. at a place of a section with so many coefficients, by their
/// recursion: calls use(j, P_j).
template <class Use>
void legendre_at(double fraction, int order, const Use& use) noexcept {
  const double x = 2.0 * fraction - 1.0;
  double before = 0.0, legendre = 1.0;
  for (int j = 0; j <= order; ++j) {
    use(j, legendre);
    const double next = ((2.0 * j + 1.0) * x * legendre - j * before) / (j + 1.0);
    before = legendre;
    legendre = next;
  }
}

}  // namespace cdcr::detail
