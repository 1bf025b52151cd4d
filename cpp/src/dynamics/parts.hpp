#pragma once

#include <optional>

#include "cdcr/model.hpp"
#include "chain/chain.hpp"
#include "chain/single_section.hpp"

namespace cdcr {

struct Model::Parts {
  detail::Chain chain;
  std::optional<detail::SingleSection> single;  // where the closed form applies
};

namespace detail {

[[nodiscard]] inline const Chain& chain_of(const Model& model) noexcept {
  return model.parts()->chain;
}
/// For models with has_closed_form() alone.
[[nodiscard]] inline const SingleSection& single_of(const Model& model) noexcept {
  return *model.parts()->single;  // NOLINT(bugprone-unchecked-optional-access)
}

/// Potential energy of the robot were its base at the origin: with all digits wherever it stands.
[[nodiscard]] double energy_from_base(const Model& model, Data& data,
                                      const ConstVectorRef& q) noexcept;

}  // namespace detail
}  // namespace cdcr
