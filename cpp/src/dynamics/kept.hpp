#pragma once

#include <algorithm>

#include "cdcr/model.hpp"
#include "chain/functions.hpp"
#include "dynamics/parts.hpp"

namespace cdcr {

/// The chain of one model at the last position and velocity it was asked for.
class Data::Kept {
 public:
  explicit Kept(const Model& model) : own_(&detail::chain_of(model)) {}

  /// For functions of position alone.
  const detail::MotionState& at(const Model& model, const double* q) noexcept {
    const detail::Chain& chain = detail::chain_of(model);
    if (!holds(chain, q)) {
      state_.update_position(chain, q);
      std::copy_n(q, chain.num_coordinates(), q_);
      has_position_ = &chain == own_;  // another model's is used, but not kept
      has_velocity_ = false;
    }
    return state_;
  }

  const detail::MotionState& at(const Model& model, const double* q, const double* qd) noexcept {
    const detail::Chain& chain = detail::chain_of(model);
    if (!holds(chain, q)) {
      state_.update(chain, q, qd);
      std::copy_n(q, chain.num_coordinates(), q_);
      std::copy_n(qd, chain.num_coordinates(), qd_);
      has_position_ = has_velocity_ = &chain == own_;
    } else if (!has_velocity_ || !std::equal(qd, qd + chain.num_coordinates(), qd_)) {
      state_.update_velocity(chain, qd);
      std::copy_n(qd, chain.num_coordinates(), qd_);
      has_velocity_ = true;
    }
    return state_;
  }

 private:
  [[nodiscard]] bool holds(const detail::Chain& chain, const double* q) const noexcept {
    return has_position_ && &chain == own_ && std::equal(q, q + chain.num_coordinates(), q_);
  }

  detail::MotionState state_;
  double q_[max_coordinates], qd_[max_coordinates];
  const detail::Chain* own_;  // Data keeps it alive
  bool has_position_ = false, has_velocity_ = false;
};

}  // namespace cdcr
