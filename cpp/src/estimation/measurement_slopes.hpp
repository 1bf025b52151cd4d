#pragma once

#include "cdcr/sensor.hpp"
#include "estimation/augmented_motion.hpp"

namespace cdcr::detail {

/// What a sensor is expected to tell and how that changes with the state x of a motion,
/// cpp/estimation.md eq. (98), cpp/base-wrench.md eq. (124). Real-time safe after construction.
/// It refers to the motion.
class MeasurementSlopes {
 public:
  /// The sensor fits the robot.
  MeasurementSlopes(AugmentedMotion& motion, const Sensor& sensor);

  /// At x under commands, or where the base was felt first, cf. AugmentedMotion::felt_base():
  /// value() without noise and, of the errors of detail::find_error, slopes() on x (size, size of
  /// x).
  void update(const VectorXd& x, const VectorXd& command) noexcept;
  /// The value alone.
  void update_value(const VectorXd& x, const VectorXd& command) noexcept;
  [[nodiscard]] const Sensor& sensor() const noexcept { return sensor_; }
  [[nodiscard]] const VectorXd& point() const noexcept { return point_; }  ///< that x
  [[nodiscard]] const VectorXd& value() const noexcept { return value_; }
  [[nodiscard]] const MatrixXd& slopes() const noexcept { return slopes_; }

 private:
  [[nodiscard]] const Model& model() const noexcept { return motion_->model(); }
  void set_cable_slopes(const ConstVectorRef& q, const ConstVectorRef& qd,
                        const ConstVectorRef& command) noexcept;
  void set_curvature_slopes() noexcept;
  void set_value(const VectorXd& x, const VectorXd& command) noexcept;

  AugmentedMotion* motion_;
  Sensor sensor_;
  VectorXd point_, value_, near_, error_, on_base_;
  MatrixXd slopes_, J_, B_, change_;
};

}  // namespace cdcr::detail
