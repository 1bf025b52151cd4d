#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/simulate.hpp"

namespace CDCR_EXPORT cdcr {

/// Commands of many motions, num_cables each: those of motion i over step k begin at
/// data + i * between_motions + k * between_steps, and hold over the step.
struct RolloutCommands {
  const double* data = nullptr;  ///< [N], or [m] where driven by length
  Index between_motions = 0;     ///< 0: the same for all motions
  Index between_steps = 0;       ///< 0: constant
};

/// What differs between the motions of a rollout, and what drives them.
struct Motions {
  std::vector<const Model*> models;  ///< one for all, or one for each; all of the same sizes
  RowMatrixXd q0, qd0;               ///< where they start (N, d) [rad], [rad/s]
  RolloutCommands commands;
  std::vector<Controller*> controllers;  ///< one for each in place of commands, or none
  WrenchInput loads;                     ///< the same for all; no functions

  [[nodiscard]] Index size() const noexcept { return q0.rows(); }
  [[nodiscard]] const Model& model(Index motion) const noexcept {
    return *models[models.size() == 1 ? 0 : static_cast<std::size_t>(motion)];
  }
};

struct RolloutOptions {
  double step = 1e-3;     ///< between commands, and of rk4 [s]
  long steps = 1000;      ///< of each motion
  double start = 0.0;     ///< time at which it begins, which wrenches and controllers see [s]
  long record_every = 1;  ///< steps from one row to the next; divides `steps`
  int threads = 0;        ///< 0: as many as the machine has processors
  Method method = Method::rk4;
  Options tolerances;  ///< of the adaptive methods; `step` is not read
  IntegratorFactory factory = make_integrator;

  /// Rows of each motion: the start, and one each `record_every` steps.
  [[nodiscard]] Index rows() const noexcept { return steps / record_every + 1; }
};

/// Where the rows of all motions go, row-major; NaN where a motion did not get.
struct RolloutRows {
  double* q = nullptr;        ///< (N, rows, d) [rad]
  double* qd = nullptr;       ///< (N, rows, d) [rad/s]
  double* command = nullptr;  ///< (N, rows, num_cables), [N] or [m]; not written where null
};

/// A motion that did not reach its end.
struct RolloutFailure {
  Index motion = 0;
  Status status = Status::ok;
  std::string message;  ///< when it stopped, why, and what to try
};

/// How the motions of a rollout ended.
struct RolloutOutcome {
  std::vector<RolloutFailure> failures;  ///< in the order of motions; the others reached their end
  Stats stats;                           ///< what all of them cost
};

/// Throws std::invalid_argument naming the option that is out of range.
void validate(const RolloutOptions& options);

/// Asked now and then, in the thread that called, with the motions that have ended; returning false
/// ends the rollout, with status interrupted of what was not done.
using RolloutProgress = std::function<bool(Index ended)>;

/// Runs many motions, each as `simulate` does, by several threads; the numbers do not depend on how
/// many. A motion that fails leaves the others alone.
///
/// Throws std::invalid_argument for arguments out of range, naming the motion, and what `progress`
/// throws.
[[nodiscard]] RolloutOutcome rollout(const Motions& motions, const RolloutOptions& options,
                                     const RolloutRows& rows, const RolloutProgress& progress = {});

}  // namespace CDCR_EXPORT cdcr
