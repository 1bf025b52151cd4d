// A study's use of the library: cdcr::cvode, the same run by CVODE and by Dormand-Prince.
#include <cdcr/cdcr.hpp>
#include <cdcr/cvode.hpp>
#include <cstdio>

int main() {
  const cdcr::Model model(cdcr::amouri2020());
  const cdcr::CommandInput pull = cdcr::CommandInput::constant(cdcr::Vector3d(5.0, 0.0, 0.0));
  const cdcr::VectorXd zero = cdcr::VectorXd::Zero(2);
  const cdcr::VectorXd times = cdcr::VectorXd::LinSpaced(101, 0.0, 1.0);

  const cdcr::Trajectory bdf = cdcr::simulate(model, zero, zero, times, pull, cdcr::Method::bdf, {},
                                              cdcr::make_cvode_integrator);
  const cdcr::Trajectory dopri5 = cdcr::simulate(model, zero, zero, times, pull);
  if (bdf.status != cdcr::Status::ok || dopri5.status != cdcr::Status::ok) {
    std::printf("%s %s\n", bdf.message.c_str(), dopri5.message.c_str());
    return 1;
  }
  const double difference = (bdf.q - dopri5.q).cwiseAbs().maxCoeff();
  std::printf("cdcr %s: bdf and dopri5 differ by %.1e rad within 1 s\n", cdcr::version, difference);
  return difference < 1e-6 ? 0 : 1;
}
