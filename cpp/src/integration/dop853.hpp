#pragma once

#include <array>

#include "integration/embedded_pair.hpp"

namespace cdcr::detail {

/// Dormand-Prince 8(5,3), with dense output of order 7, for which three more slopes are taken.
class Dop853 final : public EmbeddedPair {
 public:
  Dop853(RobotOde& ode, const Options& options);

 private:
  void make_stages(double h) override;
  [[nodiscard]] double error_norm(double h) override;
  void prepare_interpolation(double h) override;
  void interpolate_in_step(double share, VectorXd& y) const override;

  std::array<VectorXd, 16> slopes_;  // 0 and 12 those of the ends, from 13 on for dense output
  std::array<VectorXd, 7> dense_;
  VectorXd error_5_, error_3_;
};

}  // namespace cdcr::detail
