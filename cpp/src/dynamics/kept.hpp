#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "cdcr/model.hpp"
#include "chain/functions.hpp"
#include "derivatives/motion_derivatives.hpp"
#include "dynamics/parts.hpp"
#include "loads/force_derivatives.hpp"

namespace cdcr {

namespace detail {

/// A chain at the last position and velocity it was asked for.
template <class State>
class KeptState {
 public:
  explicit KeptState(const Chain& chain)
      : state_(chain), q_(chain.num_coordinates()), qd_(chain.num_coordinates()), own_(&chain) {}

  /// For functions of position alone.
  const State& at(const Chain& chain, const double* q) noexcept {
    if (!holds(chain, q)) {
      update_position(chain, state_, q);
      std::copy_n(q, q_.size(), q_.begin());
      has_position_ = &chain == own_;  // another model's is used, but not kept
      has_velocity_ = false;
    }
    return state_;
  }

  const State& at(const Chain& chain, const double* q, const double* qd) noexcept {
    if (!holds(chain, q)) {
      update_motion(chain, state_, q, qd);
      std::copy_n(q, q_.size(), q_.begin());
      std::copy_n(qd, qd_.size(), qd_.begin());
      has_position_ = has_velocity_ = &chain == own_;
    } else if (!has_velocity_ || !std::equal(qd_.begin(), qd_.end(), qd)) {
      update_velocity(chain, state_, qd);
      std::copy_n(qd, qd_.size(), qd_.begin());
      has_velocity_ = true;
    }
    return state_;
  }

 private:
  [[nodiscard]] bool holds(const Chain& chain, const double* q) const noexcept {
    return has_position_ && &chain == own_ && std::equal(q_.begin(), q_.end(), q);
  }

  State state_;
  std::vector<double> q_, qd_;
  const Chain* own_;  // Data keeps it alive
  bool has_position_ = false, has_velocity_ = false;
};

}  // namespace detail

/// The chain of one model as it was last asked for, and room for its derivatives.
class Data::Kept {
 public:
  explicit Kept(const Model& model) : force_duals(model) {
    const detail::Chain& chain = detail::chain_of(model);
    if (chain.has_rods()) {
      rods_.emplace(chain, model.num_cables());
    } else {
      arcs_.emplace(chain, model.num_cables());
    }
  }

  /// f(chain, state) at a position, or at a position and a velocity.
  template <class F, class... Positions>
  auto with(const Model& model, const F& f, const Positions*... at) noexcept {
    return with_derivatives(
        model, [&f](auto& chain, auto& state, auto& /*derivatives*/) { return f(chain, state); },
        at...);
  }

  /// f(chain, state, derivatives).
  template <class F, class... Positions>
  auto with_derivatives(const Model& model, const F& f, const Positions*... at) noexcept {
    const detail::Chain& chain = detail::chain_of(model);
    if (arcs_) return f(chain, arcs_->motion.at(chain, at...), arcs_->derivatives);
    // NOLINTNEXTLINE(bugprone-unchecked-optional-access): one of the two
    return f(chain, rods_->motion.at(chain, at...), rods_->derivatives);
  }

  detail::ForceDuals force_duals;

 private:
  /// Of one kind of section.
  template <template <class> class Kind>
  struct Rooms {
    Rooms(const detail::Chain& chain, Index num_cables)
        : motion(chain), derivatives(chain, num_cables) {}

    detail::KeptState<detail::ChainState<Kind<double>>> motion;
    detail::MotionDerivatives<Kind> derivatives;
  };

  std::optional<Rooms<detail::ConstantCurvature>> arcs_;
  std::optional<Rooms<detail::Rod>> rods_;
};

}  // namespace cdcr
