#pragma once

#include "integration/embedded_pair.hpp"

namespace cdcr::detail {

/// Dormand-Prince 8(5,3), with dense output of order 7, for which three more slopes are taken.
class Dop853 final : public EmbeddedPair {
 public:
  Dop853(RobotOde& ode, const Options& options);

  /// Whether stability, rather than what moves, bounds the step just made.
  [[nodiscard]] bool is_held_by_stability() const noexcept;

 private:
  void make_stages(double h) override;
  [[nodiscard]] double error_norm(double h) override;
  void prepare_interpolation(double h) override;
  void interpolate_in_step(double share, VectorXd& y) const override;

  /// For so many states, known when compiled; Eigen::Dynamic for any.
  template <int N>
  void make_stages_of(double h);
  template <int N>
  [[nodiscard]] double error_norm_of(double h) const;
  template <int N>
  void prepare_interpolation_of(double h);

  double of_decay_;         // step times eigenvalue from which a mode that decays may hold it back
  MatrixXd slopes_;         // 0 and 12 those of the ends, from 13 on for dense output
  MatrixXd dense_;          // coefficients in its columns
  VectorXd last_argument_;  // where slope 11 was taken, at the end of the step
};

}  // namespace cdcr::detail
