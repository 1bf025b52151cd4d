#include "section/shape_table.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <limits>

#include "section/polynomial_table.hpp"
#include "section/series.hpp"

namespace cdcr::detail {
namespace {

constexpr int num_groups = 3;
constexpr std::ptrdiff_t block = 4 * std::ptrdiff_t{num_powers};

}  // namespace

ShapeTable::ShapeTable(const SectionSeries& s)
    : coefficients_(static_cast<std::size_t>(num_pieces) * num_groups * block) {
  const Series* functions[4] = {&s.a, &s.b, &s.G_A, &s.G_S};
  for (int piece = 0; piece < num_pieces; ++piece) {
    const long double centre = piece_centre(piece);
    const auto put = [&](Group group, int place, const Series& c) {
      double* to = &coefficients_[(piece * num_groups + static_cast<int>(group)) * block + place];
      for (std::ptrdiff_t k = 0; k < num_powers; ++k) to[4 * k] = static_cast<double>(c[k]);
    };
    for (int f = 0; f < 4; ++f) {
      const Group group = f < 2 ? Group::inertia : Group::gravity;
      // Two more than the table keeps, for f''.
      const Series c = recentred(*functions[f], centre, half_width, num_powers + 2);
      const Series first = derivative(c, half_width);
      put(group, f % 2, c);
      put(group, f % 2 + 2, first);
      put(Group::second, f, derivative(first, half_width));
    }
  }
}

ShapeTable::Values ShapeTable::operator()(Group group, double sigma) const noexcept {
  if (!(sigma <= sigma_limit)) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan, nan};
  }
  double t = 0.0;
  const int piece = find_piece(sigma, t);
  const double u = t * t;
  const double* c = coefficients_.data() + (piece * num_groups + static_cast<int>(group)) * block;
  // Powers 0 to 3 modulo 4 apart: four short dependency chains in place of one long one.
  using Four = Eigen::Array4d;  // one power of the four functions
  using Sixteen = Eigen::Array<double, 16, 1>;
  const auto powers_from = [c](std::ptrdiff_t k) { return Eigen::Map<const Sixteen>(c + 4 * k); };
  Sixteen sums = powers_from(num_powers - 4);
  for (int k = num_powers - 8; k >= 0; k -= 4) sums = sums * (u * u) + powers_from(k);
  Values values;
  Eigen::Map<Four>(values.data()) = (sums.segment<4>(0) + u * sums.segment<4>(8)) +
                                    t * (sums.segment<4>(4) + u * sums.segment<4>(12));
  return values;
}

}  // namespace cdcr::detail
