#pragma once

#include <optional>

#include "cdcr/dynamics.hpp"
#include "cdcr/export.hpp"
#include "cdcr/gain.hpp"
#include "cdcr/tracking_controller.hpp"

namespace CDCR_EXPORT cdcr {

/// How the error of computed torque dies away: e'' + kd e' + kp e = 0.
struct ComputedTorqueOptions {
  Gain kp = 100.0;       ///< [1/s^2], >= 0; the square of a natural frequency
  Gain kd = 20.0;        ///< [1/s], >= 0; twice a damping ratio times that frequency
  double period = 1e-3;  ///< [s], > 0
  CommandLimits limits;
  /// How far ahead it reckons [s], >= 0, since commands are held: half a period unless given, and
  /// more where actuators are late.
  std::optional<double> lead;
  double delay = 0.0;  ///< how old measurements are [s], >= 0
};

/// Inverse dynamics and PD, Q = M (qdd_ref + kd e' + kp e) + h with e = ref - q, cpp/control.md
/// eqs. (105), (106): where cables can give any force and the model is true, the error of each
/// coordinate obeys a linear equation. Where they are fewer than the coordinates, that is true of
/// what they move, B^T q, where B is constant.
class ComputedTorque : public TrackingController {
 public:
  /// The reference is the shape at rest until set. Throws std::invalid_argument, also for a robot
  /// without inertia.
  explicit ComputedTorque(const Model& model, ComputedTorqueOptions options = {});
  [[nodiscard]] const ComputedTorqueOptions& options() const noexcept { return options_; }
  /// How far ahead it reckons [s].
  [[nodiscard]] double lead() const noexcept { return lead_; }

 protected:
  Status control(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const Setpoint& wanted) noexcept override;

 private:
  void set_acceleration(const Setpoint& wanted, const ConstVectorRef& q,
                        const ConstVectorRef& qd) noexcept;
  void set_force(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept;

  Data data_;
  ComputedTorqueOptions options_;
  double lead_;
  Setpoint ahead_;
  VectorXd q_, qd_, qdd_, error_, force_;
  MatrixXd M_;
};

}  // namespace CDCR_EXPORT cdcr
