#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cdcr/model.hpp"

namespace cdcr::fmu {

/// The variables of an FMU by kind; value references count through the kinds in this order, as
/// python/cdcr/export/variables.py does. Those before `acceleration` are kept, the rest computed.
enum class Kind {
  time,          ///< [s]
  gravity,       ///< in the base frame [m/s^2]
  q_start,       ///< at the start of time [rad]
  qd_start,      ///< [rad/s]
  command,       ///< of each cable, tension [N] or length [m]
  q,             ///< [rad]
  qd,            ///< [rad/s]
  acceleration,  ///< qdd [rad/s^2]
  tip_position,  ///< in the base frame [m]
  tip_rotation,  ///< to the base frame, by rows
  cable_length,  ///< inside the robot [m]
  cable_tension  ///< at the base [N]
};

/// Which variable: the i-th of its kind.
struct Variable {
  Kind kind;
  Index i;
};

/// Where each kind begins.
class Variables {
 public:
  explicit Variables(const Model& model);

  [[nodiscard]] Index first(Kind kind) const noexcept { return first_[static_cast<int>(kind)]; }
  [[nodiscard]] Index count(Kind kind) const noexcept {
    return first_[static_cast<int>(kind) + 1] - first(kind);
  }
  /// How many are kept.
  [[nodiscard]] Index kept() const noexcept { return first(Kind::acceleration); }
  /// Throws std::invalid_argument where a value reference is of none.
  [[nodiscard]] Variable find(std::uint32_t reference) const;
  /// As the model description has it, such as "q[1]".
  [[nodiscard]] std::string name(Variable variable) const;

 private:
  std::vector<Index> first_;
  std::vector<bool> length_driven_;
};

}  // namespace cdcr::fmu
