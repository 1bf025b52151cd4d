#pragma once

#include "chain/chain.hpp"
#include "section/rod_cable.hpp"
#include "section/rubbing_path.hpp"

// A cable through rods: its length and its pull depend on the shape (cpp/rods.md eqs. (63) to
// (67)).

namespace cdcr::detail {

/// The path of one cable through the rods that it passes.
class CablePath {
 public:
  CablePath(const Chain& chain, const Cable& cable) : first_(cable.start_section) {
    for (int k = first_; k <= cable.end_section; ++k) {
      const RodParameters& rod = *chain.sections[static_cast<std::size_t>(k)].rod;
      smooth_.emplace_back(rod, cable.route(k));
      rubbing_.emplace_back(rod, cable.route(k));
    }
  }

  /// Length [m] at q; adds `pull` times -dl/dq to the force.
  template <class S>
  S length(const Chain& chain, const S* q, const S& pull, S* force) const {
    S sum(0.0);
    for (std::size_t i = 0; i < smooth_.size(); ++i) {
      const auto k = static_cast<std::size_t>(first_) + i;
      sum += smooth_[i].length(*chain.sections[k].rod, q + chain.first[k], pull,
                               force + chain.first[k]);
    }
    return sum;
  }

  /// What it is in a rod, where it passes that.
  [[nodiscard]] const RodCable* in(Index rod) const noexcept {
    const Index i = rod - first_;
    return 0 <= i && i < static_cast<Index>(smooth_.size()) ? &smooth_[i] : nullptr;
  }

  /// Adds the force of a cable that rubs, with this tension at its base while its length changes at
  /// this rate. The tension that is left beyond each section goes to `beyond_sections` where
  /// wanted.
  template <class S>
  void rub(const Chain& chain, const S* q, const S* qd, const double* friction,
           double sliding_speed, const S& tension_at_base, const S& rate_of_length, S* force,
           S* beyond_sections) const {
    S tension = tension_at_base, rate = rate_of_length;
    for (std::size_t i = 0; i < rubbing_.size(); ++i) {
      const auto k = static_cast<std::size_t>(first_) + i;
      const Index at = chain.first[k];
      tension =
          rubbing_[i].pull(*chain.sections[k].rod, q + at, qd + at, friction[k], sliding_speed,
                           tension, rate, i + 1 == rubbing_.size(), force + at);
      if (beyond_sections != nullptr) beyond_sections[k] = tension;
    }
  }

  /// By how much the cable turns in a section that it passes [rad].
  template <class S>
  S turn(const Chain& chain, int section, const S* q) const {
    const auto k = static_cast<std::size_t>(section);
    return rubbing_[k - static_cast<std::size_t>(first_)].turn(*chain.sections[k].rod,
                                                               q + chain.first[k]);
  }

 private:
  int first_;
  std::vector<RodCable> smooth_;
  std::vector<RubbingPath> rubbing_;
};

/// -dl/dq of a cable at q (d), and its length.
template <class S>
struct CableSlope {
  S length;
  S column[max_coordinates];

  CableSlope(const Chain& chain, const CablePath& path, const S* q) : length(0.0) {
    for (Index i = 0; i < chain.num_coordinates(); ++i) column[i] = S(0.0);
    length = path.length(chain, q, S(1.0), column);
  }
  /// How fast the cable grows longer [m/s].
  [[nodiscard]] S rate(const Chain& chain, const S* qd) const {
    S sum(0.0);
    for (Index i = 0; i < chain.num_coordinates(); ++i) sum -= column[i] * qd[i];
    return sum;
  }
};

}  // namespace cdcr::detail
