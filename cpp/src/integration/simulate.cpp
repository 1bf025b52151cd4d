#include "cdcr/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "dynamics/bending.hpp"
#include "integration/crossings.hpp"
#include "integration/recorder.hpp"
#include "integration/run_sensitivities.hpp"

namespace cdcr {
namespace {

using detail::Crossing;
using detail::Crossings;

constexpr long steps_between_reports = 256;
// Internal steps of a run that names no limit: so many, and so many more for each stretch.
constexpr long steps_of_a_run = 1000000, steps_of_a_stretch = 100;
// A step sees a function of time at a few points. Unless told, none is longer than this share of
// the run or, up to the most, than the rows are apart.
constexpr Index least_steps = 1000, most_least_steps = 100000;
// Cables that turn within this time of one another turn together [s].
constexpr double together = 1e-13;

/// Time as the run counts it, from its first output time, is `start` before that of the user.
class ShiftedController final : public Controller {
 public:
  ShiftedController(Controller& inner, double start) : inner_(inner), start_(start) {}
  void reset() noexcept override { inner_.reset(); }
  Status update(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                VectorRef tension) noexcept override {
    return inner_.update(start_ + t, q, qd, tension);
  }
  [[nodiscard]] double period() const noexcept override { return inner_.period(); }
  [[nodiscard]] Index num_coordinates() const noexcept override { return inner_.num_coordinates(); }
  [[nodiscard]] Index num_cables() const noexcept override { return inner_.num_cables(); }
  [[nodiscard]] bool gives_tensions() const noexcept override { return inner_.gives_tensions(); }
  [[nodiscard]] const Model* reckons_with() const noexcept override {
    return inner_.reckons_with();
  }

 private:
  Controller& inner_;
  double start_;
};

/// Pulls whose sign is no more than rounding.
VectorXd dead_band(const RobotOde& ode, std::size_t num_events) {
  const std::vector<Index>& cables = ode.length_driven();
  const auto count = static_cast<Index>(cables.size());
  VectorXd band = VectorXd::Zero(count + static_cast<Index>(num_events));
  for (Index i = 0; i < count; ++i) {
    const Index j = cables[static_cast<std::size_t>(i)];
    band[i] = 16.0 * std::numeric_limits<double>::epsilon() *
              ode.model().cables()[static_cast<std::size_t>(j)].stiffness *
              ode.model().straight_lengths()[j];
  }
  return band;
}

/// The run itself, shared by inputs and controllers.
class Run {
 public:
  Run(RobotOde& ode, const VectorXd& times, Integrator& integrator, Method method,
      const Options& options, const Progress& progress, const Events& events,
      detail::RunSensitivities* sensitivities = nullptr)
      : ode_(ode),
        integrator_(integrator),
        method_(method),
        max_steps_(options.max_steps),
        progress_(progress),
        events_(events),
        start_(times[0]),
        end_(times[times.size() - 1] - start_),
        num_slack_(static_cast<Index>(ode.length_driven().size())),
        y_(ode.num_states()),
        sensitivities_(sensitivities),
        recorder_(ode, times, sensitivities, out_),
        crossings_(dead_band(ode, events.size()), ode.num_states(),
                   [this](double t, const VectorXd& y, VectorRef values) { watch(t, y, values); }),
        hits_(events.size(), 0) {}

  Trajectory go(const VectorXd& q0, const VectorXd& qd0) {
    y_.setZero();  // no deflections
    y_.head(q0.size()) = q0;
    y_.segment(q0.size(), qd0.size()) = qd0;
    detail::require_bending("q0", ode_.model(), q0);
    double t = 0.0;
    while (true) {
      out_.status = ode_.start_segment(t, y_);
      if (out_.status != Status::ok) {
        if (stretches_ == 0) recorder_.record(y_);  // a controller failed at once
        break;
      }
      ++stretches_;
      if (accept(crossings_.start(t, y_), y_)) out_.status = Status::event;
      if (!recorder_.done() && recorder_.next_time() == t) recorder_.record(y_);
      if (t >= end_ || out_.status != Status::ok) break;
      const double stop = std::min(end_, ode_.segment_end());
      out_.status = integrator_.restart(t, y_, stop);
      if (out_.status == Status::ok) out_.status = run_stretch(stop);
      t = integrator_.time();
      y_ = integrator_.state();
      if (out_.status != Status::ok) break;
    }
    recorder_.finish();
    out_.stats = integrator_.stats();
    if (out_.stats.stiff) *out_.stats.stiff += start_;
    if (out_.status != Status::ok) {
      if (out_.status == Status::event) t = out_.events.back().time - start_;
      out_.message = detail::sentence("Stopped at t = ", start_ + t, " s (", name(out_.status),
                                      "). ", message(out_.status), advice(out_.status, method_));
    }
    return std::move(out_);
  }

 private:
  /// One stretch without break points, from the integrator's restart to its stop time.
  Status run_stretch(double stop) {
    const long most = max_steps_.value_or(steps_of_a_run + steps_of_a_stretch * stretches_);
    while (integrator_.time() < stop) {
      const long steps = integrator_.stats().steps;
      if (steps >= most) return Status::step_limit;
      if (progress_ && steps % steps_between_reports == 0 &&
          !progress_(start_ + integrator_.time())) {
        return Status::interrupted;
      }
      const double begin = integrator_.time();
      Status status = integrator_.step();
      if (status != Status::ok) return status;
      status = pass_crossings(begin, stop);
      if (status != Status::ok) return status;
      recorder_.record_step(integrator_, integrator_.time(), stop);
      if (sensitivities_ != nullptr) sensitivities_->advance(integrator_, integrator_.time());
    }
    return Status::ok;
  }

  /// Goes through what crossed zero in the step just made. Where a cable turns slack or taut, its
  /// force bends: the integrator goes back to there and starts anew.
  Status pass_crossings(double begin, double stop) {
    const std::vector<Crossing>& found = crossings_.find(integrator_, begin);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Crossing first = found[i];
      integrator_.interpolate(first.time, y_);
      if (accept({first}, y_)) {
        recorder_.record_step(integrator_, first.time, stop);
        return Status::event;
      }
      if (first.function >= num_slack_ || !integrator_.stops_at_kinks()) continue;
      for (++i; i < found.size() && found[i].time - first.time <= together; ++i) {
        if (found[i].function < num_slack_)
          accept({{first.time, found[i].function, found[i].rising}}, y_);
      }
      if (first.time >= stop) return Status::ok;
      recorder_.record_step(integrator_, first.time, stop);
      if (sensitivities_ != nullptr) sensitivities_->advance_to_kink(integrator_, first.time);
      crossings_.resume(first.time, y_);
      return integrator_.restart(first.time, y_, stop);
    }
    return Status::ok;
  }

  /// Notes crossings made in state y; whether one of them ends the run.
  bool accept(const std::vector<Crossing>& made, const VectorXd& y) {
    const Index m = ode_.model().num_coordinates();
    bool ends = false;
    for (const Crossing& crossing : made) {
      crossings_.accept(crossing);
      const Index i = crossing.function - num_slack_;
      if (i < 0) {
        const Index cable = ode_.length_driven()[static_cast<std::size_t>(crossing.function)];
        out_.slack_events.push_back({start_ + crossing.time, cable, !crossing.rising});
        continue;
      }
      const Event& event = events_[static_cast<std::size_t>(i)];
      if (event.direction != 0 && crossing.rising != (event.direction > 0)) continue;
      out_.events.push_back({start_ + crossing.time, i, y.head(m), y.segment(m, m)});
      const int count = ++hits_[static_cast<std::size_t>(i)];
      ends = ends || (event.terminal > 0 && count >= event.terminal);
    }
    return ends;
  }

  /// Values that are watched: pulls of length-driven cables, then the user's functions.
  void watch(double t, const VectorXd& y, VectorRef values) {
    const Index m = ode_.model().num_coordinates();
    ode_.pulls(t, y.data(), values.data());
    for (std::size_t i = 0; i < events_.size(); ++i) {
      double& value = values[num_slack_ + static_cast<Index>(i)];
      value = events_[i].function(start_ + t, y.head(m), y.segment(m, m));
      detail::require(std::isfinite(value), "event ", i + 1, " must give finite values, got ",
                      value, " at t = ", start_ + t, " s");
    }
  }

  RobotOde& ode_;
  Integrator& integrator_;
  Method method_;
  std::optional<long> max_steps_;
  const Progress& progress_;
  const Events& events_;
  double start_, end_;
  Index num_slack_;
  Trajectory out_;
  VectorXd y_;
  detail::RunSensitivities* sensitivities_;
  detail::Recorder recorder_;
  Crossings crossings_;
  std::vector<int> hits_;
  long stretches_ = 0;
};

/// The options of a run under functions of time, which steps without a limit could jump over.
Options watchful(Options options, const VectorXd& times, bool has_functions) {
  if (!has_functions || options.max_step > 0.0 || times.size() < 2) return options;
  const Index count = std::clamp(times.size() - 1, least_steps, most_least_steps);
  options.max_step = (times[times.size() - 1] - times[0]) / static_cast<double>(count);
  return options;
}

void check_arguments(const Model& model, const VectorXd& q0, const VectorXd& qd0,
                     const VectorXd& times, const Events& events) {
  detail::require_finite("q0", q0, model.num_coordinates());
  detail::require_finite("qd0", qd0, model.num_coordinates());
  detail::require(times.size() > 0, "t must hold at least one time, got none");
  detail::require_increasing("t", times.data(), times.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    detail::require(static_cast<bool>(events[i].function), "event ", i + 1, " has no function");
    detail::require(events[i].terminal >= 0, "terminal of event ", i + 1, " must be >= 0, got ",
                    events[i].terminal);
  }
}

}  // namespace

Trajectory simulate(const Model& model, const VectorXd& q0, const VectorXd& qd0,
                    const VectorXd& times, const CommandInput& input, Method method,
                    const Options& options, IntegratorFactory factory, const Progress& progress,
                    const WrenchInput& loads, const Events& events) {
  return simulate(model, q0, qd0, times, input, {}, method, options, factory, progress, loads,
                  events);
}

Trajectory simulate(const Model& model, const VectorXd& q0, const VectorXd& qd0,
                    const VectorXd& times, const CommandInput& input,
                    const Sensitivities& sensitivities, Method method, const Options& options,
                    IntegratorFactory factory, const Progress& progress, const WrenchInput& loads,
                    const Events& events) {
  check_arguments(model, q0, qd0, times, events);
  const CommandInput commands = input.commands_since(times[0]);
  const WrenchInput wrenches = loads.since(times[0]);
  RobotOde ode(model, commands, wrenches);
  const Options chosen =
      watchful(options, times, input.is_unbroken_function() || loads.has_unbroken_function());
  const auto integrator = factory(ode, method, chosen);
  std::optional<detail::RunSensitivities> carried;
  if (sensitivities.columns(model) > 0) {
    detail::require(!input.is_function(),
                    "sensitivities need commands that are constant or a table: a function may be "
                    "feedback, whose own derivatives are not known");
    carried.emplace(ode, sensitivities, times[0], method, chosen);
  }
  return Run(ode, times, *integrator, method, chosen, progress, events,
             carried ? &*carried : nullptr)
      .go(q0, qd0);
}

Trajectory simulate(const Model& model, const VectorXd& q0, const VectorXd& qd0,
                    const VectorXd& times, Controller& controller, Method method,
                    const Options& options, IntegratorFactory factory, const Progress& progress,
                    const WrenchInput& loads, const Events& events) {
  check_arguments(model, q0, qd0, times, events);
  ShiftedController shifted(controller, times[0]);
  const WrenchInput wrenches = loads.since(times[0]);
  RobotOde ode(model, shifted, wrenches);
  const Options chosen = watchful(options, times, loads.has_unbroken_function());
  const auto integrator = factory(ode, method, chosen);
  controller.reset();
  return Run(ode, times, *integrator, method, chosen, progress, events).go(q0, qd0);
}

}  // namespace cdcr
