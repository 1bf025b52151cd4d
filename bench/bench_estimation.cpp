// An estimator inside a loop of 1 ms: an update of each, from cable lengths and the tip.
#include "cdcr/cdcr.hpp"
#include "harness.hpp"

namespace cdcr::bench {
namespace {

Model arms(int sections) {
  Robot robot = amouri2020();
  robot.gravity = {0.0, 0.0, -9.81};
  robot.sections[0].damping = 0.01;
  robot.sections.resize(static_cast<std::size_t>(sections), robot.sections[0]);
  return Model(robot);
}

KalmanOptions options() {
  KalmanOptions options;
  options.sensors.resize(2);
  options.sensors[0].kind = Sensor::Kind::lengths;
  options.sensors[0].noise = 1e-4;
  options.sensors[1].kind = Sensor::Kind::tip;
  options.sensors[1].noise = 1e-3;
  return options;
}

void measure(const Harness& harness, const std::string& name, const Model& model,
             Estimator& estimator) {
  const VectorXd zero = VectorXd::Zero(model.num_coordinates());
  const VectorXd command = VectorXd::Constant(model.num_cables(), 1.0);
  std::vector<Measurement> told(2);
  told[0] = {model.straight_lengths(), true};
  told[1] = {tip(model, zero).p, true};
  VectorXd q = zero, qd = zero;
  harness.run(
      {name, "us", 100, 500}, [&] { estimator.reset(zero, zero, command); },
      [&](long i) {
        keep(estimator.update(1e-3 * static_cast<double>(i), told, command, q, qd));
        keep(q);
      });
}

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  using namespace cdcr;
  const bench::Harness harness(argc, argv);
  for (const int sections : {1, 3, 8}) {
    const Model model = bench::arms(sections);
    const std::string of =
        ", " + std::to_string(sections) + (sections > 1 ? " sections" : " section");
    ExtendedKalman extended(model, bench::options());
    bench::measure(harness, "ExtendedKalman.update" + of, model, extended);
    KalmanOptions more = bench::options();
    more.force_at = Place{sections - 1, 1.0};
    ExtendedKalman with_force(model, more);
    bench::measure(harness, "the same with a force" + of, model, with_force);
    UnscentedKalman unscented(model, bench::options());
    bench::measure(harness, "UnscentedKalman.update" + of, model, unscented);
  }
  return 0;
}
