// Runs of 10 s, sampled at 1,001 times, by every method.
//
// A row's "error" is the largest error in theta [rad] over these times, against dopri5 at
// rtol 1e-13. The rows named with a tolerance or a step make the curve of time against error.
#include <cdcr/cvode.hpp>
#include <sstream>

#include "harness.hpp"
#include "scenario.hpp"

namespace cdcr::bench {
namespace {

struct Kind {
  Method method;
  const char* name;
};
constexpr Kind adaptive[] = {{Method::dopri5, "dopri5"},
                             {Method::dop853, "dop853"},
                             {Method::adams, "adams"},
                             {Method::bdf, "bdf"}};

/// From rest at q0, under constant tensions, without gravity.
struct Problem {
  std::string name;
  double damping;
  double theta;
  Eigen::Vector3d tension;
};

/// atol follows rtol at the distance that the defaults have.
Options tolerance(double rtol) {
  Options options;
  options.rtol = rtol;
  options.atol = 1e-2 * rtol;
  return options;
}

Options fixed(double step) {
  Options options;
  options.step = step;
  return options;
}

Robot damped(double damping) {
  Robot robot = bench::robot(false);
  robot.sections[0].damping = damping;
  return robot;
}

class Runs {
 public:
  Runs(const Harness& harness, const Problem& problem, Index num_times = 1001)
      : harness_(harness),
        name_(problem.name),
        model_(damped(problem.damping)),
        q0_(bending(problem.theta, 0.0)),
        tension_(CommandInput::constant(problem.tension)),
        times_(VectorXd::LinSpaced(num_times, 0.0, 10.0)),
        truth_(run(Method::dopri5, tolerance(1e-13))) {}

  void measure(const std::string& how, Method method, const Options& options, long blocks) const {
    const std::string row = name_ + ", " + how;
    if (!harness_.wants(row)) return;
    const Trajectory once = run(method, options);
    std::ostringstream extra;
    extra << std::setprecision(3) << R"(, "error": )" << (once.q - truth_.q).cwiseAbs().maxCoeff()
          << R"(, "steps": )" << once.stats.steps << R"(, "evaluations": )"
          << once.stats.evaluations;
    const Plan plan{row, "ms", 1, blocks};
    harness_.run(plan, [] {}, [&](long /*i*/) { keep(run(method, options)); }, extra.str());
  }

  void measure_defaults() const {
    for (const auto& [method, name] : adaptive) {
      measure(std::string(name) + " by default", method, Options(), 100);
    }
    measure("rk4 by default", Method::rk4, Options(), 100);
  }

  void measure_adaptive(const std::string& rtol, long blocks) const {
    for (const auto& [method, name] : adaptive) {
      measure(name + (" rtol " + rtol), method, tolerance(std::stod(rtol)), blocks);
    }
  }

 private:
  [[nodiscard]] Trajectory run(Method method, const Options& options) const {
    const bool by_cvode = method == Method::bdf || method == Method::adams;
    return simulate(model_, q0_, VectorXd::Zero(2), times_, tension_, method, options,
                    by_cvode ? make_cvode_integrator : make_integrator);
  }

  const Harness& harness_;
  std::string name_;
  Model model_;
  VectorXd q0_;
  CommandInput tension_;
  VectorXd times_;
  Trajectory truth_;
};

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  using namespace cdcr;
  using bench::Runs;
  const bench::Harness harness(argc, argv);
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();

  const Runs oscillation(harness, {"free oscillation", 0.0, bench::quarter_pi, none});
  oscillation.measure_defaults();
  oscillation.measure_adaptive("1e-8", 300);
  for (const char* rtol : {"1e-6", "1e-7", "1e-9", "1e-10", "1e-11", "1e-12"}) {
    oscillation.measure_adaptive(rtol, 50);
  }
  for (const char* step : {"4e-3", "2e-3", "1e-3", "5e-4", "2.5e-4"}) {
    oscillation.measure(std::string("rk4 step ") + step, Method::rk4, bench::fixed(std::stod(step)),
                        50);
  }
  Runs(harness, {"free oscillation, last state only", 0.0, bench::quarter_pi, none}, 2)
      .measure_adaptive("1e-8", 50);
  Runs(harness, {"step-tension", 0.0, 0.0, {5.0, 0.0, 0.0}}).measure_defaults();
  // Some two thousand times the damping that lets the paper's robot settle: a stiff problem.
  const Runs damped(harness, {"strongly damped return", 2.0, bench::quarter_pi, none});
  damped.measure_adaptive("1e-8", 100);
}
