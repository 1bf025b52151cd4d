#include "cdcr/rollout.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "cdcr/robot_ode.hpp"
#include "dynamics/bending.hpp"
#include "integration/rollout_lanes.hpp"

namespace cdcr {
namespace {

using detail::require;

/// The n-th of the items of that name, as messages call it: "q0[2] (motion 3)".
std::string nth(const char* item, Index motion) {
  return detail::sentence(item, "[", motion, "] (motion ", motion + 1, ")");
}

void check_motions(const Motions& motions) {
  const Index count = motions.size();
  const auto is_one_or_each = [&](std::size_t size) {
    return size == 1 || (size > 0 && static_cast<Index>(size) == count);
  };
  require(is_one_or_each(motions.models.size()), "models must be one, or one for each of the ",
          count, " motions, got ", motions.models.size());
  const Index d = motions.models.empty() ? 0 : motions.models.front()->num_coordinates();
  const Index c = motions.models.empty() ? 0 : motions.models.front()->num_cables();
  for (std::size_t i = 0; i < motions.models.size(); ++i) {
    const Model& model = *motions.models[i];
    require(model.num_coordinates() == d && model.num_cables() == c, "model ", i + 1, " must have ",
            d, " coordinates and ", c, " cables as the first, got ", model.num_coordinates(),
            " and ", model.num_cables());
    require_inertia(model);
  }
  require(motions.q0.cols() == d && motions.qd0.cols() == d && motions.qd0.rows() == count,
          "q0 and qd0 must have ", d, " columns and as many rows, got ", motions.q0.rows(), " x ",
          motions.q0.cols(), " and ", motions.qd0.rows(), " x ", motions.qd0.cols());
  for (Index i = 0; i < count; ++i) {
    const VectorXd q = motions.q0.row(i);
    const Model& model = motions.model(i);
    if (!q.allFinite()) detail::refuse(nth("q0", i), " must be finite");
    if (!motions.qd0.row(i).allFinite()) detail::refuse(nth("qd0", i), " must be finite");
    if (check_shape(model, q) == Status::ok) continue;
    detail::require_bending(nth("q0", i).c_str(), model, q);
  }
  require(motions.controllers.empty() || static_cast<Index>(motions.controllers.size()) == count,
          "controllers must be one for each of the ", count, " motions, got ",
          motions.controllers.size());
}

void check_commands(const Motions& motions, const RolloutOptions& options) {
  const RolloutCommands& given = motions.commands;
  if (!motions.controllers.empty() || motions.size() == 0) return;
  require(given.data != nullptr || motions.model(0).num_cables() == 0,
          "motions need commands or controllers, got neither");
  const Index all = given.between_motions == 0 ? 1 : motions.size();
  const Index steps = given.between_steps == 0 ? 1 : options.steps;
  for (Index i = 0; i < all; ++i) {
    for (Index k = 0; k < steps; ++k) {
      const double* command = detail::command_of(motions, i, k);
      for (Index j = 0; j < motions.model(i).num_cables(); ++j) {
        require(command[j] >= 0.0 && std::isfinite(command[j]), "tension of motion ", i + 1,
                ", step ", k + 1, ", cable ", j + 1,
                " must be finite and >= 0 N (a cable cannot push), got ", command[j]);
      }
    }
  }
}

/// The rollout itself: `simulate` for each motion, or many in lanes where that gives the same.
class Rollout {
 public:
  Rollout(const Motions& motions, const RolloutOptions& options, const RolloutRows& rows)
      : motions_(motions),
        options_(options),
        rows_(rows, options.rows(), motions.models.front()->num_coordinates(),
              motions.models.front()->num_cables()),
        tolerances_(options.tolerances) {
    tolerances_.step = options.step;
    if (options.method == Method::rk4 && !tolerances_.max_steps) {
      tolerances_.max_steps = std::numeric_limits<long>::max();  // as many as asked for
    }
    validate(tolerances_);
    const auto time = [&](Index k) {
      return options.start + static_cast<double>(k) * options.step;
    };
    times_ = VectorXd::NullaryExpr(options.rows(), [&](Index i) {
      return time(i * static_cast<Index>(options.record_every));
    });
    if (motions.commands.between_steps != 0) {
      step_times_ = VectorXd::NullaryExpr(std::max(1L, options.steps), time);
    }
    const bool alike = motions.controllers.empty() && motions.commands.between_motions == 0;
    if (alike && motions.size() > 0) alike_ = commands(0);
  }

  RolloutOutcome go(const RolloutProgress& progress) {
    const Index count = motions_.size();
    for (Index i = 0; i < count; ++i) rows_.clear(i);
    is_begun_.assign(static_cast<std::size_t>(count), 0);
    const bool in_lanes = count > 0 && detail::fits_lanes(motions_, options_);
    const Index block = in_lanes ? detail::lane_block(motions_) : 1;
    const auto task = [&](Index i, const detail::GoOn& go_on) {
      if (!in_lanes) return run_motion(i, go_on);
      run_block(i * block, std::min(block, count - i * block), go_on);
    };
    const auto report = [&](Index ended) {
      return !progress || progress(std::min(count, ended * block));
    };
    detail::for_each_task((count + block - 1) / block, options_.threads, task, report);
    for (Index i = 0; i < count; ++i) {
      if (is_begun_[static_cast<std::size_t>(i)] != 0) continue;
      fail(i, Status::interrupted, "The rollout ended before it began.");
    }
    std::sort(outcome_.failures.begin(), outcome_.failures.end(),
              [](const auto& a, const auto& b) { return a.motion < b.motion; });
    return std::move(outcome_);
  }

 private:
  void run_motion(Index i, const detail::GoOn& go_on) {
    is_begun_[static_cast<std::size_t>(i)] = 1;
    const Trajectory run = simulated(i, [&](double /*t*/) { return go_on(); });
    for (Index row = 0; row < run.t.size(); ++row) {
      rows_.write(i, row, &run.q(row, 0), &run.qd(row, 0), run.command.row(row).data());
    }
    rows_.clear(i, run.t.size());
    if (run.status != Status::ok) fail(i, run.status, run.message);
    count_cost(run.stats);
  }

  /// So many motions in lanes; those that are lost there by themselves, which tells why.
  void run_block(Index first, Index count, const detail::GoOn& go_on) {
    std::fill_n(is_begun_.begin() + first, count, 1);
    std::vector<Index> lost;
    const bool done = detail::run_in_lanes(motions_, options_, first, rows_, go_on, lost);
    for (Index i = first; i < first + count && !done; ++i) {
      fail(i, Status::interrupted, "The rollout ended before it did.");
    }
    for (const Index i : lost) {
      if (done) run_motion(i, go_on);
    }
    Stats cost;
    cost.steps = done ? count * options_.steps : 0;
    cost.evaluations = 4 * cost.steps;
    count_cost(cost);
  }

  void fail(Index i, Status status, std::string message) {
    const std::lock_guard lock(mutex_);
    outcome_.failures.push_back({i, status, std::move(message)});
  }

  void count_cost(const Stats& cost) {
    const std::lock_guard lock(mutex_);
    add(outcome_.stats, cost);
  }

  Trajectory simulated(Index i, const Progress& progress) {
    const VectorXd q0 = motions_.q0.row(i), qd0 = motions_.qd0.row(i);
    try {
      const Model& model = motions_.model(i);
      if (motions_.controllers.empty()) {
        return simulate(model, q0, qd0, times_, alike_ ? *alike_ : commands(i), options_.method,
                        tolerances_, options_.factory, progress, motions_.loads);
      }
      return simulate(model, q0, qd0, times_, *motions_.controllers[static_cast<std::size_t>(i)],
                      options_.method, tolerances_, options_.factory, progress, motions_.loads);
    } catch (const std::invalid_argument& error) {
      detail::refuse("motion ", i + 1, ": ", error.what());
    }
  }

  [[nodiscard]] CommandInput commands(Index i) const {
    const Index cables = motions_.model(i).num_cables();
    const double* first = detail::command_of(motions_, i, 0);
    if (motions_.commands.between_steps == 0) {
      return CommandInput::constant(Eigen::Map<const VectorXd>(first, cables));
    }
    const Eigen::Map<const RowMatrixXd, 0, Eigen::OuterStride<>> table(
        first, step_times_.size(), cables, Eigen::OuterStride<>(motions_.commands.between_steps));
    return CommandInput::table(step_times_, table, CommandInput::Interpolation::previous);
  }

  const Motions& motions_;
  const RolloutOptions& options_;
  detail::RowWriter rows_;
  Options tolerances_;
  VectorXd times_, step_times_;        // of the rows, of the commands
  std::optional<CommandInput> alike_;  // where all motions have the same
  std::vector<char> is_begun_;
  std::mutex mutex_;  // of the outcome
  RolloutOutcome outcome_;
};

}  // namespace

void validate(const RolloutOptions& o) {
  detail::require_positive("step", o.step, "s");
  require(std::isfinite(o.start), "start must be finite, got ", o.start);
  require(o.steps >= 0, "steps must be >= 0, got ", o.steps);
  require(o.record_every >= 1 && o.steps % o.record_every == 0,
          "record_every must be a divisor of the ", o.steps, " steps, got ", o.record_every);
  require(o.threads >= 0, "threads must be >= 0 (0: one for each processor), got ", o.threads);
}

RolloutOutcome rollout(const Motions& motions, const RolloutOptions& options,
                       const RolloutRows& rows, const RolloutProgress& progress) {
  validate(options);
  check_motions(motions);
  check_commands(motions, options);
  return Rollout(motions, options, rows).go(progress);
}

}  // namespace cdcr
