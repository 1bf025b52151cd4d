#pragma once

#include <optional>

#include "cdcr/dynamics.hpp"
#include "cdcr/export.hpp"
#include "cdcr/gain.hpp"
#include "cdcr/tracking_controller.hpp"

namespace CDCR_EXPORT cdcr {

/// How the error of the tip dies away, and what the robot does beside.
struct TaskSpaceOptions {
  Gain kp = 100.0;           ///< of the tip's position [1/s^2], >= 0
  Gain kd = 20.0;            ///< of its velocity [1/s], >= 0
  double posture_kp = 25.0;  ///< of the coordinates, where the tip leaves them free [1/s^2], >= 0
  double posture_kd = 10.0;  ///< [1/s], >= 0
  VectorXd posture;          ///< to be near to (d) [rad]; empty: the shape at rest
  double damping = 1e-2;     ///< of the inverse, over the robot's length [1/rad], > 0
  double period = 1e-3;      ///< [s], > 0
  CommandLimits limits;
  std::optional<double> lead;  ///< how far ahead it reckons [s], as ComputedTorqueOptions::lead
  double delay = 0.0;          ///< how old measurements are [s], >= 0
};

/// Moves the tip along a reference (3) [m] in the base frame: accelerations by the damped inverse
/// of its Jacobian, a posture in the null space, inverse dynamics, cpp/control.md eqs. (108),
/// (109).
class TaskSpace : public TrackingController {
 public:
  /// The reference is the tip of the shape at rest until set. Throws std::invalid_argument.
  explicit TaskSpace(const Model& model, TaskSpaceOptions options = {});
  [[nodiscard]] const TaskSpaceOptions& options() const noexcept { return options_; }

 protected:
  Status control(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const Setpoint& wanted) noexcept override;

 private:
  void set_acceleration(const Setpoint& wanted, const ConstVectorRef& q,
                        const ConstVectorRef& qd) noexcept;
  void set_force(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept;
  void set_velocity_terms(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept;
  void set_inverse() noexcept;

  Data data_;
  TaskSpaceOptions options_;
  double lead_;
  double damping_ = 0.0;  // [m/rad]
  Setpoint ahead_at_;
  VectorXd posture_, q_, qd_, near_, qdd_, free_, force_;
  VectorXd error_, task_, bias_, solved_;  // (3)
  MatrixXd J_, near_J_, M_;
  Matrix3d inverse_ = Matrix3d::Zero();
};

}  // namespace CDCR_EXPORT cdcr
