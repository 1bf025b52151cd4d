#pragma once

#include <optional>

#include "cdcr/model.hpp"
#include "chain/cable_path.hpp"
#include "chain/chain.hpp"
#include "chain/single_section.hpp"
#include "loads/friction_lanes.hpp"

namespace cdcr {

struct Model::Parts {
  detail::Chain chain;
  std::optional<detail::SingleSection> single;  // where the closed form applies
  std::vector<detail::CablePath> paths;         // of each cable, where the sections are rods
  detail::CableLanes cable_lanes;               // where friction remembers in arcs
  VectorXd rest;
  MatrixXd elastic_stiffness;
};

namespace detail {

/// The path of a cable of a robot of rods.
[[nodiscard]] inline const CablePath& path_of(const Model& model, Index cable) noexcept {
  return model.parts()->paths[static_cast<std::size_t>(cable)];
}
[[nodiscard]] inline const Chain& chain_of(const Model& model) noexcept {
  return model.parts()->chain;
}
/// For models with has_closed_form() alone.
[[nodiscard]] inline const SingleSection& single_of(const Model& model) noexcept {
  return *model.parts()->single;  // NOLINT(bugprone-unchecked-optional-access)
}

}  // namespace detail
}  // namespace cdcr
