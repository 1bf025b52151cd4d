#pragma once

#include <Eigen/LU>

#include "cdcr/quasi_static.hpp"
#include "derivatives/dual.hpp"
#include "loads/friction_memory.hpp"

namespace cdcr::detail {

/// One step of a robot at rest under changed commands, friction remembering the way:
/// cpp/friction.md eqs. (113) to (115). Newton's method on the unbalanced force, which bends where
/// a cable begins to slide. Refers to its arguments, which must outlive it; a step allocates
/// nothing.
class SlowStep {
 public:
  SlowStep(const Model& model, const Wrenches& wrenches);

  /// Begins at rest in q with these deflections.
  void reset(const VectorXd& q, const VectorXd& deflection);
  /// Goes to the rest under commands (num_cables); false where it finds none, and nothing moves.
  /// Searches from `near`, or from where it rests.
  bool step(const VectorXd& command, const VectorXd* near = nullptr) noexcept;

  [[nodiscard]] const VectorXd& q() const noexcept { return q_; }
  [[nodiscard]] const VectorXd& deflection() const noexcept { return deflection_; }
  [[nodiscard]] const VectorXd& tension() const noexcept { return tension_; }
  [[nodiscard]] const VectorXd& friction() const noexcept { return friction_; }
  [[nodiscard]] const VectorXd& end_tension() const noexcept { return end_tension_; }
  [[nodiscard]] const std::vector<Sliding>& sliding() const noexcept { return sliding_; }
  [[nodiscard]] long iterations() const noexcept { return iterations_; }

 private:
  /// The force out of balance at q, and whether its derivative is wanted too: with cables that
  /// stick held, or going on as before.
  enum class Wanted { force, held, as_before };
  void balance(const VectorXd& q, Wanted wanted) noexcept;
  void add_cable(CableGeometry<double>& at, Index j, const VectorXd& q, Wanted wanted) noexcept;
  void add_stiffness(const CableGeometry<double>& at, Index j, const VectorXd& q,
                     const FrictionProfile<double>& profile, bool taut, Sliding way) noexcept;
  void add_stuck_stiffness(const CableGeometry<double>& at, Index j, const VectorXd& q,
                           bool by_tension) noexcept;
  [[nodiscard]] bool goes_on() const noexcept;
  void search_along_step() noexcept;
  void set_curvature(const VectorXd& q) noexcept;
  [[nodiscard]] double tolerance() const noexcept;

  const Model& model_;
  const Wrenches& wrenches_;
  Data data_;
  double stick_;  // stiffness of a cable that sticks [N/m]
  VectorXd command_, q_, deflection_, trial_, moved_, moved_from_, r_, step_, size_, strain_;
  VectorXd change_, command_at_rest_, command_change_;  // of the last step
  VectorXd tension_, friction_, end_tension_, new_deflection_;
  std::vector<Sliding> sliding_, before_;  // before: at the last rest
  MatrixXd H_, K_, slopes_;
  std::vector<CapstanFactors<Dual>> turned_;
  Eigen::PartialPivLU<MatrixXd> lu_;
  double bent_ = 0.0;      // largest coordinate
  double sticking_ = 0.0;  // size of what cables that stick may miss by rounding [N m]
  long iterations_ = 0;
};

}  // namespace cdcr::detail
