#include "cdcr/simulator.hpp"

#include <cmath>
#include <optional>

#include "cdcr/cable_friction.hpp"
#include "cdcr/linearization.hpp"
#include "cdcr/robot_ode.hpp"
#include "dynamics/bending.hpp"
#include "integration/rk4.hpp"
#include "integration/rosenbrock.hpp"
#include "loads/total_force.hpp"

namespace cdcr {

struct Simulator::Stages {
  Stages(const Model& model, Method method)
      : slope(2 * model.num_coordinates() + model.num_deflections()), rk4(slope.size()) {
    if (method == Method::rosenbrock) rosenbrock.emplace(slope.size(), model.num_coordinates());
  }

  VectorXd slope;
  detail::Rk4Stages rk4;
  std::optional<detail::RosenbrockStages> rosenbrock;
};

Simulator::Simulator(const Model& model, double step, int substeps, Method method)
    : model_(model),
      data_(model),
      period_(step),
      substeps_(substeps),
      method_(method),
      stages_(std::make_unique<Stages>(model, method)) {
  require_inertia(model);
  detail::require_positive("step", step, "s");
  detail::require(substeps >= 1, "substeps must be at least 1, got ", substeps);
  detail::require(method == Method::rk4 || method == Method::rosenbrock,
                  "method of a simulator must be rk4 or rosenbrock, whose steps are fixed");
  detail::require(method == Method::rk4 || model.num_deflections() == 0,
                  "method of a simulator must be rk4 where the friction of cables remembers "
                  "(presliding_stiffness)");
  force_ = VectorXd::Zero(model.num_coordinates());
  q_ = qd_ = force_;
  deflection_ = VectorXd::Zero(model.num_deflections());
  felt_ = felt_trial_ = VectorXd::Zero(model.num_cables());
  y_ = trial_ = VectorXd::Zero(2 * model.num_coordinates() + model.num_deflections());
}

Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;

void Simulator::reset(const VectorXd& q, const VectorXd& qd, double start, long long periods) {
  const Index m = model_.num_coordinates();
  detail::require_finite("q", q, m);
  detail::require_finite("qd", qd, m);
  detail::require(std::isfinite(start), "time must be finite, got ", start);
  detail::require_bending("q", model_, q);
  q_ = q;
  qd_ = qd;
  deflection_.setZero();
  rest_command(model_, felt_);
  start_ = start;
  set_clock(periods);
  started_ = true;
}

void Simulator::set_memory(const VectorXd& deflection, const VectorXd& felt) {
  detail::require_finite("deflection", deflection, model_.num_deflections());
  detail::require_finite("felt", felt, model_.num_cables());
  deflection_ = deflection;
  felt_ = felt;
}

void Simulator::set_clock(long long periods) noexcept {
  periods_ = periods;
  time_ = start_ + static_cast<double>(periods_) * period_;
}

Status Simulator::step(const ConstVectorRef& tension) noexcept {
  return step(tension, no_wrenches());
}

Status Simulator::step(const ConstVectorRef& tension, const Wrenches& wrenches) noexcept {
  return step(tension, wrenches, Interrupt());
}

Status Simulator::step(const ConstVectorRef& tension, const Wrenches& wrenches,
                       const Interrupt& stop) noexcept {
  if (!started_) return Status::not_started;
  const Status tension_status = check_tension(model_, tension);
  if (tension_status != Status::ok) return tension_status;
  const Status wrench_status = check_wrenches(model_, wrenches);
  if (wrench_status != Status::ok) return wrench_status;

  const Index m = model_.num_coordinates();
  const bool force_holds = force_is_constant(model_, wrenches);
  const bool remembers = model_.num_deflections() > 0;
  felt_trial_ = felt_;
  follow_with_play(model_, tension, felt_trial_);
  if (force_holds) total_force(model_, q_, qd_, tension, wrenches, force_);
  const auto f = [&](double /*t*/, const double* y, double* dydt) {
    const Eigen::Map<const VectorXd> q(y, m), qd(y + m, m);
    Eigen::Map<VectorXd> rate(dydt, m), qdd(dydt + m, m);
    rate = qd;
    if (remembers) {
      detail::total_force(model_, y, y + m, felt_trial_.data(), y + 2 * m, wrenches, force_.data(),
                          dydt + 2 * m);
    } else if (!force_holds) {
      total_force(model_, q, qd, felt_trial_, wrenches, force_);
    }
    forward_dynamics_force(model_, data_, q, qd, force_, qdd);
  };
  const auto check = [&](const double* y) {
    return check_state(model_, Eigen::Map<const VectorXd>(y, 2 * m));
  };
  VectorXd& slope = stages_->slope;
  const auto make_step = [&](double h) {
    f(0.0, y_.data(), slope.data());
    if (!stages_->rosenbrock) {
      stages_->rk4.step(f, 0.0, h, y_, slope, trial_);
      const Status status = check(trial_.data());
      if (status == Status::ok) return status;
      return stages_->rk4.failure_status(status, check, f, 0.0, h, y_, slope, trial_);
    }
    detail::RosenbrockStages& stages = *stages_->rosenbrock;
    state_jacobian(model_, data_, y_.head(m), y_.tail(m), felt_trial_, wrenches, stages.jacobian);
    stages.step(f, 0.0, h, y_, slope, trial_);
    return stages.status_after(check, trial_);
  };
  y_.head(m) = q_;
  y_.segment(m, m) = qd_;
  y_.tail(deflection_.size()) = deflection_;
  for (int i = 0; i < substeps_; ++i) {
    const Status status = make_step(period_ / substeps_);
    if (status != Status::ok) return status;
    y_.swap(trial_);
    constexpr int substeps_between_stops = 256;
    if (i % substeps_between_stops == substeps_between_stops - 1 && stop && stop()) {
      return Status::interrupted;
    }
  }
  q_ = y_.head(m);
  qd_ = y_.segment(m, m);
  deflection_ = y_.tail(deflection_.size());
  felt_ = felt_trial_;
  set_clock(periods_ + 1);
  return Status::ok;
}

}  // namespace cdcr
