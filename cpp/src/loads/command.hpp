#pragma once

#include "base/arguments.hpp"
#include "cdcr/robot_ode.hpp"

namespace cdcr::detail {

/// Throws std::invalid_argument for a command of wrong size, negative or not finite.
inline void require_command(const Model& model, const VectorXd& command) {
  require(check_tension(model, command) == Status::ok, "tension must be ", model.num_cables(),
          " finite values >= 0 N (a cable cannot push), got [", command.transpose(), "]");
}

}  // namespace cdcr::detail
