#include "cdcr/kalman_filter.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "base/sizes.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/robot_ode.hpp"
#include "control/measurement.hpp"
#include "control/same_robot.hpp"
#include "control/steps.hpp"
#include "estimation/kalman_parts.hpp"
#include "estimation/memory.hpp"

namespace cdcr {
namespace {

using detail::require;
using detail::require_not_negative;

constexpr int most_substeps = 10000;  // an update does not look for interrupts

Index periods_late(const Sensor& sensor, double period, const std::string& item = "") {
  return detail::whole_steps(item.c_str(), sensor.delay, period, 0);
}

Index latest(const KalmanOptions& options) {
  Index late = 0;
  for (const Sensor& sensor : options.sensors) {
    late = std::max(late, periods_late(sensor, options.period));
  }
  return late;
}

bool same(const Place& a, const Place& b) noexcept {
  return a.section == b.section && a.fraction == b.fraction;
}

void check_sensors(const Model& model, const KalmanOptions& options) {
  require(!options.sensors.empty(), "an estimator needs sensors");
  for (std::size_t i = 0; i < options.sensors.size(); ++i) {
    const Sensor& sensor = options.sensors[i];
    const std::string name = "sensor " + std::to_string(i + 1);
    require(sensor.noise > 0.0, "noise of ", name, " must be > 0 for an estimator, got ",
            sensor.noise);
    detail::require_sensor(model, sensor, name);
    (void)periods_late(sensor, options.period, "delay of " + name + ", for an estimator,");
    if (sensor.period != 0.0) {
      const std::string item = "period of " + name + ", for an estimator,";
      (void)detail::whole_steps(item.c_str(), sensor.period, options.period, 1);
    }
  }
}

void check_variants(const Model& model, const KalmanOptions& options) {
  for (std::size_t k = 0; k < options.variants.size(); ++k) {
    const Model& variant = options.variants[k];
    require(
        detail::of_coordinates(variant, model.rest()) && variant.num_cables() == model.num_cables(),
        "variant ", k + 1, " must have ", model.num_coordinates(), " coordinates and ",
        model.num_cables(), " cables as the model has, got ", variant.num_coordinates(), " and ",
        variant.num_cables());
    for (std::size_t j = 0; j < model.cables().size(); ++j) {
      const bool by_length = variant.cables()[j].length_driven();
      const char* const drives[] = {"tension", "length"};
      require(by_length == model.cables()[j].length_driven(), "cable ", j + 1, " of variant ",
              k + 1, " must be driven by ", drives[by_length ? 0 : 1],
              " as the model's, got one driven by ", drives[by_length ? 1 : 0]);
    }
    require_inertia(variant);
  }
}

/// Of qd, force and shares.
VectorXd densities(const Model& model, const KalmanOptions& options) {
  require_inertia(model);
  detail::require_positive("period", options.period, "s");
  require(options.substeps >= 1 && options.substeps <= most_substeps, "substeps must be 1 to ",
          most_substeps, ", got ", options.substeps);
  check_sensors(model, options);
  check_variants(model, options);
  const Index d = model.num_coordinates(), forces = options.force_at ? 3 : 0;
  const VectorXd& noise = options.acceleration_noise;
  require((noise.size() == 1 || noise.size() == d) && noise.allFinite() && noise.minCoeff() >= 0.0,
          "acceleration_noise must be one value, or ", d, ", >= 0 rad/s^1.5, got ",
          detail::Listed{noise});
  require_not_negative("force_noise", options.force_noise, "N/s^0.5");
  require_not_negative("share_noise", options.share_noise, "1/s^0.5");
  require_not_negative("deviation", options.deviation, "rad");
  require_not_negative("rate_deviation", options.rate_deviation, "rad/s");
  require_not_negative("force_deviation", options.force_deviation, "N");
  require_not_negative("share_deviation", options.share_deviation, "1");
  if (options.start.size() != 0) {
    detail::require_finite("start", options.start, d);
    require_shape("start", model, options.start);
  }
  if (options.force_at) {
    const Place& at = *options.force_at;
    require(detail::is_section(model, at.section) && detail::is_fraction(at.fraction),
            "force_at must be a section 0 to ", model.num_sections() - 1,
            " and a fraction 0 to 1, got section ", at.section, " and fraction ", at.fraction);
  }
  VectorXd root(d + forces + static_cast<Index>(options.variants.size()));
  root << (noise.size() == d ? noise : VectorXd::Constant(d, noise[0])),
      VectorXd::Constant(forces, options.force_noise),
      VectorXd::Constant(root.size() - d - forces, options.share_noise);
  return root.cwiseAbs2();
}

}  // namespace

void Estimator::require_fit(const Model& /*model*/, const std::vector<Sensor>& sensors) const {
  require(!sensors.empty(), "an estimator needs sensors");
}

KalmanFilter::Parts::Parts(const Model& model, const KalmanOptions& options,
                           const VectorXd& density)
    : motion(model, options.variants, options.force_at, options.period, options.substeps),
      transition(model.num_coordinates(), density, options.period, options.substeps),
      actuators(model, options.actuators, options.period),
      commands(model.num_cables(), latest(options)),
      late(latest(options)) {
  for (const Sensor& sensor : options.sensors) {
    sensors.emplace_back(motion, sensor);
    waiting.emplace_back(sensors.back().value().size(),
                         late - periods_late(sensor, options.period));
  }
  given = tension = due = VectorXd::Zero(model.num_cables());
  between = VectorXd::Zero(motion.size());
  slopes = MatrixXd::Zero(model.num_coordinates(), motion.size());
}

KalmanFilter::KalmanFilter(const Model& model, KalmanOptions options)
    : options_(std::move(options)),
      parts_(std::make_unique<Parts>(model, options_, densities(model, options_))) {
  const Index size = parts_->motion.size();
  x_ = head_ = VectorXd::Zero(size);
  P_ = MatrixXd::Zero(size, size);
}

KalmanFilter::~KalmanFilter() = default;
KalmanFilter::KalmanFilter(KalmanFilter&&) noexcept = default;

const Model& KalmanFilter::model() const noexcept {
  return parts_->motion.model();
}

Index KalmanFilter::measurement_size(std::size_t sensor) const noexcept {
  return parts_->sensors[sensor].value().size();
}

void KalmanFilter::require_robot(const Model& model) const {
  detail::require_sizes("the estimator", this->model().num_coordinates(),
                        this->model().num_cables(), model);
  detail::require_drives("the estimator expects cables driven by ", this->model(), model);
}

void KalmanFilter::require_fit(const Model& model, const std::vector<Sensor>& sensors) const {
  require_robot(model);
  bool alike = sensors.size() == options_.sensors.size();
  for (std::size_t i = 0; alike && i < sensors.size(); ++i) {
    const Sensor &a = sensors[i], &b = options_.sensors[i];
    alike = a.kind == b.kind && a.delay == b.delay && a.period == b.period &&
            std::equal(a.places.begin(), a.places.end(), b.places.begin(), b.places.end(), same);
  }
  require(alike, "the estimator hears ", options_.sensors.size(),
          " sensors, which must be of the same kinds, places, periods and delays as those of the "
          "loop, in the same order");
}

void KalmanFilter::reset(const ConstVectorRef& q, const ConstVectorRef& qd,
                         const ConstVectorRef& command) noexcept {
  const Index d = model().num_coordinates(), forces = parts_->motion.num_forces();
  x_.setZero();
  x_.head(d) = q;
  x_.segment(d, d) = qd;
  if (options_.start.size() != 0) {
    x_.head(d) = options_.start;
    x_.segment(d, d).setZero();
  }
  head_ = x_;
  P_.setZero();
  auto variance = P_.diagonal();
  variance.head(d).setConstant(options_.deviation * options_.deviation);
  variance.segment(d, d).setConstant(options_.rate_deviation * options_.rate_deviation);
  variance.segment(2 * d, forces).setConstant(options_.force_deviation * options_.force_deviation);
  variance.tail(parts_->motion.num_shares())
      .setConstant(options_.share_deviation * options_.share_deviation);
  parts_->actuators.reset(command);
  for (Parts::Waiting& one : parts_->waiting) std::fill(one.held.begin(), one.held.end(), 0);
  parts_->updates = 0;
  diagnostics_ = {};
}

bool KalmanFilter::fits(const std::vector<Measurement>& told, const ConstVectorRef& command,
                        const ConstVectorRef& q, const ConstVectorRef& qd) const noexcept {
  bool sound = detail::of_coordinates(model(), q, qd) && detail::of_cables(model(), command) &&
               told.size() == parts_->sensors.size();
  for (std::size_t i = 0; sound && i < told.size(); ++i) {
    sound = told[i].value.size() == parts_->sensors[i].value().size();
  }
  return sound;
}

Status KalmanFilter::update(double /*t*/, const std::vector<Measurement>& told,
                            const ConstVectorRef& command, VectorRef q, VectorRef qd) noexcept {
  if (parts_->updates < 0) return Status::not_started;
  if (!fits(told, command, q, qd)) return Status::wrong_size;
  const auto begin = std::chrono::steady_clock::now();
  ++diagnostics_.updates;
  diagnostics_.innovation = 0.0;
  diagnostics_.measured = 0;
  const Status status = advance(told, command);
  if (status == Status::ok) {
    q = head_.head(q.size());
    qd = head_.segment(q.size(), q.size());
  }
  diagnostics_.duration =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return status;
}

/// Goes on by a period as far behind as the latest sensor is, then reckons to now.
Status KalmanFilter::advance(const std::vector<Measurement>& told,
                             const ConstVectorRef& command) noexcept {
  Parts& p = *parts_;
  const Index d = model().num_coordinates();
  const long long now = p.updates++, then = now - p.late;
  if (now > 0) {
    cable_tensions(model(), head_.head(d), head_.segment(d, d), p.actuators.given(), p.tension);
    p.actuators.step(command, p.tension);
  }
  p.commands.columns.col(p.commands.at(now)) = p.actuators.given();
  for (std::size_t i = 0; i < told.size(); ++i) {
    Parts::Waiting& one = p.waiting[i];
    const Index at = one.at(now);
    one.columns.col(at) = told[i].value;
    one.held[static_cast<std::size_t>(at)] = told[i].fresh ? 1 : 0;
  }
  p.given = p.commands.columns.col(p.commands.at(std::max(then, 0LL)));
  if (then > 0) predict(p.given);
  p.motion.forget_base();
  for (std::size_t i = 0; then >= 0 && i < told.size(); ++i) {
    Parts::Waiting& one = p.waiting[i];
    const Index at = one.at(now + 1);  // the oldest
    if (one.held[static_cast<std::size_t>(at)] == 0) continue;
    correct(i, one.columns.col(at), p.given);
  }
  head_ = x_;
  for (long long k = std::max(then, 0LL) + 1; k <= now; ++k) {
    p.due = p.commands.columns.col(p.commands.at(k));
    p.motion.advance(head_, p.due, p.between);
    head_.swap(p.between);
  }
  const bool finite = head_.allFinite() && P_.allFinite();
  return finite ? check_state(model(), head_.head(2 * d)) : Status::non_finite_state;
}

template <class Self, class Visit>
void KalmanFilter::visit_memory(Self& self, Visit& visit) {
  Parts& parts = *self.parts_;
  visit(self.x_);
  visit(self.P_);
  visit(self.head_);
  Actuators::visit_memory(parts.actuators, visit);
  for (Parts::Waiting& one : parts.waiting) {
    visit(one.columns);
    visit(one.held);
  }
  visit(parts.commands.columns);
  visit(parts.updates);
}

VectorXd KalmanFilter::memory() const {
  detail::MemoryWriter writer;
  visit_memory(*this, writer);
  return writer.memory();
}

void KalmanFilter::set_memory(const VectorXd& memory) {
  detail::MemoryReader reader(memory, this->memory().size());
  visit_memory(*this, reader);
}

void KalmanFilter::note(double innovation, Index measured) noexcept {
  diagnostics_.innovation += innovation;
  diagnostics_.measured += measured;
}

std::vector<std::string> KalmanFilter::value_names() const {
  std::vector<std::string> names;
  if (parts_->motion.num_forces() > 0) names = {"force_x", "force_y", "force_z"};
  for (Index i = 0; i < parts_->motion.num_shares(); ++i) {
    names.push_back(detail::sentence("share_", i + 1));
  }
  return names;
}

void KalmanFilter::write_values(VectorRef values, VectorRef deviations) const noexcept {
  values = head_.tail(values.size());
  deviations = P_.diagonal().tail(values.size()).cwiseMax(0.0).cwiseSqrt();
}

}  // namespace cdcr
