#pragma once

#include <limits>

#include "cdcr/allocation.hpp"
#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// Turns generalised forces into commands of the cables, period by period: tensions [N], or lengths
/// [m] of cables driven by length, so that they pull alike, F = k (l - l_commanded) + d dl/dt.
///
/// All limits go through the Allocator: a command that may change by max_rate times the period is a
/// pair of limits of its tension. Friction in the holes is not reckoned with. Set up: the
/// constructor allocates and throws std::invalid_argument. Run: everything else is real-time safe.
class CableDrive {
 public:
  /// max_rate: of every command [N/s], [m/s]; > 0, none where it is infinite.
  CableDrive(const Model& model, const TensionLimits& limits, double max_rate, double period);

  /// Forgets the last command: the next may be any.
  void reset() noexcept { started_ = false; }
  /// Takes these for the last commands (num_cables).
  void hold(const ConstVectorRef& command) noexcept {
    command_ = command;
    started_ = true;
  }

  /// Commands that give the force (d) at (q, qd), least-norm tensions or those nearest to
  /// `preferred` [N]; true when it is met, else they come nearest to it.
  bool solve(const ConstVectorRef& q, const ConstVectorRef& qd,
             const ConstVectorRef& force) noexcept;
  bool solve(const ConstVectorRef& q, const ConstVectorRef& qd, const ConstVectorRef& force,
             const ConstVectorRef& preferred) noexcept;
  /// Tensions (num_cables) that commands would give at (q, qd); negative where a spring would push.
  void tensions_of(const ConstVectorRef& q, const ConstVectorRef& qd, const ConstVectorRef& command,
                   VectorRef tension) noexcept;

  /// Brings a force to the nearest that the cables can give at q without limits, B B^+ Q. Where
  /// they can give any, it stays as it is.
  void project(const ConstVectorRef& q, VectorRef force) noexcept;
  /// The same, nearest in the accelerations it makes: (B F - Q)^T M^-1 (B F - Q) least, eq. (88).
  void project(const ConstVectorRef& q, const MatrixXd& M, VectorRef force) noexcept;
  /// Whether the cables can give any force.
  [[nodiscard]] bool is_fully_actuated() const noexcept { return fully_actuated_; }

  [[nodiscard]] const VectorXd& command() const noexcept { return command_; }  ///< [N], [m]
  /// Whether it is the command of a period before, from which the next one is not far.
  [[nodiscard]] bool has_command() const noexcept { return started_; }
  [[nodiscard]] const VectorXd& tension() const noexcept { return tension_; }  ///< [N]
  [[nodiscard]] const VectorXd& force() const noexcept { return force_; }      ///< given (d) [N m]
  /// Cables at one of their limits.
  [[nodiscard]] Index num_limited() const noexcept;
  [[nodiscard]] const Model& model() const noexcept { return model_; }
  [[nodiscard]] double period() const noexcept { return period_; }

 private:
  void set_limits(const ConstVectorRef& preferred) noexcept;
  void set_lengths(const ConstVectorRef& q, const ConstVectorRef& qd) noexcept;
  [[nodiscard]] double command_of(Index cable, double tension) const noexcept;
  [[nodiscard]] double tension_of(Index cable, double command) const noexcept;

  Model model_;
  Allocator allocator_;
  double max_step_, period_;
  bool started_ = false, fully_actuated_ = false, has_lengths_ = false;
  VectorXd least_, most_, lower_, upper_;  // limits for good, and of this period [N]
  VectorXd none_, command_, tension_, force_;
  VectorXd lengths_, rates_;  // of the cables [m], [m/s]
  MatrixXd B_, moved_, normal_;
  VectorXd wanted_, row_;
  Eigen::LDLT<MatrixXd> ldlt_;
  Eigen::LLT<MatrixXd> llt_;
};

}  // namespace CDCR_EXPORT cdcr
