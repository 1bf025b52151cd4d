#pragma once

#include <optional>

#include "cdcr/dynamics.hpp"
#include "cdcr/export.hpp"
#include "cdcr/gain.hpp"
#include "cdcr/tracking_controller.hpp"

namespace CDCR_EXPORT cdcr {

/// How the error of the tip dies away, and what the robot does beside.
struct TaskSpaceOptions {
  Gain kp = 100.0;  ///< of the tip's position, or pose, [1/s^2], >= 0
  Gain kd = 20.0;   ///< of its velocity [1/s], >= 0
  /// What a radian is worth about the axes of the tip, one value for all or three [m/rad], >= 0;
  /// empty: the tip may turn as it likes. Zero lets it turn about that axis.
  VectorXd orientation_weight;
  double posture_kp = 25.0;  ///< of the coordinates, where the tip leaves them free [1/s^2], >= 0
  double posture_kd = 10.0;  ///< [1/s], >= 0
  VectorXd posture;          ///< to be near to (d) [rad]; empty: the shape at rest
  double damping = 1e-2;     ///< of the inverse, over the robot's length [1/rad], > 0
  double period = 1e-3;      ///< [s], > 0
  CommandLimits limits;
  std::optional<double> lead;  ///< how far ahead it reckons [s], as ComputedTorqueOptions::lead
  double delay = 0.0;          ///< how old measurements are [s], >= 0
};

/// Moves the tip along a reference in the base frame, positions (3) [m] or, with a weight of
/// orientations, poses (6), these and rotation vectors [rad]: accelerations by the damped inverse
/// of its Jacobian, a posture in the null space, inverse dynamics, cpp/control.md eqs. (91),
/// (92).
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
  void set_errors(const Setpoint& wanted, const ConstVectorRef& q,
                  const ConstVectorRef& qd) noexcept;
  [[nodiscard]] bool turns() const noexcept { return J_.rows() == 6; }

  Data data_;
  TaskSpaceOptions options_;
  double lead_;
  double damping_ = 0.0;  // [m/rad]
  Setpoint ahead_at_;
  VectorXd posture_, q_, qd_, near_, qdd_, free_, force_;
  VectorXd error_, rate_error_, task_, bias_, solved_;  // (3), with orientation (6)
  MatrixXd J_, tip_J_, M_, inverse_;
};

}  // namespace CDCR_EXPORT cdcr
