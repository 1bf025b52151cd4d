#include "cdcr/actuator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/arguments.hpp"
#include "control/steps.hpp"

namespace cdcr {
namespace {

// Semi-implicit steps of a critically damped loop are stable to twice this and true to a tenth.
constexpr double largest_turn = 0.5;
// [N], or [m] of lengths.
constexpr double finest = 1e-100;

void check(const Actuator& a, const Cable& cable, std::size_t j, double step) {
  const auto item = [&](const char* name) {
    return detail::sentence(name, " of actuator ", j + 1);
  };
  detail::require_not_negative(item("resolution").c_str(), a.resolution, "N (m of lengths)");
  detail::require_not_negative(item("time_constant").c_str(), a.time_constant, "s");
  detail::require(a.max_rate > 0.0, item("max_rate"), " must be > 0 N/s (m/s of lengths), got ",
                  a.max_rate);
  detail::require(a.min_command >= 0.0 && a.max_command >= a.min_command, "limits of actuator ",
                  j + 1, " must satisfy 0 <= min_command <= max_command, got ", a.min_command,
                  " and ", a.max_command);
  detail::require(std::isfinite(a.min_command), item("min_command"), " must be finite, got ",
                  a.min_command);
  // Below, a command counted in them is no number.
  detail::require(a.resolution == 0.0 || a.resolution >= finest, item("resolution"),
                  " must be 0 (none) or at least ", finest, " N (m of lengths), got ",
                  a.resolution);
  if (!a.winch) return;
  const Winch& w = *a.winch;
  detail::require(cable.length_driven(), "a winch drives cables by length, but cable ", j + 1,
                  " of the robot is driven by tension (its stiffness is 0)");
  detail::require_positive(item("drum_radius").c_str(), w.drum_radius, "m");
  detail::require_positive(item("gear").c_str(), w.gear, "1");
  detail::require_positive(item("inertia").c_str(), w.inertia, "kg m^2");
  detail::require_positive(item("bandwidth").c_str(), w.bandwidth, "rad/s");
  detail::require(w.max_torque > 0.0 && w.max_speed > 0.0, "max_torque and max_speed of actuator ",
                  j + 1, " must be > 0, got ", w.max_torque, " N m and ", w.max_speed, " rad/s");
  detail::require(w.bandwidth * step <= largest_turn, item("bandwidth"),
                  " must be at most 0.5/step, ", largest_turn / step, " rad/s, got ", w.bandwidth);
}

}  // namespace

double Winch::mass() const noexcept {
  return inertia * (gear / drum_radius) * (gear / drum_radius);
}

Actuators::Actuators(const Model& model, std::vector<Actuator> actuators, double step)
    : actuators_(std::move(actuators)), step_(step) {
  const auto c = static_cast<std::size_t>(model.num_cables());
  if (actuators_.size() == 1 && c > 1) actuators_.resize(c, actuators_[0]);
  detail::require(actuators_.empty() || actuators_.size() == c,
                  "there must be one actuator, or one for each of the ", c, " cables, got ",
                  actuators_.size());
  Index longest = 0;
  for (std::size_t j = 0; j < actuators_.size(); ++j) {
    check(actuators_[j], model.cables()[j], j, step);
    const std::string item = detail::sentence("dead_time of actuator ", j + 1);
    delay_.push_back(detail::whole_steps(item.c_str(), actuators_[j].dead_time, step, 0));
    longest = std::max(longest, delay_.back());
  }
  value_ = speed_ = given_ = VectorXd::Zero(model.num_cables());
  late_ = MatrixXd::Zero(model.num_cables(), longest + 1);
}

void Actuators::reset(const ConstVectorRef& command) noexcept {
  value_ = given_ = command;
  speed_.setZero();
  late_.colwise() = value_;
  now_ = 0;
}

/// Takes a command in and gives the one that has been on its way for the dead time.
double Actuators::delayed(Index cable, double command) noexcept {
  late_(cable, now_) = command;
  return late_(cable,
               (now_ + late_.cols() - delay_[static_cast<std::size_t>(cable)]) % late_.cols());
}

/// Mass times acceleration of the length let out is tension less motor force, eq. (93).
void Actuators::move_winch(Index cable, const Winch& winch, double command,
                           double tension) noexcept {
  double& length = value_[cable];
  double& speed = speed_[cable];
  const double mass = winch.mass(), w = winch.bandwidth;
  const double strongest = winch.max_torque * winch.gear / winch.drum_radius;
  const double fastest = winch.max_speed * winch.drum_radius / winch.gear;
  const double wanted = mass * (w * w * (length - command) + 2.0 * w * speed);
  const double force = std::clamp(wanted, -strongest, strongest);
  speed = std::clamp(speed + step_ * (tension - force) / mass, -fastest, fastest);
  length = std::fmax(0.0, length + step_ * speed);
}

void Actuators::step(const ConstVectorRef& asked, const ConstVectorRef& tension) noexcept {
  if (actuators_.empty()) {
    given_ = asked;
    return;
  }
  for (Index j = 0; j < value_.size(); ++j) {
    const Actuator& a = actuators_[static_cast<std::size_t>(j)];
    double command = asked[j];
    if (a.resolution > 0.0) command = a.resolution * std::round(command / a.resolution);
    command = delayed(j, std::clamp(command, a.min_command, a.max_command));
    const double before = value_[j];
    if (a.winch) {
      move_winch(j, *a.winch, command, tension[j]);
    } else {
      // Exact for a command that holds.
      const double share = a.time_constant > 0.0 ? -std::expm1(-step_ / a.time_constant) : 1.0;
      const double most = a.max_rate * step_;
      value_[j] += std::clamp(share * (command - value_[j]), -most, most);
    }
    const bool moves = a.winch || a.time_constant > 0.0 || std::isfinite(a.max_rate);
    given_[j] = moves ? (before + value_[j]) / 2.0 : command;
    if (!moves) value_[j] = command;
  }
  now_ = (now_ + 1) % late_.cols();
}

}  // namespace cdcr
