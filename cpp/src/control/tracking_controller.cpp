#include "cdcr/tracking_controller.hpp"

#include <chrono>
#include <limits>
#include <utility>

#include "base/rotation.hpp"
#include "base/sizes.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/robot_ode.hpp"

namespace cdcr {
namespace {

/// A reference of the tip in the shape at rest.
VectorXd tip_at_rest(const Model& model, bool with_orientation) {
  const Pose at = tip(model, model.rest());
  if (!with_orientation) return at.p;
  VectorXd value(6);
  value << at.p, detail::rotation_vector(at.R);
  return value;
}

/// How far from its base the tip can be: the length of the backbone and the tool's place; no bound
/// where sections stretch.
double reach_of(const Model& model) {
  const Robot& robot = model.robot();
  double reach = robot.tool.topRightCorner<3, 1>().norm();
  for (const Section& section : robot.sections) {
    if (section.stretch_order >= 0) return std::numeric_limits<double>::infinity();
    reach += section.length;
  }
  return reach;
}

}  // namespace

TrackingController::TrackingController(const Model& model, double period, CommandLimits limits,
                                       Follows follows)
    : limits_(std::move(limits)),
      follows_(follows),
      drive_(model, limits_.tension, limits_.max_rate, period),
      path_(ReferencePath::constant(follows == Follows::coordinates
                                        ? model.rest()
                                        : tip_at_rest(model, follows == Follows::pose))),
      setpoint_(path_.size()) {
  path_.evaluate(path_.start(), setpoint_);
}

void TrackingController::set_path(const ReferencePath& path) {
  accept(path);
  path_ = path;
  path_.evaluate(path_.start(), setpoint_);
}

VectorXd TrackingController::memory() const {
  VectorXd memory(1 + num_cables());
  memory << (drive_.has_command() ? 1.0 : 0.0), drive_.command();
  return memory;
}

void TrackingController::set_memory(const VectorXd& memory) {
  detail::require_finite("memory", memory, 1 + num_cables());
  drive_.hold(memory.tail(num_cables()));
  if (memory[0] == 0.0) drive_.reset();
}

void TrackingController::accept(const ReferencePath& path) {
  constexpr int looks = 256;      // along a path
  constexpr double slack = 1e-9;  // of the straight robot's tip, whose place is rounded
  const double farthest = reach_of(model()) * (1.0 + slack);
  Setpoint at(path.size());
  for (int i = 0; i <= (path.is_constant() ? 0 : looks); ++i) {
    path.evaluate(path.start() + (path.end() - path.start()) * i / looks, at);
    const bool sound = path.size() == path_.size() && at.value.allFinite();
    if (follows_ != Follows::coordinates) {
      const bool position = follows_ == Follows::position;
      detail::require(sound, "reference must be ",
                      position ? "3 finite values [m]"
                               : "6 finite values, a position [m] and a "
                                 "rotation vector [rad]",
                      ", got [", at.value.transpose(), "]");
      const Vector3d place = at.value.head<3>();
      const double away = (place - model().robot().base_position).norm();
      detail::require(away <= farthest, "reference must be at most ", farthest,
                      " m from the base, as far as the tip reaches, got [", place.transpose(),
                      "], which is ", away, " m away");
      continue;
    }
    detail::require(sound && check_shape(model(), at.value) == Status::ok, "reference must be ",
                    model().num_coordinates(),
                    " finite values that bend each section by at most 3 pi rad, got [",
                    at.value.transpose(), "]");
  }
}

std::vector<std::string> TrackingController::reference_names() const {
  if (follows_ == Follows::coordinates) return model().coordinate_names();
  if (follows_ == Follows::position) return {"tip_x", "tip_y", "tip_z"};
  return {"tip_x", "tip_y", "tip_z", "rotation_x", "rotation_y", "rotation_z"};
}

void TrackingController::reset() noexcept {
  drive_.reset();
  diagnostics_ = {};
}

Status TrackingController::update(double t, const ConstVectorRef& q, const ConstVectorRef& qd,
                                  VectorRef command) noexcept {
  const bool fits = detail::of_coordinates(model(), q, qd) && detail::of_cables(model(), command);
  if (!fits) return Status::wrong_size;
  const auto begin = std::chrono::steady_clock::now();
  ++diagnostics_.updates;
  Status status = Status::non_finite_state;
  if (q.allFinite() && qd.allFinite()) {
    path_.evaluate(t, setpoint_);
    status = control(t, q, qd, setpoint_);
  }
  if (status == Status::ok && !drive_.command().allFinite()) status = Status::non_finite_state;
  if (status == Status::ok) command = drive_.command();
  diagnostics_.limited = drive_.num_limited();
  diagnostics_.duration =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return status;
}

bool TrackingController::give(const ConstVectorRef& q, const ConstVectorRef& qd,
                              const ConstVectorRef& force) noexcept {
  return note(drive_.solve(q, qd, force), force);
}

bool TrackingController::give(const ConstVectorRef& q, const ConstVectorRef& qd,
                              const ConstVectorRef& force,
                              const ConstVectorRef& preferred) noexcept {
  return note(drive_.solve(q, qd, force, preferred), force);
}

bool TrackingController::note(bool met, const ConstVectorRef& force) noexcept {
  diagnostics_.missing = met ? 0.0 : (force - drive_.force()).norm();
  return met;
}

}  // namespace cdcr
