#pragma once

#include "cdcr/sensor.hpp"

namespace cdcr::detail {

/// What a sensor is expected to tell and how that changes with the state, cpp/estimation.md eq.
/// (98). Real-time safe after construction.
class MeasurementSlopes {
 public:
  MeasurementSlopes(const Model& model, const Sensor& sensor);

  /// At (q, qd) under commands: value() without noise and, of the errors of detail::find_error,
  /// slopes() on (q, qd) (size, 2d).
  void update(const ConstVectorRef& q, const ConstVectorRef& qd,
              const ConstVectorRef& command) noexcept;
  /// The value alone.
  void update_value(const ConstVectorRef& q, const ConstVectorRef& qd,
                    const ConstVectorRef& command) noexcept;
  [[nodiscard]] const Sensor& sensor() const noexcept { return sensor_; }
  [[nodiscard]] const VectorXd& value() const noexcept { return value_; }
  [[nodiscard]] const MatrixXd& slopes() const noexcept { return slopes_; }

 private:
  void set_cable_slopes(const ConstVectorRef& q, const ConstVectorRef& qd,
                        const ConstVectorRef& command) noexcept;
  void set_curvature_slopes() noexcept;

  Model model_;
  Sensor sensor_;
  VectorXd value_, near_, error_;
  MatrixXd slopes_, J_, B_, change_;
};

}  // namespace cdcr::detail
