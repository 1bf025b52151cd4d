#pragma once

#include "integration/embedded_pair.hpp"

namespace cdcr::detail {

/// Dormand-Prince 5(4), with dense output of order 4.
class Dopri5 final : public EmbeddedPair {
 public:
  Dopri5(RobotOde& ode, const Options& options);

 private:
  void make_stages(double h) override;
  [[nodiscard]] double error_norm(double h) override;
  void prepare_interpolation(double h) override;
  void interpolate_in_step(double share, VectorXd& y) const override;

  VectorXd k2_, k3_, k4_, k5_, k6_;  // slopes within the step; the first and seventh are its ends'
  VectorXd bend_, turn_, fifth_;     // dense output beyond the straight line
};

}  // namespace cdcr::detail
