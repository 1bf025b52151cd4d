#include "cdcr/simulator.hpp"

#include <cmath>
#include <optional>

#include "cdcr/linearization.hpp"
#include "cdcr/robot_ode.hpp"
#include "dynamics/bending.hpp"
#include "integration/rk4.hpp"
#include "integration/rosenbrock.hpp"

namespace cdcr {

struct Simulator::Stages {
  Stages(Index num_states, Method method) : slope(num_states), rk4(num_states) {
    if (method == Method::rosenbrock) rosenbrock.emplace(num_states);
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
      stages_(std::make_unique<Stages>(2 * model.num_coordinates(), method)) {
  require_inertia(model);
  detail::require_positive("step", step, "s");
  detail::require(substeps >= 1, "substeps must be at least 1, got ", substeps);
  detail::require(method == Method::rk4 || method == Method::rosenbrock,
                  "method of a simulator must be rk4 or rosenbrock, whose steps are fixed");
  force_ = VectorXd::Zero(model.num_coordinates());
  q_ = qd_ = force_;
  y_ = trial_ = VectorXd::Zero(2 * model.num_coordinates());
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
  y_ << q, qd;
  start_ = start;
  set_clock(periods);
  started_ = true;
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
  if (force_holds) total_force(model_, q_, qd_, tension, wrenches, force_);
  const auto f = [&](double /*t*/, const double* y, double* dydt) {
    const Eigen::Map<const VectorXd> q(y, m), qd(y + m, m);
    Eigen::Map<VectorXd> rate(dydt, m), qdd(dydt + m, m);
    rate = qd;
    if (!force_holds) total_force(model_, q, qd, tension, wrenches, force_);
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
    state_jacobian(model_, data_, y_.head(m), y_.tail(m), tension, wrenches, stages.jacobian);
    stages.step(f, 0.0, h, y_, slope, trial_);
    return stages.status_after(check, trial_);
  };
  y_.head(m) = q_;
  y_.tail(m) = qd_;
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
  qd_ = y_.tail(m);
  set_clock(periods_ + 1);
  return Status::ok;
}

}  // namespace cdcr
