#pragma once

#include <cassert>

#include "base/arguments.hpp"
#include "cdcr/wrench.hpp"

// Whether arguments fit a model. Debug builds assert it where sizes and indices are the caller's
// duty: most are read through plain pointers, where Eigen does not look.

namespace cdcr::detail {

/// Whether each has one value for each coordinate.
template <class... Vectors>
[[nodiscard]] bool of_coordinates(const Model& model, const Vectors&... vectors) noexcept {
  return ((vectors.size() == model.num_coordinates()) && ...);
}

/// Whether each has one value for each cable.
template <class... Vectors>
[[nodiscard]] bool of_cables(const Model& model, const Vectors&... vectors) noexcept {
  return ((vectors.size() == model.num_cables()) && ...);
}

template <class Matrix>
[[nodiscard]] bool has_size(const Matrix& matrix, Index rows, Index columns) noexcept {
  return matrix.rows() == rows && matrix.cols() == columns;
}

[[nodiscard]] inline bool is_section(const Model& model, Index section) noexcept {
  return section >= 0 && section < model.num_sections();
}

[[nodiscard]] inline bool is_fraction(double fraction) noexcept {
  return fraction >= 0.0 && fraction <= 1.0;
}

[[nodiscard]] inline bool is_cable(const Model& model, Index cable) noexcept {
  return cable >= 0 && cable < model.num_cables();
}

/// Throws std::invalid_argument where `who`, which gives tensions, would drive a cable by length.
inline void require_tension_drive(const char* who, const Model& model) {
  for (std::size_t j = 0; j < model.cables().size(); ++j) {
    require(!model.cables()[j].length_driven(), who, " drives cables by tension, but cable ", j + 1,
            " of the robot is driven by length (its stiffness is not 0)");
  }
}

}  // namespace cdcr::detail
