#include "integration/rollout_lanes.hpp"

#include "batch/rk4_lanes.hpp"
#include "cdcr/robot_ode.hpp"
#include "loads/cable_force.hpp"

namespace cdcr::detail {
namespace {

constexpr Index steps_between_looks = 256;

/// The motions of one block.
class Block {
 public:
  Block(const Motions& motions, const RolloutOptions& options, Index first, RowWriter& rows,
        std::vector<Index>& lost)
      : motions_(motions),
        options_(options),
        model_(motions.model(0)),
        rows_(rows),
        lost_(lost),
        lanes_(make_rk4_lanes(model_, motions.size() - first)),
        first_(first),
        count_(std::min(lanes_->size(), motions.size() - first)),
        is_lost_(static_cast<std::size_t>(count_), false),
        y_(2 * model_.num_coordinates()),
        force_(model_.num_coordinates()) {
    for (Index i = 0; i < count_; ++i) {
      y_ << motions.q0.row(first + i).transpose(), motions.qd0.row(first + i).transpose();
      lanes_->set_state(i, y_);
    }
  }

  bool run(const GoOn& go_on) {
    set_forces(0);
    look(0);
    double t = options_.start;
    for (Index k = 0; k < options_.steps; ++k) {
      if (k > 0 && motions_.commands.between_steps != 0) set_forces(k);
      const double next = options_.start + static_cast<double>(k + 1) * options_.step;
      lanes_->step(next - t);
      t = next;
      if ((k + 1) % options_.record_every == 0) look((k + 1) / options_.record_every);
      if (k % steps_between_looks != steps_between_looks - 1) continue;
      look(-1);
      if (!go_on()) return false;
    }
    return true;
  }

 private:
  void set_forces(Index step) {
    for (Index i = 0; i < count_; ++i) {
      actuation_force(model_, command_of(motions_, first_ + i, step), force_.data());
      lanes_->set_force(i, force_);
    }
  }

  /// Sees which motions are lost, and writes a row of the others; -1: none.
  void look(Index row) {
    const Index d = model_.num_coordinates();
    const Index step = std::min<Index>(row * options_.record_every, options_.steps - 1);
    for (Index i = 0; i < count_; ++i) {
      if (is_lost_[static_cast<std::size_t>(i)]) continue;
      lanes_->get_state(i, y_);
      if (check_state(model_, y_) != Status::ok) {
        is_lost_[static_cast<std::size_t>(i)] = true;
        lost_.push_back(first_ + i);
        lanes_->set_state(i, VectorXd::Zero(2 * d));  // a state that costs least
      } else if (row >= 0) {
        const double* command = command_of(motions_, first_ + i, std::max<Index>(step, 0));
        rows_.write(first_ + i, row, y_.data(), y_.data() + d, command);
      }
    }
  }

  const Motions& motions_;
  const RolloutOptions& options_;
  const Model& model_;
  RowWriter& rows_;
  std::vector<Index>& lost_;
  std::unique_ptr<Rk4Lanes> lanes_;
  Index first_, count_;
  std::vector<bool> is_lost_;
  VectorXd y_, force_;
};

}  // namespace

bool fits_lanes(const Motions& motions, const RolloutOptions& options) noexcept {
  return options.method == Method::rk4 && motions.models.size() == 1 &&
         motions.controllers.empty() && motions.loads.empty() && fits_lanes(motions.model(0)) &&
         !options.tolerances.max_steps;
}

Index lane_block(const Motions& motions) {
  return make_rk4_lanes(motions.model(0), motions.size())->size();
}

bool run_in_lanes(const Motions& motions, const RolloutOptions& options, Index first,
                  RowWriter& rows, const GoOn& go_on, std::vector<Index>& lost) {
  return Block(motions, options, first, rows, lost).run(go_on);
}

}  // namespace cdcr::detail
