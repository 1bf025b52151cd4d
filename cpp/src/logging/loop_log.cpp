#include "cdcr/loop_log.hpp"

#include <algorithm>
#include <string>

#include "base/arguments.hpp"
#include "cdcr/cables.hpp"
#include "cdcr/kinematics.hpp"

namespace cdcr {
namespace {

using Names = std::vector<std::string>;

/// Of a coordinate, or of the tip's position: stretches e1, ... are lengths too.
std::string unit_of(const std::string& name) {
  return name[0] == 'e' || name.find("tip") == 0 ? "m" : "rad";
}

const char* unit_of(Sensor::Kind kind) {
  if (kind == Sensor::Kind::tensions) return "N";
  if (kind == Sensor::Kind::lengths || kind == Sensor::Kind::tip) return "m";
  if (kind == Sensor::Kind::curvature) return "1/m";
  if (kind == Sensor::Kind::orientation) return "rad";
  return "SI";
}

bool has_lengths(const Model& model) {
  const auto& cables = model.cables();
  return std::any_of(cables.begin(), cables.end(),
                     [](const Cable& c) { return c.length_driven(); });
}

/// The columns of a loop, in the order in which LoopLog::end writes them.
class Columns {
 public:
  explicit Columns(const Loop& loop) : model_(loop.plant().model()) {
    add("t", "s", "");
    add_state("", "state");
    const std::string command = has_lengths(model_) ? "N or m" : "N";
    add_many("tension", model_.num_cables(), "N", "tension");
    if (has_lengths(model_)) add_many("command", model_.num_cables(), command, "tension");
    add_many("asked", model_.num_cables(), command, "tension");
    for (const char* axis : {"tip_x", "tip_y", "tip_z"}) add(axis, "m", "tip");
    for (std::size_t i = 0; i < loop.sensors().size(); ++i) {
      const SensorChannel& one = loop.sensors()[i];
      const std::string name = "sensor" + std::to_string(i + 1);
      add_many(name + "_", one.value().size(), unit_of(one.sensor().kind), "sensors");
    }
    add_state("told_", "estimate");
    for (const std::string& name : loop.controller().reference_names()) {
      add("reference_" + name, unit_of(name), "reference");
    }
    if (loop.estimator() != nullptr) add_estimated(loop.estimator()->value_names());
    add("status", "1", "timing");
    add("duration", "s", "timing");
    add("step_duration", "s", "timing");
  }

  [[nodiscard]] const std::vector<LogColumn>& all() const { return columns_; }

 private:
  void add(const std::string& name, const std::string& unit, const std::string& topic) {
    columns_.push_back({name, unit, topic});
  }
  void add_many(const std::string& name, Index count, const std::string& unit,
                const std::string& topic) {
    for (Index i = 1; i <= count; ++i) add(name + std::to_string(i), unit, topic);
  }
  /// q1_x and its rate qd1_x.
  void add_state(const std::string& before, const std::string& topic) {
    const Names names = model_.coordinate_names();
    for (const std::string& name : names) add(before + name, unit_of(name), topic);
    for (const std::string& name : names) {
      add(before + name[0] + "d" + name.substr(1), unit_of(name) + "/s", topic);
    }
  }
  void add_estimated(const Names& names) {
    for (const std::string& name : names) add("estimated_" + name, "SI", "estimate");
    for (const std::string& name : names) add("deviation_" + name, "SI", "estimate");
    add("innovation", "1", "estimate");
    add("measured", "1", "estimate");
  }

  const Model& model_;
  std::vector<LogColumn> columns_;
};

/// Fills a row from a place on.
class Filler {
 public:
  Filler(VectorXd& row, Index from) : row_(row), at_(from) {}
  void put(const ConstVectorRef& values) noexcept {
    row_.segment(at_, values.size()) = values;
    at_ += values.size();
  }
  void put(double value) noexcept { row_[at_++] = value; }

 private:
  VectorXd& row_;
  Index at_;
};

}  // namespace

LoopLog::LoopLog(const Loop& loop, Index capacity)
    : Log(Columns(loop).all(), capacity),
      row_(VectorXd::Zero(static_cast<Index>(columns().size()))),
      tension_(loop.given()),
      reference_(VectorXd::Zero(static_cast<Index>(loop.controller().reference_names().size()))),
      has_lengths_(has_lengths(loop.plant().model())) {
  const Estimator* const estimator = loop.estimator();
  const std::size_t more = estimator == nullptr ? 0 : estimator->value_names().size();
  values_ = deviations_ = VectorXd::Zero(static_cast<Index>(more));
}

void LoopLog::require_fit(const Loop& loop) const {
  const auto same = [](const LogColumn& a, const LogColumn& b) { return a.name == b.name; };
  const std::vector<LogColumn> theirs = Columns(loop).all();
  detail::require(
      std::equal(columns().begin(), columns().end(), theirs.begin(), theirs.end(), same),
      "the log was made for another loop: its columns are not those of this one");
}

void LoopLog::begin(const Loop& loop) noexcept {
  Filler row(row_, 0);
  row.put(loop.time());
  row.put(loop.q());
  row.put(loop.qd());
  start_ = std::chrono::steady_clock::now();
}

void LoopLog::end(const Loop& loop) noexcept {
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start_;
  const Model& model = loop.plant().model();
  const Index d = model.num_coordinates();
  const auto q = row_.segment(1, d), qd = row_.segment(1 + d, d);
  Filler row(row_, 1 + 2 * d);
  cable_tensions(model, q, qd, loop.given(), tension_);
  row.put(tension_);
  if (has_lengths_) row.put(loop.given());
  row.put(loop.asked());
  row.put(tip(model, q).p);
  for (const SensorChannel& one : loop.sensors()) row.put(one.value());
  row.put(loop.told_q());
  row.put(loop.told_qd());
  loop.controller().write_reference(reference_);
  row.put(reference_);
  if (const Estimator* const estimator = loop.estimator()) {
    estimator->write_values(values_, deviations_);
    row.put(values_);
    row.put(deviations_);
    row.put(estimator->diagnostics().innovation);
    row.put(static_cast<double>(estimator->diagnostics().measured));
  }
  row.put(static_cast<double>(loop.status()));
  row.put(loop.controller().diagnostics().duration);
  row.put(took.count());
  (void)push(row_);
}

}  // namespace cdcr
