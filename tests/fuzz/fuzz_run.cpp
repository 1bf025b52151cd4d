// Runs by every method, with events, loads and controllers, and steps of the simulator.
#include <cmath>

#include "cdcr/pid.hpp"
#include "cdcr/simulate.hpp"
#include "cdcr/simulator.hpp"
#include "input.hpp"
#ifdef CDCR_FUZZ_CVODE
#include "cdcr/cvode.hpp"
#endif

namespace cdcr::fuzz {
namespace {

#ifdef CDCR_FUZZ_CVODE
constexpr IntegratorFactory factory = make_cvode_integrator;
#else
constexpr IntegratorFactory factory = make_integrator;
#endif

Options options(Input& input) {
  Options options;
  options.max_steps = input.integer(1, 100);
  const int parts = input.byte();
  if ((parts & 1) != 0) options.rtol = input.positive(1e-6);
  if ((parts & 2) != 0) options.atol = input.positive(1e-8);
  if ((parts & 4) != 0) options.step = input.positive(1e-3);
  if ((parts & 8) != 0) options.max_step = input.positive(1e-2);
  return options;
}

/// Increasing times, most of the time.
VectorXd times(Input& input) {
  VectorXd t(input.integer(input.rare() ? 0 : 1, 5));
  double now = input.coin() ? input.number(1.0) : 0.0;
  for (double& time : t) {
    time = now;
    now += input.positive(1e-2);
  }
  return t;
}

/// Constant, a table or a function.
std::optional<CommandInput> command(const Model& model, Input& input) {
  const Index cables = input.size_near(model.num_cables());
  std::optional<CommandInput> made;
  const int kind = input.byte() % 4;
  const VectorXd value = input.magnitudes(cables, 1.0);
  attempt([&] {
    if (kind == 0) made = CommandInput::constant(value);
    if (kind == 1 || kind == 2) {
      const VectorXd t = times(input);
      const VectorXd values = input.magnitudes(t.size() * cables, 1.0);
      made = CommandInput::table(
          t, values.reshaped(t.size(), cables),
          kind == 1 ? Signal::Interpolation::linear : Signal::Interpolation::previous);
    }
    if (kind == 3) {
      const double rate = input.number(100.0);
      made = CommandInput::function(
          [value, rate](double t, const ConstVectorRef& q, const ConstVectorRef&, VectorRef now) {
            now = value * (1.0 + std::sin(rate * t)) * (1.0 + q.norm());
          },
          cables);
    }
  });
  return made;
}

WrenchInput loads(const Model& model, Input& input) {
  WrenchInput loads;
  for (const Wrench& wrench : input.wrenches(model, 2)) {
    Profile profile;
    if (input.coin()) {
      const VectorXd t = times(input);
      const VectorXd factors = input.vector(t.size(), 1.0);
      profile.times.assign(t.begin(), t.end());
      profile.factors.assign(factors.begin(), factors.end());
      profile.linear = input.coin();
    }
    attempt([&] { loads.add(wrench, profile); });
  }
  return loads;
}

Events events(Input& input) {
  Events events;
  for (int k = input.integer(0, 2); k > 0; --k) {
    const double level = input.number(0.1), slope = input.number(1.0);
    Event event;
    event.function = [level, slope](double t, const ConstVectorRef& q, const ConstVectorRef& qd) {
      return q[0] + slope * t + 1e-3 * qd[0] - level;
    };
    event.direction = input.integer(-1, 1);
    event.terminal = input.integer(0, 2);
    events.push_back(event);
  }
  return events;
}

void check(const Model& model, const Trajectory& run, const VectorXd& times) {
  const Index n = run.t.size();
  demand(run.q.rows() == n && run.qd.rows() == n && run.tension.rows() == n &&
             run.command.rows() == n && n <= times.size(),
         "columns of a run that differ in length");
  demand(run.t == times.head(n), "samples at other times");
  demand(run.q.allFinite() && run.qd.allFinite() && run.command.allFinite(),
         "a sample that is not finite");
  // A stiffness near the largest double may give tensions beyond, which end the run.
  demand(run.tension.allFinite() || run.status == Status::non_finite_state,
         "a run with tensions that are not finite");
  demand((run.tension.array() >= 0.0).all(), "a cable that pushes");
  demand((run.status == Status::ok) == run.message.empty(), "a message that does not fit");
  demand(run.status != Status::ok || n == times.size(), "a run that ends early with status ok");
  for (const EventRecord& event : run.events) {
    demand(event.time >= times[0] && event.time <= times[times.size() - 1] && event.q.allFinite() &&
               event.qd.allFinite(),
           "an event that cannot be");
  }
  for (const SlackEvent& event : run.slack_events) {
    demand(std::isfinite(event.time) && event.cable >= 0 && event.cable < model.num_cables(),
           "a slack event that cannot be");
  }
}

void check_run(const Model& model, Input& input) {
  const Index d = model.num_coordinates();
  const auto method = static_cast<Method>(input.integer(0, 3));
  const Options chosen = options(input);
  const VectorXd q0 = input.vector(input.size_near(d), 0.5), qd0 = input.vector(d, 1.0);
  const VectorXd t = times(input);
  const WrenchInput wrenches = loads(model, input);
  const Events looked_for = events(input);
  if (input.byte() % 4 == 3) {
    PidOptions gains;
    gains.kp = input.positive(1.0);
    gains.ki = input.positive(1.0);
    gains.kd = input.positive(0.1);
    gains.period = input.positive(1e-3);
    if (input.coin()) gains.limits.max_tension = input.positive(10.0);
    attempt([&] {
      Pid pid(model, gains);
      check(model,
            simulate(model, q0, qd0, t, pid, method, chosen, factory, {}, wrenches, looked_for), t);
    });
  } else if (const auto pulled = command(model, input)) {
    attempt([&] {
      check(model,
            simulate(model, q0, qd0, t, *pulled, method, chosen, factory, {}, wrenches, looked_for),
            t);
    });
  }
}

void check_steps(const Model& model, Input& input) {
  const Index d = model.num_coordinates();
  attempt([&] {
    Simulator simulator(model, input.positive(1e-3), input.integer(input.rare() ? 0 : 1, 4));
    simulator.reset(input.vector(input.size_near(d), 0.5), input.vector(d, 1.0),
                    input.coin() ? input.number(1.0) : 0.0);
    for (int k = input.integer(1, 20); k > 0; --k) {
      const VectorXd q = simulator.q(), qd = simulator.qd();
      const VectorXd command = input.magnitudes(input.size_near(model.num_cables()), 1.0);
      const Status status = simulator.step(command, input.wrenches(model, 1));
      demand(simulator.q().allFinite() && simulator.qd().allFinite(), "a state that is not finite");
      demand(status == Status::ok || (simulator.q() == q && simulator.qd() == qd),
             "a step that failed and moved the robot");
    }
  });
}

void check(Input input) {
  const std::optional<Model> model = input.model();
  if (!model) return;
  if (input.coin()) {
    check_steps(*model, input);
  } else {
    check_run(*model, input);
  }
}

}  // namespace
}  // namespace cdcr::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cdcr::fuzz::check({data, size});
  return 0;
}
