#pragma once

#include <optional>
#include <vector>

#include "cdcr/actuator.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/estimator.hpp"
#include "cdcr/export.hpp"

namespace CDCR_EXPORT cdcr {

/// How a momentum observer hears forces.
struct MomentumObserverOptions {
  double bandwidth = 30.0;  ///< of what it tells, a first-order lag of the truth [rad/s], > 0
  double period = 1e-3;     ///< [s]
  std::vector<Actuator> actuators;  ///< between command and cables, as in a loop
  std::optional<Place> force_at;    ///< where one force is what there is; it is told too [N]
  double damping = 1e-2;  ///< of the inverse that finds it, over the robot's length [1/rad], > 0
};

/// Generalised force that the model knows nothing of, from the change of momentum, without
/// accelerations (De Luca and others 2006); and the force on one place that explains it best,
/// cpp/estimation.md eqs. (102) to (104).
///
/// As an estimator it leaves the state as it is told: by sensors of coordinates and rates, or by
/// another estimator, which it asks first. Set up: the constructor allocates and throws
/// std::invalid_argument. Run: everything else is real-time safe. It refers to the other estimator,
/// which must outlive it.
class MomentumObserver : public Estimator {
 public:
  explicit MomentumObserver(const Model& model, MomentumObserverOptions options = {},
                            Estimator* states = nullptr);

  void reset(const ConstVectorRef& q, const ConstVectorRef& qd,
             const ConstVectorRef& command) noexcept override;
  [[nodiscard]] Status update(double t, const std::vector<Measurement>& told,
                              const ConstVectorRef& command, VectorRef q,
                              VectorRef qd) noexcept override;
  [[nodiscard]] double period() const noexcept override { return options_.period; }
  void require_robot(const Model& model) const override;
  void require_fit(const Model& model, const std::vector<Sensor>& sensors) const override;
  /// Of the generalised force, as the coordinates with Q_ before, then of the force: force_x, ...;
  /// those of the other estimator after them.
  [[nodiscard]] std::vector<std::string> value_names() const override;
  void write_values(VectorRef values, VectorRef deviations) const noexcept override;
  [[nodiscard]] EstimatorDiagnostics diagnostics() const noexcept override { return diagnostics_; }
  /// Without that of the other estimator.
  [[nodiscard]] VectorXd memory() const override;
  void set_memory(const VectorXd& memory) override;

  [[nodiscard]] const VectorXd& generalized_force() const noexcept { return residual_; }  ///< (d)
  /// On the place, in the base frame [N]; zero without one.
  [[nodiscard]] const Vector3d& force() const noexcept { return force_; }
  [[nodiscard]] const Model& model() const noexcept { return model_; }
  [[nodiscard]] const MomentumObserverOptions& options() const noexcept { return options_; }

 private:
  void observe(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept;
  void set_drift(const ConstVectorRef& q, const ConstVectorRef& qd, VectorRef drift) noexcept;
  void set_force(const Place& at, const ConstVectorRef& q) noexcept;
  template <class Self, class Visit>
  static void visit_memory(Self& self, Visit& visit);
  [[nodiscard]] Index num_own() const noexcept {
    return residual_.size() + (options_.force_at ? 3 : 0);
  }

  Model model_;
  Data data_;
  MomentumObserverOptions options_;
  Estimator* states_;
  Index num_others_;
  Actuators actuators_;
  double damping_ = 0.0;                // [m/rad]
  bool set_ = false, started_ = false;  // reset, and updated since
  VectorXd q_, qd_, momentum_, drift_;  // of the update before
  VectorXd residual_, next_momentum_, next_drift_, cables_, near_, tension_;
  Vector3d force_ = Vector3d::Zero();
  MatrixXd M_, J_;
  EstimatorDiagnostics diagnostics_;
};

}  // namespace CDCR_EXPORT cdcr
