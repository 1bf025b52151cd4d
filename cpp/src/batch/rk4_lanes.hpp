#pragma once

#include <memory>

#include "batch/motion_lanes.hpp"

namespace cdcr::detail {

/// Some motions of one model at once, by the classical Runge-Kutta method under forces that hold
/// over a step; each as Rk4 makes it, to rounding. A motion that leaves the shapes the model is
/// valid for is no number from there on, and the others go on. The model must outlive it.
class Rk4Lanes {
 public:
  virtual ~Rk4Lanes() = default;

  /// How many.
  [[nodiscard]] virtual Index size() const noexcept = 0;
  /// State y = (q, qd) of a motion.
  virtual void set_state(Index motion, const VectorXd& y) noexcept = 0;
  virtual void get_state(Index motion, VectorXd& y) const noexcept = 0;
  /// Its generalised force (d).
  virtual void set_force(Index motion, const VectorXd& force) noexcept = 0;
  /// A step of size h of all. Real-time safe.
  virtual void step(double h) noexcept = 0;
};

/// For so many motions, or as many of them as go well together, in the lanes of this processor or
/// fewer. For models with fits_lanes() alone.
[[nodiscard]] std::unique_ptr<Rk4Lanes> make_rk4_lanes(const Model& model, Index motions,
                                                       int lanes = num_lanes);

}  // namespace cdcr::detail
