#pragma once

#include "cdcr/dynamics.hpp"
#include "cdcr/export.hpp"
#include "cdcr/tracking_controller.hpp"

namespace CDCR_EXPORT cdcr {

/// A linear law on the state, u = u_ref - K (x - x_ref), x = (q, qd).
struct StateFeedbackOptions {
  MatrixXd gain;     ///< K (num_cables, 2d) [N/rad], [N s/rad]; [m/rad], [m s/rad] of lengths
  VectorXd command;  ///< u_ref (num_cables); empty: what holds the reference still, within limits
  double period = 1e-3;  ///< [s], > 0
  CommandLimits limits;
};

/// State feedback, with a gain such as that of a linear quadratic regulator. Commands beyond the
/// limits are replaced by the nearest tensions within them that bend the robot alike, eq. (90).
class StateFeedback : public TrackingController {
 public:
  /// The reference is the shape at rest until set. Throws std::invalid_argument.
  StateFeedback(const Model& model, StateFeedbackOptions options);
  [[nodiscard]] const StateFeedbackOptions& options() const noexcept { return options_; }

 protected:
  Status control(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                 const Setpoint& wanted) noexcept override;
  void accept(const ReferencePath& path) override;

 private:
  void hold_reference(const VectorXd& reference) noexcept;

  Data data_;
  StateFeedbackOptions options_;
  Allocator holding_;
  VectorXd error_, hold_, command_, tension_, force_;
  MatrixXd B_;
  bool holds_ = false;
};

}  // namespace CDCR_EXPORT cdcr
