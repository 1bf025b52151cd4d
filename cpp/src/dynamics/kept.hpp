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

/// The chain of one model, of either kind of section, as it was last asked for.
class KeptChain {
 public:
  explicit KeptChain(const Model& model) {
    if (model.has_rods()) rods_.emplace(chain_of(model));
    if (!model.has_rods()) arcs_.emplace(chain_of(model));
  }

  /// f(chain, state) at a position, or at a position and a velocity.
  template <class F, class... Positions>
  auto with(const Model& model, const F& f, const Positions*... at) noexcept {
    const Chain& chain = chain_of(model);
    if (arcs_) return f(chain, arcs_->at(chain, at...));
    // NOLINTNEXTLINE(bugprone-unchecked-optional-access): one of the two
    return f(chain, rods_->at(chain, at...));
  }

 private:
  std::optional<KeptState<ArcChainState<double>>> arcs_;
  std::optional<KeptState<RodChainState<double>>> rods_;
};

}  // namespace detail

/// The same with room for derivatives of motions.
class Data::Kept : public detail::KeptChain {
 public:
  explicit Kept(const Model& model) : KeptChain(model), force_duals(model) {
    if (model.has_rods()) of_rods_.emplace(detail::chain_of(model), model.num_cables());
    if (!model.has_rods()) of_arcs_.emplace(detail::chain_of(model), model.num_cables());
  }

  /// f(chain, state, derivatives).
  template <class F, class... Positions>
  auto with_derivatives(const Model& model, const F& f, const Positions*... at) noexcept {
    return with(
        model, [&](auto& chain, auto& state) { return f(chain, state, derivatives_of(state)); },
        at...);
  }

  detail::ForceDuals force_duals;

 private:
  // NOLINTBEGIN(bugprone-unchecked-optional-access): one of the two, that of the chain
  auto& derivatives_of(const detail::ArcChainState<double>& /*state*/) { return *of_arcs_; }
  auto& derivatives_of(const detail::RodChainState<double>& /*state*/) { return *of_rods_; }
  // NOLINTEND(bugprone-unchecked-optional-access)

  std::optional<detail::MotionDerivatives<detail::ConstantCurvature>> of_arcs_;
  std::optional<detail::MotionDerivatives<detail::Rod>> of_rods_;
};

}  // namespace cdcr
