#pragma once

#include "cdcr/robot.hpp"
#include "section/series.hpp"

namespace cdcr::detail {

/// mu(p) = sum over a section's elements of (weight of the element) x^p, for all p needed.
class MassMoments {
 public:
  /// sum m x^p, `tip` being a mass at x = 1.
  static MassMoments of_mass(const Section& s, long double tip) {
    MassMoments moments(s.backbone_mass, tip);
    moments.add_disks(s, [](const Disk& disk) -> long double { return disk.mass; });
    return moments;
  }

  /// sum I_t x^p of disks, m d^2/16 each, and of slices of the backbone, where the square of the
  /// inner diameter adds to that; I_a = 2 I_t for both.
  static MassMoments of_inertia(const Section& s) {
    const long double d = s.backbone_diameter, inner = s.backbone_inner_diameter;
    MassMoments moments(s.backbone_mass * (d * d + inner * inner) / 16.0L, 0.0L);
    moments.add_disks(s, [](const Disk& disk) {
      return static_cast<long double>(disk.mass) * disk.diameter * disk.diameter / 16.0L;
    });
    return moments;
  }

  [[nodiscard]] long double operator()(int p) const { return sums_[p]; }

 private:
  MassMoments(long double rod, long double tip) {
    for (int p = 0; p < 2 * num_terms + 8; ++p) sums_.push_back(rod / (p + 1) + tip);
  }
  template <class Weight>
  void add_disks(const Section& s, Weight&& weight) {
    const std::vector<Disk> disks = s.disks();
    for (std::size_t k = 0; k < disks.size(); ++k) {
      // Of equally spaced disks k/N is known better than to double precision.
      const long double spaced = static_cast<long double>(k + 1) / disks.size();
      add(s.disk_positions.empty() ? spaced : disks[k].position, weight(disks[k]));
    }
  }
  void add(long double x, long double weight) {
    for (long double& sum : sums_) {
      sum += weight;
      weight *= x;
    }
  }

  Series sums_;
};

}  // namespace cdcr::detail
