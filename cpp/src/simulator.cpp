#include "cdcr/simulator.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "cdcr/plant.hpp"
#include "rk4.hpp"

namespace cdcr {

struct Simulator::Stages : detail::Rk4Stages {
  using Rk4Stages::Rk4Stages;
};

Simulator::Simulator(const Model& model, double step, int substeps)
    : model_(model),
      data_(model),
      period_(step),
      substeps_(substeps),
      stages_(std::make_unique<Stages>(2 * model.num_coordinates())) {
  require_inertia(model);
  if (!(step > 0.0) || !std::isfinite(step)) {
    std::ostringstream text;
    text << "step must be > 0 s and finite, got " << step;
    throw std::invalid_argument(text.str());
  }
  if (substeps < 1) {
    throw std::invalid_argument("substeps must be at least 1, got " + std::to_string(substeps));
  }
  force_ = VectorXd::Zero(model.num_coordinates());
  q_ = qd_ = force_;
  y_ = trial_ = VectorXd::Zero(2 * model.num_coordinates());
}

Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;

void Simulator::reset(const VectorXd& q, const VectorXd& qd, double time) {
  const Index m = model_.num_coordinates();
  const auto check = [m](const VectorXd& v, const char* item) {
    if (v.size() == m && v.allFinite()) return;
    std::ostringstream text;
    text << item << " must be " << m << " finite values, got [" << v.transpose() << "]";
    throw std::invalid_argument(text.str());
  };
  check(q, "q");
  check(qd, "qd");
  if (!std::isfinite(time)) {
    throw std::invalid_argument("time must be finite, got " + std::to_string(time));
  }
  for (Index i = 0; i < m; i += 2) {
    if (q.segment<2>(i).norm() > max_bending) {
      std::ostringstream text;
      text << "q must bend each section by at most 3 pi rad, got [" << q.transpose() << "]";
      throw std::invalid_argument(text.str());
    }
  }
  q_ = q;
  qd_ = qd;
  y_ << q, qd;
  start_ = time_ = time;
  periods_ = 0;
  started_ = true;
}

Status Simulator::step(const ConstVectorRef& tension) noexcept {
  return step(tension, no_wrenches());
}

Status Simulator::step(const ConstVectorRef& tension, const Wrenches& wrenches) noexcept {
  if (!started_) return Status::not_started;
  const Status tension_status = check_tension(model_, tension);
  if (tension_status != Status::ok) return tension_status;

  const Index m = model_.num_coordinates();
  const bool force_holds = model_.has_plain_cables() && wrenches.empty();
  if (force_holds) cable_force(model_, q_, qd_, tension, force_);
  const auto f = [&](double /*t*/, const double* y, double* dydt) {
    const Eigen::Map<const VectorXd> q(y, m), qd(y + m, m);
    Eigen::Map<VectorXd> rate(dydt, m), qdd(dydt + m, m);
    rate = qd;
    if (!force_holds) {
      cable_force(model_, q, qd, tension, force_);
      add_wrench_force(model_, q, wrenches, force_);
    }
    forward_dynamics_force(model_, data_, q, qd, force_, qdd);
  };
  const double h = period_ / substeps_;
  y_.head(m) = q_;
  y_.tail(m) = qd_;
  for (int i = 0; i < substeps_; ++i) {
    f(0.0, y_.data(), stages_->k1.data());
    stages_->step(f, 0.0, h, y_, trial_);
    const Status status = check_state(model_, trial_);
    if (status != Status::ok) {
      const auto check = [this, m](const double* y) {
        return check_state(model_, Eigen::Map<const VectorXd>(y, 2 * m));
      };
      return stages_->why(status, check, f, 0.0, h, y_, trial_);
    }
    y_.swap(trial_);
  }
  q_ = y_.head(m);
  qd_ = y_.tail(m);
  ++periods_;
  time_ = start_ + static_cast<double>(periods_) * period_;
  return Status::ok;
}

}  // namespace cdcr
