#pragma once

#include "cdcr/types.hpp"

namespace cdcr::detail {

/// How errors of x = (q, qd, w), w standing still, move over a period, and what noise adds,
/// cpp/estimation.md eqs. (96), (97). Real-time safe after construction.
class Transition {
 public:
  /// density: of white noise on the rate of each of qd and w (size - d).
  Transition(Index num_coordinates, const VectorXd& density, double period, int substeps);

  /// Under slopes of the accelerations (d, size).
  void update(const MatrixXd& slopes) noexcept;
  [[nodiscard]] const MatrixXd& matrix() const noexcept { return whole_; }  ///< (size, size)
  [[nodiscard]] const MatrixXd& noise() const noexcept { return noise_; }   ///< its covariance

 private:
  void expand(const MatrixXd& slopes, double time, MatrixXd& out) noexcept;
  void add_noise(double weight, const MatrixXd& moved) noexcept;

  Index d_;
  double step_;    // of the series [s]
  int doublings_;  // of it in a period
  VectorXd root_;  // of the density
  MatrixXd half_, whole_, noise_, product_, spread_;
};

}  // namespace cdcr::detail
