#pragma once

#include <vector>

#include "base/lanes.hpp"
#include "cdcr/types.hpp"

namespace cdcr {
class Model;
}  // namespace cdcr

namespace cdcr::detail {

/// What forces of arcs' cables read, the numbers of cables side by side: as many as there are, then
/// cables of nothing up to a multiple of four.
struct CableLanes {
  CableLanes() = default;
  explicit CableLanes(const Model& model);

  static constexpr Index together = 4;
  MatrixXd columns;   // B^T (cables, d)
  MatrixXd friction;  // Coulomb's coefficient in the holes (cables, n)
  MatrixXd rubs;      // 1 where it is not zero (cables, n)
  VectorXd alike;     // of each section, where it is the same for all that rub there; else -1
  VectorXd entry, sheath_decay, stiffness, damping, viscosity;
  VectorXd taut_from;            // length where a cable driven to 0 becomes taut at q = 0 [m]
  std::vector<int> first, last;  // sections of each four cables
  std::vector<bool> driven;      // whether one of the four is driven by length
};

/// A ten thousandth of the tension that bends the softest section by a radian [N], 0 where no cable
/// bends any: cpp/friction.md eq. (107).
[[nodiscard]] double least_friction(const Model& model) noexcept;

/// memory_force of doubles where all sections are arcs, several cables at once.
void memory_force_of_arcs(const Model& model, const double* q, const double* qd,
                          const double* command, const double* deflection, double* force,
                          double* rate, int lanes = num_lanes) noexcept;

}  // namespace cdcr::detail
