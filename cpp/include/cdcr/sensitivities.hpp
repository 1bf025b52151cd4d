#pragma once

#include <optional>

#include "cdcr/export.hpp"
#include "cdcr/parameters.hpp"
#include "cdcr/signal.hpp"
#include "cdcr/simulate.hpp"

namespace CDCR_EXPORT cdcr {

/// By what a run is differentiated. Columns stand in this order: coordinates at the start, rates at
/// the start, an amount added to all commands of a cable, parameters.
struct Sensitivities {
  bool q0 = false, qd0 = false;            ///< d columns each
  bool command = false;                    ///< num_cables columns
  std::optional<ParameterSet> parameters;  ///< of the model that runs
  /// d(q0, qd0)/dp (2d, columns) where the start depends on them too; empty: the identity for q0
  /// and qd0, zero for the others.
  MatrixXd start;
  /// d(command)/dp over time where commands depend on parameters, one cable after another of the
  /// first parameter, then of the next; with break points of the commands alone.
  std::optional<Signal> command_slopes;

  [[nodiscard]] Index columns(const Model& model) const noexcept;
};

/// simulate() with the derivatives of its states: row i of Trajectory::sensitivities holds
/// d(q, qd)/dp (2d, k) at t[i], row by row.
///
/// The steps and states are those of the run without. In each step the variational equation,
/// cpp/sensitivities.md eq. (120), is solved along them by a method of its own: Radau IIA of order
/// 5, or 9 where the run's method is of higher order. Throws also for a command that is a function,
/// which may be feedback.
[[nodiscard]] Trajectory simulate(const Model& model, const VectorXd& q0, const VectorXd& qd0,
                                  const VectorXd& times, const CommandInput& input,
                                  const Sensitivities& sensitivities,
                                  Method method = Method::automatic, const Options& options = {},
                                  IntegratorFactory factory = make_integrator,
                                  const Progress& progress = {}, const WrenchInput& loads = {},
                                  const Events& events = {});

}  // namespace CDCR_EXPORT cdcr
