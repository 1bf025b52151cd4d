#pragma once

#include "base/arguments.hpp"
#include "cdcr/model.hpp"
#include "cdcr/status.hpp"
#include "section/constant_curvature.hpp"

namespace cdcr::detail {

/// The part of q, or of a vector like it, that belongs to one section.
template <class Vector>
[[nodiscard]] auto of_section(const Model& model, Vector& q, Index section) noexcept {
  const Index first = model.first_coordinate(section);
  return q.segment(first, model.first_coordinate(section + 1) - first);
}

/// Bound of the angle by which a rod bends and twists [rad], cpp/rods.md eq. (70).
[[nodiscard]] double turning_of_rod(const Model& model, const ConstVectorRef& q,
                                    Index section) noexcept;

/// Angle by which a section bends, or that bound [rad]. Real-time safe.
[[nodiscard]] inline double bending_angle(const Model& model, const ConstVectorRef& q,
                                          Index section) noexcept {
  if (model.has_rods()) return turning_of_rod(model, q, section);
  return std::sqrt(
      ConstantCurvature<double>::squared_angle(q.data() + model.first_coordinate(section)));
}

/// Largest such angle of all sections [rad]. Real-time safe.
[[nodiscard]] inline double largest_bending(const Model& model, const ConstVectorRef& q) noexcept {
  double largest = 0.0;
  for (Index i = 0; i < model.num_sections(); ++i) {
    largest = std::fmax(largest, bending_angle(model, q, i));
  }
  return largest;
}

/// Whether every section keeps a tenth of its length all along. Real-time safe.
[[nodiscard]] bool keeps_length(const Model& model, const ConstVectorRef& q) noexcept;

/// Whether a run left the shapes that the model is valid for.
[[nodiscard]] constexpr bool is_shape_limit(Status status) noexcept {
  return status == Status::bending_limit || status == Status::compression_limit;
}

/// Throws std::invalid_argument when a section bends beyond max_bending or is compressed too far.
void require_bending(const char* item, const Model& model, const ConstVectorRef& q);

}  // namespace cdcr::detail
