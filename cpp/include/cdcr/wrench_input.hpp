#pragma once

#include <functional>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/signal.hpp"
#include "cdcr/wrench.hpp"

namespace CDCR_EXPORT cdcr {

/// How the size of a wrench changes in time: a factor, 1 where nothing else is said.
///
/// A table (`times`, strictly increasing, and one factor each) is held until its next time or,
/// when `linear`, connected, a time given twice for a jump; before the first and after the last
/// time these hold. A function of time takes the place of a table; then `times` are the points at
/// which it is not smooth.
struct Profile {
  std::vector<double> times;    ///< [s]
  std::vector<double> factors;  ///< [-]
  bool linear = false;
  std::function<double(double t)> function;
};

/// Wrenches on the robot as a function of time. Set up throws std::invalid_argument; evaluate is
/// real-time safe but for a function that is not.
class WrenchInput {
 public:
  WrenchInput() = default;
  /// Constant wrenches.
  explicit WrenchInput(Wrenches wrenches);

  /// Adds a wrench that follows a profile.
  void add(const Wrench& wrench, Profile profile = {});

  [[nodiscard]] const Wrenches& wrenches() const noexcept { return wrenches_; }
  [[nodiscard]] bool empty() const noexcept { return wrenches_.empty(); }
  /// Whether all wrenches are constant over a stretch without break points.
  [[nodiscard]] bool hold() const noexcept { return hold_; }
  /// Whether a profile is a function of which no break points are known.
  [[nodiscard]] bool has_unbroken_function() const noexcept;
  /// The same wrenches, time counted from `start` [s].
  [[nodiscard]] WrenchInput since(double start) const;
  /// Times at which a profile is not smooth, increasing [s].
  [[nodiscard]] const std::vector<double>& break_points() const noexcept { return break_points_; }

  /// Writes the wrenches at t, as seen from within the stretch that begins at `start`, so that at
  /// a break point both sides exist. `now` has as many wrenches as this. May throw what a function
  /// throws, or std::invalid_argument when it gives no finite factor.
  void evaluate(double t, double start, Wrenches& now) const;

 private:
  Wrenches wrenches_;
  std::vector<Signal> factors_;
  std::vector<double> break_points_;
  bool hold_ = true;
};

[[nodiscard]] const WrenchInput& no_loads() noexcept;

using Loads = WrenchInput;  ///< its earlier name

}  // namespace CDCR_EXPORT cdcr
