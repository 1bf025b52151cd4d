#pragma once

#include <cstdlib>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// A motor with a gear and a drum, whose position loop lets out the length asked for. Its stiffness
/// is mass() bandwidth^2 with the motor's inertia seen by the cable, so it gives way under load.
struct Winch {
  double drum_radius = 0.0;  ///< [m], > 0
  double gear = 1.0;         ///< turns of the motor for one of the drum, > 0
  double inertia = 0.0;      ///< of the motor [kg m^2], > 0
  double bandwidth = 0.0;    ///< of its critically damped loop [rad/s], > 0
  double max_torque = std::numeric_limits<double>::infinity();  ///< of the motor [N m], > 0
  double max_speed = std::numeric_limits<double>::infinity();   ///< of the motor [rad/s], > 0

  /// Inertia of the motor as the cable feels it, J (gear/radius)^2 [kg].
  [[nodiscard]] double mass() const noexcept;
};

/// What stands between a command and the cable: each part is absent unless it is given.
struct Actuator {
  double resolution = 0.0;     ///< of commands, rounded to multiples of it [N], [m]
  double dead_time = 0.0;      ///< [s], >= 0, a whole number of steps
  double time_constant = 0.0;  ///< of a first-order lag [s], >= 0
  double max_rate = std::numeric_limits<double>::infinity();     ///< [N/s], [m/s], > 0
  double min_command = 0.0;                                      ///< [N], [m], >= 0
  double max_command = std::numeric_limits<double>::infinity();  ///< [N], [m], >= min_command
  std::optional<Winch> winch;  ///< in place of lag and rate, of a cable driven by length
};

/// The actuators of all cables in steps of time. Set up: the constructor allocates and throws
/// std::invalid_argument. Run: everything else is real-time safe.
class Actuators {
 public:
  /// One for all cables or one for each; none where the list is empty.
  Actuators(const Model& model, std::vector<Actuator> actuators, double step);

  /// Puts all of them at rest where they give these commands (num_cables).
  void reset(const ConstVectorRef& command) noexcept;
  /// Moves on by one step under the commands asked for, with the tensions [N] that load the motors.
  void step(const ConstVectorRef& asked, const ConstVectorRef& tension) noexcept;
  /// What the cables get over the step just made, the mean of its two ends (num_cables) [N], [m].
  [[nodiscard]] const VectorXd& given() const noexcept { return given_; }
  [[nodiscard]] const std::vector<Actuator>& actuators() const noexcept { return actuators_; }
  /// Shows a function each part of what they remember, in one order; `self` is const or not.
  template <class Self, class Visit>
  static void visit_memory(Self& self, Visit& visit) {
    visit(self.value_);
    visit(self.speed_);
    visit(self.given_);
    visit(self.late_);
    visit(self.now_);
    if constexpr (!std::is_const_v<Self>) self.now_ = std::abs(self.now_) % self.late_.cols();
  }

 private:
  [[nodiscard]] double delayed(Index cable, double command) noexcept;
  void move_winch(Index cable, const Winch& winch, double command, double tension) noexcept;

  std::vector<Actuator> actuators_;  // one for each cable, or none
  double step_;
  VectorXd value_, speed_, given_;
  MatrixXd late_;             // (num_cables, longest dead time + 1) commands on their way
  std::vector<Index> delay_;  // in steps
  Index now_ = 0;             // column of late_
};

}  // namespace CDCR_EXPORT cdcr
