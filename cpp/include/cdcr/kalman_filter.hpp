#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "cdcr/actuator.hpp"
#include "cdcr/estimator.hpp"
#include "cdcr/export.hpp"
#include "cdcr/model.hpp"

namespace CDCR_EXPORT cdcr {

/// What a Kalman filter knows and what it doubts.
struct KalmanOptions {
  /// What is measured, in the order in which it is told; noise > 0, bias known. Periods and delays
  /// are whole numbers of the filter's periods.
  std::vector<Sensor> sensors;
  double period = 1e-3;             ///< of the filter [s]
  int substeps = 1;                 ///< Runge-Kutta steps in each
  std::vector<Actuator> actuators;  ///< between command and cables, as in a loop

  /// Unknown accelerations: white noise on each coordinate, the root of its density [rad/s^1.5],
  /// one for all or one for each (d), >= 0.
  VectorXd acceleration_noise = VectorXd::Constant(1, 1.0);
  VectorXd start;               ///< estimate at reset (d) [rad]; empty: what reset is told
  double deviation = 0.1;       ///< standard deviation of each coordinate there [rad], >= 0
  double rate_deviation = 0.1;  ///< and of each rate [rad/s], >= 0

  /// A force on the backbone at this place is estimated too, in the base frame [N].
  std::optional<Place> force_at;
  double force_noise = 1.0;      ///< root of the density of its random walk [N/s^0.5], >= 0
  double force_deviation = 1.0;  ///< standard deviation at reset, about zero [N], >= 0

  /// Models that differ from the filter's in one parameter each: of each, the share of that
  /// difference is estimated too, 0 for the filter's model and 1 for the variant.
  std::vector<Model> variants;
  double share_noise = 0.0;      ///< root of the density of its random walk [1/s^0.5], >= 0
  double share_deviation = 0.3;  ///< standard deviation at reset, about zero, >= 0
};

/// Estimates the state of a robot from any of its sensors, by a model of how it moves,
/// cpp/estimation.md eqs. (94) to (101).
///
/// Where a sensor is late by D, the latest of them, the filter runs D behind: values of the others
/// wait for it, and from there the state is reckoned to now under the commands since. Set up: the
/// constructors allocate and throw std::invalid_argument. Run: everything else is real-time safe.
class KalmanFilter : public Estimator {
 public:
  ~KalmanFilter() override;
  KalmanFilter(KalmanFilter&&) noexcept;

  void reset(const ConstVectorRef& q, const ConstVectorRef& qd,
             const ConstVectorRef& command) noexcept override;
  [[nodiscard]] Status update(double t, const std::vector<Measurement>& told,
                              const ConstVectorRef& command, VectorRef q,
                              VectorRef qd) noexcept override;
  [[nodiscard]] double period() const noexcept override { return options_.period; }
  void require_robot(const Model& model) const override;
  void require_fit(const Model& model, const std::vector<Sensor>& sensors) const override;
  /// Of force and shares: force_x, ..., share_1, ...
  [[nodiscard]] std::vector<std::string> value_names() const override;
  void write_values(VectorRef values, VectorRef deviations) const noexcept override;
  [[nodiscard]] EstimatorDiagnostics diagnostics() const noexcept override { return diagnostics_; }
  [[nodiscard]] VectorXd memory() const override;
  void set_memory(const VectorXd& memory) override;

  /// The estimate now, (q, qd, force, shares), those of the last two that are estimated.
  [[nodiscard]] const VectorXd& state() const noexcept { return head_; }
  /// Its covariance by as much earlier as the latest sensor is late.
  [[nodiscard]] const MatrixXd& covariance() const noexcept { return P_; }
  [[nodiscard]] const Model& model() const noexcept;
  [[nodiscard]] const KalmanOptions& options() const noexcept { return options_; }
  /// Values that a sensor tells.
  [[nodiscard]] Index measurement_size(std::size_t sensor) const noexcept;

 protected:
  /// What its laws share; private to the library.
  struct Parts;
  KalmanFilter(const Model& model, KalmanOptions options);

  /// x_ and P_ a period on, under the command.
  virtual void predict(const VectorXd& command) noexcept = 0;
  /// x_ and P_ after what a sensor tells; notes the innovation.
  virtual void correct(std::size_t sensor, const ConstVectorRef& told,
                       const VectorXd& command) noexcept = 0;
  void note(double innovation, Index measured) noexcept;
  [[nodiscard]] Parts& parts() noexcept { return *parts_; }

  VectorXd x_;  // the estimate, as old as the latest sensor is late
  MatrixXd P_;

 private:
  [[nodiscard]] Status advance(const std::vector<Measurement>& told,
                               const ConstVectorRef& command) noexcept;
  [[nodiscard]] bool fits(const std::vector<Measurement>& told, const ConstVectorRef& command,
                          const ConstVectorRef& q, const ConstVectorRef& qd) const noexcept;
  template <class Self, class Visit>
  static void visit_memory(Self& self, Visit& visit);

  KalmanOptions options_;
  std::unique_ptr<Parts> parts_;
  VectorXd head_;
  EstimatorDiagnostics diagnostics_;
};

/// By the Jacobian of the motion and of what is measured; its covariance stays symmetric and, in
/// Joseph's form, positive.
class ExtendedKalman : public KalmanFilter {
 public:
  ExtendedKalman(const Model& model, KalmanOptions options);

 protected:
  void predict(const VectorXd& command) noexcept override;
  void correct(std::size_t sensor, const ConstVectorRef& told,
               const VectorXd& command) noexcept override;

 private:
  VectorXd next_, error_, from_, gain_, Ph_, Wh_;
  MatrixXd moved_;
};

/// How the points of an unscented filter are spread: at the root of spread^2 (size + kappa)
/// standard deviations.
struct UnscentedOptions {
  double spread = 1.0;  ///< positive
  double beta = 2.0;    ///< weight of the middle in covariances; 2 is best for normal errors
  double kappa = 0.0;   ///< size + kappa > 0
};

/// By points moved and measured one by one, in place of Jacobians.
class UnscentedKalman : public KalmanFilter {
 public:
  UnscentedKalman(const Model& model, KalmanOptions options, UnscentedOptions spread = {});
  [[nodiscard]] const UnscentedOptions& spread() const noexcept { return spread_; }

 protected:
  void predict(const VectorXd& command) noexcept override;
  void correct(std::size_t sensor, const ConstVectorRef& told,
               const VectorXd& command) noexcept override;

 private:
  void set_points() noexcept;
  void set_mean(const Eigen::Ref<const MatrixXd>& columns, VectorRef mean) const noexcept;

  UnscentedOptions spread_;
  double reach_ = 1.0;                     // of the points, in standard deviations
  double middle_, middle_square_, other_;  // weights in means, in covariances, of all others
  VectorXd point_, next_, expected_, error_, mean_;
  MatrixXd root_, points_, told_, S_, C_, gain_;
};

}  // namespace CDCR_EXPORT cdcr
