#pragma once

#include <memory>

#include "cdcr/dynamics.hpp"
#include "cdcr/export.hpp"
#include "cdcr/method.hpp"
#include "cdcr/status.hpp"

namespace CDCR_EXPORT cdcr {

/// The robot inside a control loop: one period at a time, tensions held over the period.
///
/// Set up: the constructor and reset may allocate and throw std::invalid_argument. Run: step and
/// the accessors are noexcept and allocate nothing; on failure the last good state stays.
class Simulator {
 public:
  /// `step` is the control period [s], made of `substeps` equal steps by rk4 or by rosenbrock,
  /// which needs few of them where damping is strong or sections are cut into many parts.
  explicit Simulator(const Model& model, double step = 1e-3, int substeps = 1,
                     Method method = Method::rk4);
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  /// Sets the state (d each) and the time [s], where the clock was set and the periods made since.
  void reset(const VectorXd& q, const VectorXd& qd, double start = 0.0, long long periods = 0);

  /// Sets the deflections of cables whose friction remembers (num_deflections) [m], and what cables
  /// feel of their commands where drives have play (num_cables) [N], [m]; reset makes them those of
  /// a robot that has not moved.
  void set_memory(const VectorXd& deflection, const VectorXd& felt);

  /// Advances one period under constant commands (num_cables), tensions [N] or lengths [m], each
  /// >= 0, and constant wrenches; invalid_tension and invalid_wrench tell what it does not take.
  /// Real-time safe.
  [[nodiscard]] Status step(const ConstVectorRef& tension) noexcept;
  [[nodiscard]] Status step(const ConstVectorRef& tension, const Wrenches& wrenches) noexcept;
  /// The same with many substeps, that can be interrupted among them; `stop` must not throw.
  [[nodiscard]] Status step(const ConstVectorRef& tension, const Wrenches& wrenches,
                            const Interrupt& stop) noexcept;

  [[nodiscard]] const Model& model() const noexcept { return model_; }  ///< a copy of the one given
  [[nodiscard]] const VectorXd& q() const noexcept { return q_; }       ///< (d) [rad]
  [[nodiscard]] const VectorXd& qd() const noexcept { return qd_; }     ///< (d) [rad/s]
  [[nodiscard]] const VectorXd& deflection() const noexcept { return deflection_; }  ///< [m]
  [[nodiscard]] const VectorXd& felt() const noexcept { return felt_; }              ///< [N] or [m]
  [[nodiscard]] double time() const noexcept { return time_; }                       ///< [s]
  [[nodiscard]] double period() const noexcept { return period_; }                   ///< [s]
  [[nodiscard]] int substeps() const noexcept { return substeps_; }  ///< in a period
  [[nodiscard]] Method method() const noexcept { return method_; }
  [[nodiscard]] bool started() const noexcept { return started_; }       ///< reset has been called
  [[nodiscard]] double start() const noexcept { return start_; }         ///< as reset was told [s]
  [[nodiscard]] long long periods() const noexcept { return periods_; }  ///< since start

 private:
  void set_clock(long long periods) noexcept;

  Model model_;
  Data data_;
  double period_ = 0.0, time_ = 0.0, start_ = 0.0;
  long long periods_ = 0;
  int substeps_ = 1;
  Method method_;
  bool started_ = false;
  VectorXd q_, qd_, force_, deflection_, felt_, felt_trial_;
  VectorXd y_, trial_;  // (q, qd, deflection) within a period
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

}  // namespace CDCR_EXPORT cdcr
