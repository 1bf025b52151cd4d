#pragma once

#include <memory>

#include "integration/dop853.hpp"

namespace cdcr::detail {

/// dop853, until stability alone holds its steps back; from there on bdf, in each stretch that is
/// long enough for it to pay.
class Automatic final : public Integrator {
 public:
  /// `factory` makes bdf when it is first wanted. Without one (nullptr) this stays explicit, and
  /// stats() tells since when that is dear.
  Automatic(RobotOde& ode, const Options& options, IntegratorFactory factory);

  Status restart(double t, const VectorXd& y, double t_stop) override;
  Status step() override;
  void interpolate(double t, VectorXd& y) override { active_->interpolate(t, y); }
  [[nodiscard]] double time() const noexcept override { return active_->time(); }
  [[nodiscard]] const VectorXd& state() const noexcept override { return active_->state(); }
  [[nodiscard]] Stats stats() const noexcept override;

 private:
  void watch() noexcept;
  [[nodiscard]] bool implicit_pays(double span) const noexcept;
  void take_implicit();

  RobotOde& ode_;
  Options options_;
  IntegratorFactory factory_;
  Dop853 explicit_;
  std::unique_ptr<Integrator> implicit_;
  Integrator* active_;
  double stop_ = 0.0;
  int held_ = 0;            // explicit steps that stability held back, less twice others
  double held_step_ = 0.0;  // of dop853 that stability held back, a running mean [s]
  Stats own_;               // what this class counts itself
};

}  // namespace cdcr::detail
