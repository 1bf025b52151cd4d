#include "dynamics/bending.hpp"

#include <cmath>

#include "dynamics/parts.hpp"

namespace cdcr::detail {
namespace {

// Share of its length that a rod has to keep everywhere.
constexpr double least_length = 0.1;

/// sqrt(int |u|^2 dx), no less than the angle int |u| dx.
double turning_of(const RodParameters& rod, const double* q) noexcept {
  const Vector3d& locked = rod.locked_turning;
  double sum = locked.squaredNorm();
  for (Index j = 0; j < rod.num_bending; ++j) {
    sum += (q[2 * j] * q[2 * j] + q[2 * j + 1] * q[2 * j + 1]) / static_cast<double>(2 * j + 1);
  }
  for (int j = 0; j < rod.num_twist; ++j) {
    const double twist = q[rod.first_twist + j];
    sum += twist * twist / (2.0 * j + 1.0);
  }
  return std::sqrt(sum);
}

/// The section compressed too far, or -1.
Index compressed_section(const Model& model, const ConstVectorRef& q) noexcept {
  const Chain& chain = chain_of(model);
  for (Index i = 0; model.has_rods() && i < chain.num_sections(); ++i) {
    const RodParameters& rod = *chain.sections[i].rod;
    for (int k = 0; rod.num_stretch > 0 && k <= rod.num_frames(); ++k) {
      double length = rod.length;
      for (int j = 0; j < rod.num_stretch; ++j) {
        length += rod.rule.legendre[j][k] * q[chain.first[i] + rod.first_stretch + j];
      }
      if (!(length >= least_length * rod.length)) return i;
    }
  }
  return -1;
}

}  // namespace

double turning_of_rod(const Model& model, const ConstVectorRef& q, Index section) noexcept {
  return turning_of(*chain_of(model).sections[section].rod,
                    q.data() + model.first_coordinate(section));
}

bool keeps_length(const Model& model, const ConstVectorRef& q) noexcept {
  return compressed_section(model, q) < 0;
}

void require_bending(const char* item, const Model& model, const ConstVectorRef& q) {
  for (Index i = 0; i < model.num_sections(); ++i) {
    const double angle = bending_angle(model, q, i);
    require(angle <= max_bending, item, " must ", model.has_rods() ? "turn" : "bend",
            " each section by at most 3 pi rad, got ", angle, " rad in section ", i + 1);
  }
  const Index compressed = compressed_section(model, q);
  require(compressed < 0, item, " must leave each section a tenth of its length, but compresses ",
          "section ", compressed + 1, " further");
}

}  // namespace cdcr::detail
