#pragma once

#include "base/arguments.hpp"
#include "cdcr/model.hpp"
#include "section/constant_curvature.hpp"

namespace cdcr::detail {

/// The part of q, or of a vector like it, that belongs to one section.
template <class Vector>
[[nodiscard]] auto of_section(const Model& model, Vector& q, Index section) noexcept {
  const Index first = model.first_coordinate(section);
  return q.segment(first, model.first_coordinate(section + 1) - first);
}

/// Angle by which a section bends [rad]. Real-time safe.
[[nodiscard]] inline double bending_angle(const Model& model, const ConstVectorRef& q,
                                          Index section) noexcept {
  return std::sqrt(
      ConstantCurvature<double>::squared_angle(q.data() + model.first_coordinate(section)));
}

/// Largest bending angle of all sections [rad]. Real-time safe.
[[nodiscard]] inline double largest_bending(const Model& model, const ConstVectorRef& q) noexcept {
  double largest = 0.0;
  for (Index i = 0; i < model.num_sections(); ++i) {
    largest = std::fmax(largest, bending_angle(model, q, i));
  }
  return largest;
}

/// Throws std::invalid_argument when a section bends beyond max_bending.
inline void require_bending(const char* item, const Model& model, const ConstVectorRef& q) {
  for (Index i = 0; i < model.num_sections(); ++i) {
    const double angle = bending_angle(model, q, i);
    require(angle <= max_bending, item, " must bend each section by at most 3 pi rad, got ", angle,
            " rad in section ", i + 1);
  }
}

}  // namespace cdcr::detail
