#pragma once

#include "cdcr/export.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// What a controller follows at one time, of the size of its reference.
struct Setpoint {
  explicit Setpoint(Index size = 0)
      : value(VectorXd::Zero(size)), rate(value), acceleration(value) {}
  VectorXd value, rate, acceleration;
};

/// A vector over time with its first two derivatives: coordinates (d) [rad] or the position of the
/// tip (3) [m] that a controller follows. It stands still before its start and after its end.
///
/// Set up throws std::invalid_argument.
class ReferencePath {
 public:
  /// The same at all times; who follows it looks at the values.
  [[nodiscard]] static ReferencePath constant(const VectorXd& value);
  /// The smoothest way through points (N, size) at given times (N) [s], from rest to rest: of all
  /// it has the least integral of the squared jerk. Quintics whose first four derivatives are
  /// continuous; for two points the minimum-jerk motion, cpp/control.md eq. (101).
  [[nodiscard]] static ReferencePath spline(const VectorXd& times, const MatrixXd& points);
  /// Quintics through values, rates and accelerations (N, size) at given times.
  [[nodiscard]] static ReferencePath hermite(const VectorXd& times, const MatrixXd& values,
                                             const MatrixXd& rates, const MatrixXd& accelerations);
  /// Along straight lines from corner to corner (N, size), at rest in each, in times in proportion
  /// to their lengths; a square has five.
  [[nodiscard]] static ReferencePath polygon(const MatrixXd& corners, double duration);
  /// center + cos(a) x + sin(a) y + a/(2 pi) climb, where the angle a grows to 2 pi turns over the
  /// duration: evenly, or from rest to rest by minimum jerk.
  [[nodiscard]] static ReferencePath helix(const VectorXd& center, const VectorXd& x,
                                           const VectorXd& y, const VectorXd& climb, double turns,
                                           double duration, bool rest_to_rest = true);
  /// A helix that does not climb.
  [[nodiscard]] static ReferencePath circle(const VectorXd& center, const VectorXd& x,
                                            const VectorXd& y, double turns, double duration,
                                            bool rest_to_rest = true);

  /// The same motion that begins later by `delay` [s].
  [[nodiscard]] ReferencePath delayed(double delay) const;

  [[nodiscard]] Index size() const noexcept { return size_; }
  [[nodiscard]] double start() const noexcept { return times_[0]; }                ///< [s]
  [[nodiscard]] double end() const noexcept { return times_[times_.size() - 1]; }  ///< [s]
  [[nodiscard]] bool is_constant() const noexcept { return times_.size() == 1; }

  /// What it is made of, and one made of it again, as from a file.
  [[nodiscard]] const VectorXd& times() const noexcept { return times_; }
  [[nodiscard]] const MatrixXd& coefficients() const noexcept { return coefficients_; }
  [[nodiscard]] const MatrixXd& turn() const noexcept { return helix_; }
  [[nodiscard]] static ReferencePath of_parts(const VectorXd& times, const MatrixXd& coefficients,
                                              const MatrixXd& turn, Index size);

  /// Real-time safe where the setpoint has its size.
  void evaluate(double t, Setpoint& setpoint) const noexcept;

 private:
  ReferencePath(const VectorXd& times, Index size);

  Index size_;
  VectorXd times_;         // of the pieces' ends [s]
  MatrixXd coefficients_;  // (pieces size, 6): of powers of the time since a piece began
  MatrixXd helix_;         // (size, 4): center, x, y, climb; empty for polynomials
};

}  // namespace CDCR_EXPORT cdcr
