#include "integration/rk4.hpp"

namespace cdcr::detail {

Status Rk4::make_step(double t, double h, const VectorXd& y, const VectorXd& slope,
                      VectorXd& next) {
  const auto f = [this](double at, const double* stage, double* dydt) {
    derivative(at, stage, dydt);
  };
  stages_.step(f, t, h, y, slope, next);
  const Status status = ode_.check(next.data());
  if (status == Status::ok) return status;
  const auto check = [this](const double* stage) { return ode_.check(stage); };
  return stages_.failure_status(status, check, f, t, h, y, slope, next);
}

}  // namespace cdcr::detail
