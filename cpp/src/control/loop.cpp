#include "cdcr/loop.hpp"

#include <string>
#include <utility>

#include "base/sizes.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/loop_log.hpp"
#include "cdcr/robot_ode.hpp"
#include "control/plant_base.hpp"
#include "control/steps.hpp"

namespace cdcr {

Loop::Loop(const Model& plant, Controller& controller, LoopOptions options, Estimator* estimator)
    : options_(std::move(options)),
      plant_(plant, options_.step, options_.substeps, options_.method),
      controller_(&controller),
      estimator_(estimator),
      actuators_(plant, options_.actuators, options_.step) {
  require_fit(controller, plant);
  every_ = detail::whole_steps("the controller's period", controller.period(), options_.step, 1);
  for (const Sensor& sensor : options_.sensors) {
    const std::string name = "sensor " + std::to_string(sensors_.size() + 1);
    sensors_.emplace_back(plant, sensor, options_.step, name);
  }
  for (const SensorChannel& one : sensors_) {
    told_.push_back({one.value(), false});
    if (!one.sensor().feels_base() || base_) continue;
    base_ = std::make_unique<detail::PlantBase>(plant);
    on_base_ = VectorXd::Zero(6);
  }
  if (estimator != nullptr) {
    estimator->require_fit(plant, options_.sensors);
    const double period = estimator->period();
    if (period != 0.0) {
      estimator_every_ = detail::whole_steps("the estimator's period", period, options_.step, 1);
    }
  }
  asked_ = trial_ = tension_ = VectorXd::Zero(plant.num_cables());
  told_q_ = told_qd_ = VectorXd::Zero(plant.num_coordinates());
}

Loop::~Loop() = default;
Loop::Loop(Loop&&) noexcept = default;
Loop& Loop::operator=(Loop&&) noexcept = default;

void Loop::reset(const VectorXd& q, const VectorXd& qd, double start, const VectorXd& command) {
  plant_.reset(q, qd, start);
  if (command.size() == 0) {
    rest_command(plant_.model(), asked_);
  } else {
    require_command(plant_.model(), command);
    asked_ = command;
  }
  actuators_.reset(asked_);
  if (base_) base_->feel(plant_, asked_, no_wrenches(), on_base_);
  for (SensorChannel& sensor : sensors_) sensor.reset(q, qd, asked_, on_base_);
  told_q_ = q;
  told_qd_ = qd;
  if (estimator_ != nullptr) estimator_->reset(q, qd, asked_);
  controller_->reset();
  controller_->hold(asked_);
  status_ = Status::ok;
}

/// What the controller is told: the estimate, or what sensors of the state say, or the truth.
Status Loop::look(const Wrenches& wrenches) noexcept {
  if (base_) {
    const Status status = check_wrenches(plant_.model(), wrenches);
    if (status != Status::ok) return status;
    base_->feel(plant_, given(), wrenches, on_base_);
  }
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    told_[i].fresh = sensors_[i].step(plant_.periods(), q(), qd(), given(), on_base_);
    told_[i].value = sensors_[i].value();
  }
  if (plant_.periods() % estimator_every_ != 0) return Status::ok;  // the estimate holds
  told_q_ = q();
  told_qd_ = qd();
  for (const SensorChannel& channel : sensors_) {
    if (channel.sensor().kind == Sensor::Kind::coordinates) told_q_ = channel.value();
    if (channel.sensor().kind == Sensor::Kind::rates) told_qd_ = channel.value();
  }
  if (estimator_ == nullptr) return Status::ok;
  return estimator_->update(time(), told_, asked_, told_q_, told_qd_);
}

Status Loop::close(const Wrenches& wrenches, const Interrupt& stop) noexcept {
  Status status = look(wrenches);
  if (status != Status::ok) return status;
  if (plant_.periods() % every_ == 0) {
    trial_ = asked_;
    status = controller_->update(time(), told_q_, told_qd_, trial_);
    if (status == Status::ok) status = check_tension(plant_.model(), trial_);
    if (status != Status::ok) return status;
    asked_ = trial_;
  }
  cable_tensions(plant_.model(), q(), qd(), given(), tension_);
  actuators_.step(asked_, tension_);
  return plant_.step(given(), wrenches, stop);
}

void Loop::set_log(LoopLog* log) {
  if (log != nullptr) log->require_fit(*this);
  log_ = log;
}

Status Loop::step(const Wrenches& wrenches) noexcept {
  return step(wrenches, Interrupt());
}

Status Loop::step(const Wrenches& wrenches, const Interrupt& stop) noexcept {
  if (status_ != Status::ok) return status_;
  if (log_ != nullptr) log_->begin(*this);
  status_ = close(wrenches, stop);
  if (log_ != nullptr) log_->end(*this);
  return status_;
}

LoopRun run(Loop& loop, double duration, Index record_every, const Wrenches& wrenches,
            const Interrupt& stop) {
  detail::require(loop.status() != Status::not_started,
                  "the loop has no state: call reset(q, qd) first");
  detail::require(loop.status() == Status::ok, "the loop has ended (", name(loop.status()),
                  "): call reset(q, qd) first");
  const Model& model = loop.plant().model();
  const double step = loop.options().step;
  const Index steps = detail::whole_steps("duration", duration, step, 1);
  detail::require(record_every >= 1, "record_every must be at least 1, got ", record_every);
  validate(model, wrenches);
  const Index rows = steps / record_every + 1, d = model.num_coordinates(), c = model.num_cables();
  LoopRun out;
  out.t = out.durations = VectorXd::Zero(rows);
  out.q = out.qd = out.told_q = out.told_qd = RowMatrixXd::Zero(rows, d);
  out.tension = out.command = out.asked = RowMatrixXd::Zero(rows, c);
  for (const SensorChannel& one : loop.sensors()) {
    out.told.emplace_back(RowMatrixXd::Zero(rows, one.value().size()));
  }
  const Estimator* const estimator = loop.estimator();
  const Index more = estimator == nullptr ? 0 : static_cast<Index>(estimator->value_names().size());
  out.estimated = out.deviations = RowMatrixXd::Zero(rows, more);
  out.innovation = out.measured = VectorXd::Zero(rows);
  const auto followed = static_cast<Index>(loop.controller().reference_names().size());
  out.reference = RowMatrixXd::Zero(rows, followed);
  VectorXd tension(c), q(d), qd(d), values(more), deviations(more), reference(followed);
  out.status = loop.status();
  Index row = 0;
  for (Index k = 0; out.status == Status::ok && k <= steps; ++k) {
    const bool records = k % record_every == 0;
    const double t = loop.time();
    q = loop.q();
    qd = loop.qd();
    if (k < steps) out.status = loop.step(wrenches, stop);
    if (stop && k % 256 == 255 && stop()) out.status = Status::interrupted;
    if (!records) continue;
    out.t[row] = t;
    out.q.row(row) = q;
    out.qd.row(row) = qd;
    out.command.row(row) = loop.given();
    out.asked.row(row) = loop.asked();
    out.told_q.row(row) = loop.told_q();
    out.told_qd.row(row) = loop.told_qd();
    for (std::size_t i = 0; i < out.told.size(); ++i) {
      out.told[i].row(row) = loop.sensors()[i].value();
    }
    cable_tensions(model, q, qd, loop.given(), tension);
    out.tension.row(row) = tension;
    loop.controller().write_reference(reference);
    out.reference.row(row) = reference;
    out.durations[row] = loop.controller().diagnostics().duration;
    if (estimator != nullptr) {
      estimator->write_values(values, deviations);
      out.estimated.row(row) = values;
      out.deviations.row(row) = deviations;
      out.innovation[row] = estimator->diagnostics().innovation;
      out.measured[row] = static_cast<double>(estimator->diagnostics().measured);
    }
    ++row;
  }
  out.stats.steps = static_cast<long>(loop.plant().periods()) * loop.options().substeps;
  const bool implicit = loop.options().method == Method::rosenbrock;
  out.stats.evaluations = (implicit ? 2 : 4) * out.stats.steps;
  out.stats.jacobians = implicit ? out.stats.steps : 0;
  if (out.status != Status::ok) {
    out.message = detail::sentence("stopped at t = ", loop.time(), " s: ", message(out.status));
  }
  if (row == rows) return out;
  out.t.conservativeResize(row);
  for (VectorXd* column : {&out.durations, &out.innovation, &out.measured}) {
    column->conservativeResize(row);
  }
  for (RowMatrixXd* table : {&out.q, &out.qd, &out.told_q, &out.told_qd, &out.tension, &out.command,
                             &out.asked, &out.reference, &out.estimated, &out.deviations}) {
    table->conservativeResize(row, Eigen::NoChange);
  }
  for (RowMatrixXd& table : out.told) table.conservativeResize(row, Eigen::NoChange);
  return out;
}

}  // namespace cdcr
