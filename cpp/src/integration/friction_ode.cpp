#include <cmath>

#include "cdcr/dynamics.hpp"
#include "cdcr/robot_ode.hpp"
#include "loads/total_force.hpp"

// The equation of robots whose friction remembers.

namespace cdcr {

void RobotOde::memory_derivative(const double* y, double* dydt) noexcept {
  const Index m = model_->num_coordinates();
  detail::total_force(*model_, y, y + m, command_.data(), y + 2 * m, wrenches_, force_.data(),
                      dydt + 2 * m);
  const Eigen::Map<const VectorXd> q(y, m), qd(y + m, m);
  Eigen::Map<VectorXd> qdd(dydt + m, m);
  for (Index i = 0; i < m; ++i) dydt[i] = y[m + i];
  forward_dynamics_force(*model_, data_, q, qd, force_, qdd);
}

void RobotOde::memory_jacobian(const double* y, double* J) noexcept {
  constexpr double relative = 1e-7, of_deflection = 1e-9;  // [rad], [rad/s]; [m]
  const Index size = num_states(), m = model_->num_coordinates();
  Eigen::Map<MatrixXd> A(J, size, size);
  moved_ = Eigen::Map<const VectorXd>(y, size);
  memory_derivative(y, slope_.data());
  for (Index i = 0; i < size; ++i) {
    const double step = i < 2 * m ? relative * std::fmax(1.0, std::abs(y[i])) : of_deflection;
    moved_[i] = y[i] + step;
    memory_derivative(moved_.data(), slope_there_.data());
    A.col(i) = (slope_there_ - slope_) / step;
    moved_[i] = y[i];
  }
}

}  // namespace cdcr
