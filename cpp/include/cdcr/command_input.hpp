#pragma once

#include "cdcr/export.hpp"
#include "cdcr/signal.hpp"

namespace CDCR_EXPORT cdcr {

/// Commands of the cables over time: tensions [N], lengths [m] where driven by length; see Signal.
/// All set up throws std::invalid_argument.
class CommandInput : public Signal {
 public:
  /// The same commands at all times (num_cables), finite and >= 0.
  [[nodiscard]] static CommandInput constant(const VectorXd& tension);

  /// Commands at given times: `tensions` (N, num_cables), finite and >= 0.
  [[nodiscard]] static CommandInput table(const VectorXd& times, const MatrixXd& tensions,
                                          Interpolation interpolation);

  /// Any function. What it gives is checked at each call.
  [[nodiscard]] static CommandInput function(Function function, Index num_cables,
                                             std::vector<double> break_points = {});

  /// The same commands, time counted from `start` [s].
  [[nodiscard]] CommandInput commands_since(double start) const {
    return CommandInput(Signal::since(start));
  }

  [[nodiscard]] Index num_cables() const noexcept { return size(); }

 private:
  explicit CommandInput(Signal signal) : Signal(std::move(signal)) {}
};

using TensionInput = CommandInput;  ///< its earlier name

}  // namespace CDCR_EXPORT cdcr
