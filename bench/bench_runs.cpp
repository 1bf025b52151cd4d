// 10 s of free oscillation from theta = pi/4, sampled at 1,001 times, by every method.
//
// A row's "error" is the largest error in theta [rad] over these times, against dopri5 at
// rtol 1e-13. The rows named with a tolerance make the curve of time against error.
#include <cdcr/cvode.hpp>
#include <sstream>

#include "harness.hpp"
#include "scenario.hpp"

namespace cdcr::bench {
namespace {

/// One free oscillation by one method.
class Oscillation {
 public:
  explicit Oscillation(Index num_times = 1001)
      : times_(VectorXd::LinSpaced(num_times, 0.0, 10.0)) {}

  [[nodiscard]] Trajectory run(Method method, const Options& options) const {
    const bool by_cvode = method == Method::bdf || method == Method::adams;
    return simulate(model_, bent().q, bent().qd, times_, still_, method, options,
                    by_cvode ? make_cvode_integrator : make_integrator);
  }

 private:
  Model model_{robot(false)};
  VectorXd times_;
  TensionInput still_ = TensionInput::constant(VectorXd::Zero(3));
};

/// atol follows rtol at the distance that the defaults have.
Options tolerance(double rtol) {
  Options options;
  options.rtol = rtol;
  options.atol = 1e-2 * rtol;
  return options;
}

struct Kind {
  Method method;
  const char* name;
};

class Runs {
 public:
  Runs(const Harness& harness) : harness_(harness), truth_(exact_.run(Method::dopri5, best())) {}

  void measure(const std::string& name, Method method, const Options& options, long blocks) const {
    const std::string row = "free oscillation, " + name;
    if (!harness_.wants(row)) return;
    const Trajectory run = exact_.run(method, options);
    std::ostringstream extra;
    extra << std::setprecision(3) << R"(, "error": )" << (run.q - truth_.q).cwiseAbs().maxCoeff()
          << R"(, "steps": )" << run.stats.steps << R"(, "evaluations": )" << run.stats.evaluations;
    harness_.run(
        {row, "ms", 1, blocks}, [] {}, [&](long /*i*/) { keep(exact_.run(method, options)); },
        extra.str());
  }

  void ends_only() const {
    const Oscillation two_times(2);
    const Options options = tolerance(1e-8);
    harness_.run(
        {"free oscillation, dopri5 rtol 1e-8, last state only", "ms", 1, 300}, [] {},
        [&](long /*i*/) { keep(two_times.run(Method::dopri5, options)); });
  }

 private:
  static Options best() {
    Options options;
    options.rtol = 1e-13;
    options.atol = 1e-15;
    return options;
  }

  const Harness& harness_;
  Oscillation exact_;
  Trajectory truth_;
};

}  // namespace
}  // namespace cdcr::bench

int main(int argc, char** argv) {
  using namespace cdcr;
  const bench::Harness harness(argc, argv);
  const bench::Runs runs(harness);
  const bench::Kind kinds[] = {
      {Method::dopri5, "dopri5"}, {Method::adams, "adams"}, {Method::bdf, "bdf"}};
  for (const auto& [method, name] : kinds) {
    runs.measure(std::string(name) + " by default", method, Options(), 100);
    for (const char* rtol : {"1e-6", "1e-7", "1e-8", "1e-9", "1e-10", "1e-11", "1e-12"}) {
      const bool headline = std::string(rtol) == "1e-8";
      runs.measure(std::string(name) + " rtol " + rtol, method, bench::tolerance(std::atof(rtol)),
                   headline ? 300 : 50);
    }
  }
  for (const char* step : {"4e-3", "2e-3", "1e-3", "5e-4", "2.5e-4"}) {
    Options options;
    options.step = std::atof(step);
    runs.measure(std::string("rk4 step ") + step, Method::rk4, options, 100);
  }
  runs.ends_only();
}
