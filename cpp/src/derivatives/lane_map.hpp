#pragma once

#include <vector>

#include "chain/chain.hpp"
#include "derivatives/quad.hpp"

namespace cdcr::detail {

/// Where derivatives stand in rows of quads: first those with respect to q of a section, then those
/// to its qd, section after section, each from a quad of its own on; then those to commands.
class LaneMap {
 public:
  LaneMap(const Chain& chain, Index num_commands) : first_quad_{0} {
    for (Index i = 0; i < chain.num_sections(); ++i) {
      const Index size = chain.first[i + 1] - chain.first[i];
      for (Index k = 0; k < size; ++k) {
        on_q_.push_back(Quad::count * first_quad_.back() + k);
        on_qd_.push_back(on_q_.back() + size);
      }
      first_quad_.push_back(first_quad_.back() + quads(2 * size));
    }
    width_ = num_state_quads() + quads(num_commands);
  }

  /// The quads of a section begin here; those of all end where those of section n would begin.
  [[nodiscard]] Index first_quad(Index section) const noexcept { return first_quad_[section]; }
  [[nodiscard]] Index num_state_quads() const noexcept { return first_quad_.back(); }
  [[nodiscard]] Index width() const noexcept { return width_; }  ///< of a row, in quads

  /// Lanes in a row.
  [[nodiscard]] Index on_q(Index coordinate) const noexcept { return on_q_[coordinate]; }
  [[nodiscard]] Index on_qd(Index coordinate) const noexcept { return on_qd_[coordinate]; }
  [[nodiscard]] Index on_command(Index cable) const noexcept {
    return Quad::count * num_state_quads() + cable;
  }

 private:
  static Index quads(Index lanes) { return (lanes + Quad::count - 1) / Quad::count; }

  std::vector<Index> first_quad_, on_q_, on_qd_;
  Index width_;
};

}  // namespace cdcr::detail
