#pragma once

#include "cdcr/allocation.hpp"
#include "cdcr/controller.hpp"
#include "cdcr/export.hpp"

namespace CDCR_EXPORT cdcr {

/// Gains of a PID loop on the bending vectors, whose output is a generalised force. The same for
/// every component, so the loop has no preferred direction.
struct PidOptions {
  double kp = 0.0;           ///< [N m/rad], >= 0
  double ki = 0.0;           ///< [N m/(rad s)], >= 0
  double kd = 0.0;           ///< [N m s/rad], >= 0, on the measured rate
  double period = 1e-3;      ///< [s], > 0
  bool feed_forward = true;  ///< adds the force that holds the reference still, dU/dq
  bool anti_windup = true;   ///< stops integrating what the tension limits cannot give
  TensionLimits limits;
};

/// Q = dU/dq(ref) + kp (ref - q) + ki int (ref - q) dt - kd qd, allocated to tensions.
class Pid : public Controller {
 public:
  /// The reference is the straight robot until set. Throws std::invalid_argument.
  Pid(const Model& model, PidOptions options);

  /// Bending vectors to reach and hold (d) [rad]. Throws std::invalid_argument.
  void set_reference(const VectorXd& q);
  [[nodiscard]] const VectorXd& reference() const noexcept { return reference_; }
  /// Accumulated error (d) [rad s].
  [[nodiscard]] const VectorXd& integral() const noexcept { return integral_; }
  /// Takes up the integral of another run (d) [rad s], finite. Throws std::invalid_argument.
  void set_integral(const VectorXd& integral);
  [[nodiscard]] const PidOptions& options() const noexcept { return options_; }

  void reset() noexcept override { integral_.setZero(); }
  [[nodiscard]] Status update(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                              VectorRef tension) noexcept override;
  [[nodiscard]] double period() const noexcept override { return options_.period; }
  [[nodiscard]] Index num_coordinates() const noexcept override { return model_.num_coordinates(); }
  [[nodiscard]] Index num_cables() const noexcept override { return model_.num_cables(); }
  [[nodiscard]] bool gives_tensions() const noexcept override { return true; }

 private:
  Model model_;
  Data data_;
  PidOptions options_;
  Allocator allocator_;
  VectorXd reference_, hold_, integral_, force_;
};

}  // namespace CDCR_EXPORT cdcr
