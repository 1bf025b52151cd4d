#pragma once

#include <array>
#include <vector>

namespace cdcr::detail {

struct SectionSeries;

/// The functions a, b, G_A, G_S of sigma = theta^2 and their derivatives as piecewise
/// polynomials, one piece for each pi^2 of sigma, fixed at construction. Reading them costs a few
/// dozen multiply-adds, no trigonometric function and no sum over disks. Not part of the public
/// interface; Model owns one for each section.
class ShapeTable {
 public:
  /// Four functions that are read together.
  enum class Group { inertia, gravity, second };
  using Values = std::array<double, 4>;

  explicit ShapeTable(const SectionSeries& series);

  /// inertia: a, b, a', b'.  gravity: G_A, G_S, G_A', G_S'.  second: a'', b'', G_A'', G_S''.
  /// ' is d/d sigma. NaN beyond the largest bending angle and for NaN. Real-time safe.
  [[nodiscard]] Values operator()(Group group, double sigma) const noexcept;

 private:
  std::vector<double> coefficients_;  // [piece][group][power][function]
};

}  // namespace cdcr::detail
