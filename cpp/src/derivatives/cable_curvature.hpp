#pragma once

#include "section/rod_cable.hpp"

namespace cdcr::detail {

/// Second derivatives of the lengths of cables in one rod, times their pulls, summed up together as
/// RodCables sums up their forces. Real-time safe.
class CableCurvature {
 public:
  CableCurvature(const RodParameters& rod, const double* q) : rod_(rod), q_(q) {}

  /// A cable that pulls so strongly.
  void add(const RodCable& cable, double pull, MatrixRef K);
  /// After the last: adds them to the lower half of K (m, m).
  void finish(MatrixRef K);

 private:
  using L = Lanes<double>;
  static constexpr int max_packs = max_rod_nodes / L::count;

  const RodParameters& rod_;
  const double* q_;
  const RodCable* points_ = nullptr;  // one that has them
  PathStrains<double> strains_;
  /// At the points, of each pair of strains, the first not before the second.
  std::array<std::array<std::array<Pair, max_packs>, num_strains>, num_strains> sums_;
};

}  // namespace cdcr::detail
