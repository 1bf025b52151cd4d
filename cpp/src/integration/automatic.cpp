#include "integration/automatic.hpp"

#include <algorithm>

namespace cdcr::detail {
namespace {

// Steps held back that make a stiff robot, each that was not taking back two.
constexpr int most_held = 15;
// A new start of bdf costs what so many explicit steps cost.
constexpr double least_steps = 100.0;

}  // namespace

Automatic::Automatic(RobotOde& ode, const Options& options, IntegratorFactory factory)
    : ode_(ode),
      options_(options),
      factory_(factory),
      explicit_(ode, options),
      active_(&explicit_) {}

bool Automatic::implicit_pays(double span) const noexcept {
  return factory_ != nullptr && own_.stiff && span > least_steps * held_step_;
}

void Automatic::take_implicit() {
  if (!implicit_) implicit_ = factory_(ode_, Method::bdf, options_);
  if (active_ == &explicit_) ++own_.switches;
  active_ = implicit_.get();
}

Status Automatic::restart(double t, const VectorXd& y, double t_stop) {
  stop_ = t_stop;
  if (implicit_pays(t_stop - t)) {
    take_implicit();
  } else {
    if (active_ != &explicit_) ++own_.switches;
    active_ = &explicit_;
  }
  return active_->restart(t, y, t_stop);
}

Status Automatic::step() {
  if (active_ == &explicit_ && implicit_pays(stop_ - explicit_.time())) {
    take_implicit();
    const Status status = implicit_->restart(explicit_.time(), explicit_.state(), stop_);
    if (status != Status::ok) return status;
  }
  const Status status = active_->step();
  if (status == Status::ok && active_ == &explicit_) watch();
  return status;
}

/// Looks at the step just made. It goes on looking where the robot is known to be stiff: friction
/// that begins to stick makes stable steps shorter.
void Automatic::watch() noexcept {
  if (!explicit_.is_held_by_stability()) {
    held_ = std::max(held_ - 2, 0);
    return;
  }
  held_ = std::min(held_ + 1, most_held);
  const double h = explicit_.last_step();
  held_step_ += held_step_ > 0.0 ? (h - held_step_) / most_held : h;
  if (held_ == most_held && !own_.stiff) own_.stiff = explicit_.time();
}

Stats Automatic::stats() const noexcept {
  Stats all = own_;
  add(all, explicit_.stats());
  if (implicit_) add(all, implicit_->stats());
  all.method = active_ == &explicit_ ? Method::dop853 : Method::bdf;
  return all;
}

}  // namespace cdcr::detail
