// An estimator inside a loop of 1 ms: an update of each, from cable lengths and the tip, and from
// cable lengths and what the base feels.
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

Sensor sensor(Sensor::Kind kind, double noise) {
  Sensor sensor;
  sensor.kind = kind;
  sensor.noise = noise;
  return sensor;
}

KalmanOptions hears(std::vector<Sensor> sensors) {
  KalmanOptions options;
  options.sensors = std::move(sensors);
  return options;
}

void measure(const Harness& harness, const std::string& name, const Model& model,
             const std::vector<Sensor>& sensors, Estimator& estimator) {
  const VectorXd zero = VectorXd::Zero(model.num_coordinates());
  VectorXd at_rest(6);
  base_wrench(model, zero, zero, zero, {}, at_rest);
  const VectorXd command = VectorXd::Constant(model.num_cables(), 1.0);
  std::vector<Measurement> told;
  for (const Sensor& sensor : sensors) {
    SensorChannel channel(model, sensor, 1e-3);
    channel.reset(zero, zero, command, at_rest);
    told.push_back({channel.value(), true});
  }
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
  using Kind = Sensor::Kind;
  const Sensor lengths = bench::sensor(Kind::lengths, 1e-4);
  const KalmanOptions options = bench::hears({lengths, bench::sensor(Kind::tip, 1e-3)});
  const KalmanOptions base = bench::hears(
      {lengths, bench::sensor(Kind::base_force, 0.02), bench::sensor(Kind::base_moment, 0.01)});
  for (const int sections : {1, 3, 8}) {
    const Model model = bench::arms(sections);
    const std::string of =
        ", " + std::to_string(sections) + (sections > 1 ? " sections" : " section");
    ExtendedKalman extended(model, options);
    bench::measure(harness, "ExtendedKalman.update" + of, model, options.sensors, extended);
    KalmanOptions more = options;
    more.force_at = Place{sections - 1, 1.0};
    ExtendedKalman with_force(model, more);
    bench::measure(harness, "the same with a force" + of, model, more.sensors, with_force);
    ExtendedKalman by_base(model, base);
    bench::measure(harness, "ExtendedKalman.update from lengths and the base" + of, model,
                   base.sensors, by_base);
    UnscentedKalman unscented(model, options);
    bench::measure(harness, "UnscentedKalman.update" + of, model, options.sensors, unscented);
  }
  return 0;
}
