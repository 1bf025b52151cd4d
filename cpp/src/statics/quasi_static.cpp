#include "cdcr/quasi_static.hpp"

#include <algorithm>

#include "base/arguments.hpp"
#include "cdcr/cable_friction.hpp"
#include "cdcr/robot_ode.hpp"
#include "cdcr/statics.hpp"
#include "statics/slow_step.hpp"

namespace cdcr {
namespace {

// A step between samples is cut in halves down to this share of it.
constexpr double least_share = 1.0 / 256.0;

/// The run itself.
class SlowRun {
 public:
  SlowRun(const Model& model, const Wrenches& wrenches, QuasiStatic& out)
      : model_(model), wrenches_(wrenches), out_(out), step_(model, wrenches) {}

  bool begin(const VectorXd& command, const QuasiStaticStart& start) {
    const Index m = model_.num_cables();
    felt_ = start.felt.size() == 0 ? command : start.felt;
    follow_with_play(model_, command, felt_);
    asked_ = command;
    if (start.deflection.size() != 0 && start.q.size() != 0) {
      step_.reset(start.q, start.deflection);
      return move(felt_, felt_);
    }
    const Equilibrium rest = equilibrium(model_, felt_, start.q, wrenches_);
    if (rest.status != Status::ok) return false;
    step_.reset(rest.q, start.deflection.size() == 0 ? VectorXd::Zero(m) : start.deflection);
    return move(felt_, felt_);
  }

  /// Goes to the next command, by parts where it has to.
  bool follow(const VectorXd& command) {
    const VectorXd from = asked_;
    double done = 0.0, share = 1.0;
    while (done < 1.0) {
      const double next = std::min(1.0, done + share);
      VectorXd felt = felt_;
      follow_with_play(model_, next == 1.0 ? command : VectorXd(from + next * (command - from)),
                       felt);
      const VectorXd before = felt_;
      if (!move(before, felt)) {
        if (share <= least_share) return jump(felt);
        share *= 0.5;
        ++out_.substeps;
        continue;
      }
      felt_ = felt;
      done = next;
      share = std::min(2.0 * share, 1.0);
    }
    asked_ = command;
    return true;
  }

  void record(Index row) {
    out_.q.row(row) = step_.q().transpose();
    out_.tension.row(row) = step_.tension().transpose();
    out_.end_tension.row(row) = step_.end_tension().transpose();
    out_.friction.row(row) = step_.friction().transpose();
    out_.deflection.row(row) = step_.deflection().transpose();
    out_.felt.row(row) = felt_.transpose();
    std::copy(step_.sliding().begin(), step_.sliding().end(),
              out_.sliding.begin() + row * model_.num_cables());
  }
  [[nodiscard]] long iterations() const { return step_.iterations(); }

 private:
  bool move(const VectorXd& /*from*/, const VectorXd& felt) { return step_.step(felt); }

  /// To another shape, near that without friction.
  bool jump(const VectorXd& felt) {
    const Equilibrium rest = equilibrium(model_, felt, step_.q(), wrenches_);
    if (rest.status != Status::ok || !step_.step(felt, &rest.q)) return false;
    felt_ = felt;
    return true;
  }

  const Model& model_;
  const Wrenches& wrenches_;
  QuasiStatic& out_;
  detail::SlowStep step_;
  VectorXd felt_, asked_;
};

}  // namespace

QuasiStatic quasi_static(const Model& model, const RowMatrixXd& commands,
                         const QuasiStaticStart& start, const Wrenches& wrenches,
                         const Interrupt& interrupt) {
  const Index m = model.num_cables(), count = commands.rows();
  detail::require(commands.cols() == m, "commands must have one column for each of the ", m,
                  " cables, got ", commands.cols());
  detail::require(count > 0, "commands must have at least one row, got none");
  for (Index i = 0; i < count; ++i) {
    try {
      require_command(model, commands.row(i).transpose());
    } catch (const std::invalid_argument& error) {
      detail::refuse("sample ", i + 1, " of ", count, ": ", error.what());
    }
  }
  if (start.q.size() != 0) detail::require_finite("q0", start.q, model.num_coordinates());
  if (start.deflection.size() != 0) detail::require_finite("deflection", start.deflection, m);
  if (start.felt.size() != 0) detail::require_finite("felt", start.felt, m);
  validate(model, wrenches);

  QuasiStatic out;
  out.q.resize(count, model.num_coordinates());
  for (RowMatrixXd* rows :
       {&out.tension, &out.end_tension, &out.friction, &out.deflection, &out.felt}) {
    rows->resize(count, m);
  }
  out.sliding.resize(static_cast<std::size_t>(count * m));
  SlowRun run(model, wrenches, out);
  Index reached = 0;
  out.status = Status::not_converged;
  for (; reached < count; ++reached) {
    if (interrupt && interrupt()) {
      out.status = Status::interrupted;
      break;
    }
    const VectorXd command = commands.row(reached);
    if (!(reached == 0 ? run.begin(command, start) : run.follow(command))) break;
    run.record(reached);
  }
  out.iterations = run.iterations();
  if (reached == count) {
    out.status = Status::ok;
    return out;
  }
  out.message = detail::sentence("Stopped before sample ", reached + 1, " of ", count, " (",
                                 name(out.status), "). ", message(out.status));
  out.q.conservativeResize(reached, Eigen::NoChange);
  for (RowMatrixXd* rows :
       {&out.tension, &out.end_tension, &out.friction, &out.deflection, &out.felt}) {
    rows->conservativeResize(reached, Eigen::NoChange);
  }
  out.sliding.resize(static_cast<std::size_t>(reached * m));
  return out;
}

}  // namespace cdcr
