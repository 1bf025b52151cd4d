#include "cdcr/simulate.hpp"

#include "dynamics/bending.hpp"

namespace cdcr {
namespace {

constexpr long steps_between_reports = 256;

/// Fills the rows of a trajectory as the run passes their times.
class Recorder {
 public:
  Recorder(RobotOde& ode, const VectorXd& times, Trajectory& out)
      : ode_(ode), out_(out), y_(ode.num_states()) {
    const Index m = ode.model().num_coordinates();
    out_.t = times;
    out_.q.resize(times.size(), m);
    out_.qd.resize(times.size(), m);
    out_.tension.resize(times.size(), ode.model().num_cables());
    out_.command.resize(times.size(), ode.model().num_cables());
    tension_.resize(ode.model().num_cables());
    command_.resize(ode.model().num_cables());
  }

  [[nodiscard]] bool done() const { return next_ == out_.t.size(); }
  [[nodiscard]] double next_time() const { return out_.t[next_]; }

  /// Records the state at the next output time.
  void record(const VectorXd& y) {
    const Index m = out_.q.cols();
    out_.q.row(next_) = y.head(m).transpose();
    out_.qd.row(next_) = y.tail(m).transpose();
    ode_.cables(out_.t[next_], y, command_, tension_);
    out_.tension.row(next_) = tension_.transpose();
    out_.command.row(next_) = command_.transpose();
    ++next_;
  }

  /// Records all output times up to the end of the integrator's last step, but for `stop`: at a
  /// jump the tensions after it count, so that row waits for the next stretch to start.
  void record_step(Integrator& integrator, double stop) {
    while (!done() && next_time() <= integrator.time() && next_time() < stop) {
      if (next_time() == integrator.time()) {
        record(integrator.state());
      } else {
        integrator.interpolate(next_time(), y_);
        record(y_);
      }
    }
  }

  /// Drops the rows that were not reached.
  void finish() {
    if (done()) return;
    out_.t.conservativeResize(next_);
    out_.q.conservativeResize(next_, Eigen::NoChange);
    out_.qd.conservativeResize(next_, Eigen::NoChange);
    out_.tension.conservativeResize(next_, Eigen::NoChange);
    out_.command.conservativeResize(next_, Eigen::NoChange);
  }

 private:
  RobotOde& ode_;
  Trajectory& out_;
  VectorXd y_, tension_, command_;
  Index next_ = 0;
};

/// One stretch without break points, from the integrator's restart to its stop time.
Status run_segment(Integrator& integrator, Recorder& recorder, double stop, const Options& options,
                   const Progress& progress) {
  while (integrator.time() < stop) {
    const long steps = integrator.stats().steps;
    if (steps >= options.max_steps) return Status::step_limit;
    if (progress && steps % steps_between_reports == 0 && !progress(integrator.time())) {
      return Status::interrupted;
    }
    const Status status = integrator.step();
    if (status != Status::ok) return status;
    recorder.record_step(integrator, stop);
  }
  return Status::ok;
}

/// The run itself, shared by inputs and controllers.
Trajectory run(RobotOde& ode, const VectorXd& q0, const VectorXd& qd0, const VectorXd& times,
               Integrator& integrator, Method method, const Options& options,
               const Progress& progress) {
  VectorXd y(ode.num_states());
  y << q0, qd0;
  detail::require_bending("q0", ode.model(), q0);
  Trajectory out;
  Recorder recorder(ode, times, out);
  const double end = times[times.size() - 1];
  double t = times[0];
  while (true) {
    out.status = ode.start_segment(t, y);
    if (out.status != Status::ok) break;
    if (!recorder.done() && recorder.next_time() == t) recorder.record(y);
    if (t >= end) break;
    const double stop = std::min(end, ode.segment_end());
    out.status = integrator.restart(t, y, stop);
    if (out.status == Status::ok) {
      out.status = run_segment(integrator, recorder, stop, options, progress);
    }
    t = integrator.time();
    y = integrator.state();
    if (out.status != Status::ok) break;
  }
  recorder.finish();
  out.stats = integrator.stats();
  out.slack_events = integrator.slack_events();
  if (out.status != Status::ok) {
    out.message = detail::sentence("Stopped at t = ", t, " s (", name(out.status), "). ",
                                   message(out.status), advice(out.status, method));
  }
  return out;
}

void check_arguments(const Model& model, const VectorXd& q0, const VectorXd& qd0,
                     const VectorXd& times) {
  detail::require_finite("q0", q0, model.num_coordinates());
  detail::require_finite("qd0", qd0, model.num_coordinates());
  detail::require(times.size() > 0, "t must hold at least one time, got none");
  detail::require_increasing("t", times.data(), times.size());
}

}  // namespace

Trajectory simulate(const Model& model, const VectorXd& q0, const VectorXd& qd0,
                    const VectorXd& times, const CommandInput& input, Method method,
                    const Options& options, IntegratorFactory factory, const Progress& progress,
                    const WrenchInput& loads) {
  check_arguments(model, q0, qd0, times);
  RobotOde ode(model, input, loads);
  return run(ode, q0, qd0, times, *factory(ode, method, options), method, options, progress);
}

Trajectory simulate(const Model& model, const VectorXd& q0, const VectorXd& qd0,
                    const VectorXd& times, Controller& controller, Method method,
                    const Options& options, IntegratorFactory factory, const Progress& progress,
                    const WrenchInput& loads) {
  check_arguments(model, q0, qd0, times);
  RobotOde ode(model, controller, loads);
  controller.reset();
  return run(ode, q0, qd0, times, *factory(ode, method, options), method, options, progress);
}

}  // namespace cdcr
