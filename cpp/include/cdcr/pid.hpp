#pragma once

#include "cdcr/dynamics.hpp"
#include "cdcr/export.hpp"
#include "cdcr/gain.hpp"
#include "cdcr/tracking_controller.hpp"

namespace CDCR_EXPORT cdcr {

/// Gains of a PID loop on the coordinates, whose output is a generalised force. A number is the
/// same for every component, so that the loop has no preferred direction.
struct PidOptions {
  Gain kp = 0.0;             ///< [N m/rad], >= 0
  Gain ki = 0.0;             ///< [N m/(rad s)], >= 0
  Gain kd = 0.0;             ///< [N m s/rad], >= 0, on the reference's rate less the measured one
  double period = 1e-3;      ///< [s], > 0
  bool feed_forward = true;  ///< adds the force that holds the reference still, dU/dq
  bool anti_windup = true;   ///< stops integrating what the limits cannot give
  TensionLimits limits = {};
  double max_rate = std::numeric_limits<double>::infinity();  ///< of a command [N/s], [m/s]
  /// Time constant [s] of the derivative, > 0, which is then that of the measured q; 0 takes the
  /// measured qd.
  double filter = 0.0;
};

/// Q = dU/dq(ref) + kp (ref - q) + ki int (ref - q) dt + kd (rate of ref - qd), allocated to the
/// cables, cpp/control.md eq. (86).
class Pid : public TrackingController {
 public:
  /// The reference is the shape at rest until set. Throws std::invalid_argument.
  Pid(const Model& model, PidOptions options);

  /// What is followed (d) [rad]; the value given to set_reference.
  [[nodiscard]] const VectorXd& reference() const noexcept { return setpoint().value; }
  /// Accumulated error (d) [rad s].
  [[nodiscard]] const VectorXd& integral() const noexcept { return integral_; }
  /// Takes up the integral of another run (d) [rad s], finite. Throws std::invalid_argument.
  void set_integral(const VectorXd& integral);
  [[nodiscard]] const PidOptions& options() const noexcept { return options_; }

  void reset() noexcept override;
  [[nodiscard]] VectorXd memory() const override;
  void set_memory(const VectorXd& memory) override;

 protected:
  Status control(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const Setpoint& wanted) noexcept override;
  void accept(const ReferencePath& path) override;

 private:
  void filter(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept;

  Data data_;
  PidOptions options_;
  VectorXd hold_, integral_, force_, error_, rate_error_;
  VectorXd last_q_, rate_;  // of the filter
  bool holds_ = false, filters_ = false;
};

}  // namespace CDCR_EXPORT cdcr
