#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/model.hpp"
#include "cdcr/robot.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// Something measured, each period: value + bias + noise, and told after a delay.
struct Sensor {
  /// coordinates (d) [rad]; rates (d) [rad/s]; lengths of the cables in the robot (num_cables) [m];
  /// tensions at the base (num_cables) [N]; tip: position in the base frame (3) [m]; orientation of
  /// the tip in the base frame, a rotation vector (3) [rad]; curvature of the backbone in the x and
  /// y of its frame at places (2 each) [1/m]; force (3) [N] and moment (3) [N m] of the robot on
  /// its base, as base_wrench() has them.
  enum class Kind {
    coordinates,
    rates,
    lengths,
    tensions,
    tip,
    curvature,
    orientation,
    base_force,
    base_moment
  };

  /// Whether it feels the wrench on the base.
  [[nodiscard]] bool feels_base() const noexcept {
    return kind == Kind::base_force || kind == Kind::base_moment;
  }

  Kind kind = Kind::coordinates;
  double period = 0.0;        ///< [s], a whole number of steps; 0: each step
  double delay = 0.0;         ///< [s], >= 0, a whole number of steps
  double noise = 0.0;         ///< standard deviation of each value, normal and white, >= 0
  double bias = 0.0;          ///< added to each value; of orientation both turn it about its axes
  std::vector<Place> places;  ///< of curvature
  std::uint64_t seed = 1;     ///< of the noise
};

/// A sensor of a robot in steps of time. Set up: the constructor allocates and throws
/// std::invalid_argument. Run: everything else is real-time safe.
class SensorChannel {
 public:
  /// `name` is what refusals call it.
  SensorChannel(const Model& model, const Sensor& sensor, double step,
                const std::string& name = "a sensor");

  /// What it tells at the start: the state (q, qd) there, without noise. One that feels the base
  /// needs the wrench on it (6).
  void reset(const ConstVectorRef& q, const ConstVectorRef& qd, const ConstVectorRef& command,
             const ConstVectorRef& on_base = VectorXd()) noexcept;
  /// At the beginning of a step, counted from reset: measures where its period is over; whether
  /// what it tells is new.
  bool step(long long steps, const ConstVectorRef& q, const ConstVectorRef& qd,
            const ConstVectorRef& command, const ConstVectorRef& on_base = VectorXd()) noexcept;
  /// What it tells.
  [[nodiscard]] const VectorXd& value() const noexcept { return value_; }
  [[nodiscard]] const Sensor& sensor() const noexcept { return sensor_; }

 private:
  [[nodiscard]] double normal() noexcept;
  [[nodiscard]] std::uint64_t random() noexcept;

  Model model_;
  Sensor sensor_;
  Index every_, delay_;
  VectorXd value_, measured_, error_;
  MatrixXd late_;           // (size, delay + 1) on their way
  std::vector<char> sent_;  // whether a column of it was measured
  std::uint64_t random_state_ = 1;
};

}  // namespace CDCR_EXPORT cdcr
