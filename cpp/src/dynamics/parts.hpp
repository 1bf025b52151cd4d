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
[[nodiscard]] inline const SingleSection& single_of(const Model& model) noexcept {
  return *model.parts()->single;
}

}  // namespace detail
}  // namespace cdcr
