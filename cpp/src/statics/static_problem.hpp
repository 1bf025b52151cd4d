#pragma once

#include <memory>

#include "cdcr/model.hpp"
#include "cdcr/wrench.hpp"
#include "statics/potential.hpp"

namespace cdcr::detail {

/// dr/dq, static_stiffness of cdcr/statics.hpp.
void static_stiffness(const Model& model, KeptChain* kept, const ConstVectorRef& q,
                      const ConstVectorRef& command, const Wrenches& wrenches,
                      MatrixRef K) noexcept;

/// What is out of balance in a robot at rest, cpp/several-sections.md eqs. (40) to (43):
/// r(q) = dU/dq - Q, where Q is that of the cables, without friction, and of wrenches. A load
/// factor below one scales all but the bending stiffness.
///
/// Refers to its arguments, which must outlive it. The functions allocate nothing.
class StaticProblem {
 public:
  StaticProblem(const Model& model, const ConstVectorRef& command, const Wrenches& wrenches);

  /// r(q) (d) [N m].
  void residual(const ConstVectorRef& q, VectorRef r) noexcept;
  /// dr/dq (d, d) [N m/rad].
  void stiffness(const ConstVectorRef& q, MatrixRef K) noexcept;
  /// Energy whose gradient r is, where it has one [J].
  [[nodiscard]] double energy(const ConstVectorRef& q) noexcept;
  /// Rounding error that r cannot get below [N m].
  [[nodiscard]] double rounding_bound(const ConstVectorRef& q) const noexcept;

  [[nodiscard]] bool has_energy() const noexcept { return has_energy_; }
  [[nodiscard]] const Model& model() const noexcept { return model_; }
  [[nodiscard]] double load_factor() const noexcept { return load_factor_; }
  void set_load_factor(double load) noexcept { load_factor_ = load; }

 private:
  const Model& model_;
  ConstVectorRef command_;
  const Wrenches& wrenches_;
  std::unique_ptr<KeptChain> kept_;  // none where the closed form applies
  double load_factor_ = 1.0;
  VectorXd constant_force_;  // of the cables driven by tension
  VectorXd elastic_, force_;
  bool has_energy_;
  bool has_paths_;  // cables whose pull changes with the shape
  bool has_springs_ = false;
  double size_ = 0.0;           // of the moments in balance
  double straight_work_ = 0.0;  // tensions of cables through rods times their lengths when straight
};

}  // namespace cdcr::detail
