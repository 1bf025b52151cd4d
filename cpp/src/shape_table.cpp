#include "cdcr/shape_table.hpp"

#include <cstddef>
#include <limits>

#include "cdcr/model.hpp"
#include "section_series.hpp"

namespace cdcr::detail {
namespace {

constexpr int num_pieces = 9;   // sigma up to (3 pi)^2 = max_bending^2
constexpr int num_powers = 16;  // the next is below 1e-17 of the value in every piece
constexpr int num_groups = 3;
constexpr std::ptrdiff_t block = 4 * std::ptrdiff_t{num_powers};
constexpr double piece_width = max_bending * max_bending / num_pieces;
constexpr double sigma_limit = max_bending * max_bending;

Series derivative(const Series& f) {
  Series d;
  for (std::size_t k = 1; k < f.size(); ++k) d.push_back(f[k] * static_cast<long double>(k));
  return d;
}

/// Coefficients in t of f(centre + half_width t), by repeated synthetic division.
Series recentred(Series f, long double centre, long double half_width) {
  if (f.size() < num_powers) f.resize(num_powers, 0.0L);  // a cut series is short
  const std::size_t n = f.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = n - 1; k-- > i;) f[k] += centre * f[k + 1];
  }
  long double scale = 1.0L;
  for (long double& c : f) {
    c *= scale;
    scale *= half_width;
  }
  return f;
}

}  // namespace

ShapeTable::ShapeTable(const SectionSeries& s)
    : coefficients_(static_cast<std::size_t>(num_pieces) * num_groups * block) {
  const Series da = derivative(s.a), db = derivative(s.b);
  const Series dA = derivative(s.G_A), dS = derivative(s.G_S);
  const Series groups[num_groups][4] = {
      {s.a, s.b, da, db},
      {s.G_A, s.G_S, dA, dS},
      {derivative(da), derivative(db), derivative(dA), derivative(dS)}};
  std::size_t at = 0;
  for (int piece = 0; piece < num_pieces; ++piece) {
    const long double half_width = piece_width / 2.0L;
    const long double centre = (2 * piece + 1) * half_width;
    for (const auto& group : groups) {
      for (int f = 0; f < 4; ++f) {
        const Series c = recentred(group[f], centre, half_width);
        for (int k = 0; k < num_powers; ++k) {
          coefficients_[at + static_cast<std::size_t>(4 * k + f)] = static_cast<double>(c[k]);
        }
      }
      at += block;
    }
  }
}

ShapeTable::Values ShapeTable::operator()(Group group, double sigma) const noexcept {
  if (!(sigma <= sigma_limit)) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan, nan};
  }
  const double position = sigma * (1.0 / piece_width);
  auto piece = static_cast<std::ptrdiff_t>(position);
  if (piece == num_pieces) piece = num_pieces - 1;
  const double t = 2.0 * (position - static_cast<double>(piece)) - 1.0;
  const double u = t * t;
  const double* c =
      coefficients_.data() + (piece * num_groups + static_cast<std::ptrdiff_t>(group)) * block;
  // Even and odd powers apart: two short dependency chains in place of one long one.
  Values even, odd;
  for (int f = 0; f < 4; ++f) {
    even[f] = c[block - 8 + f];
    odd[f] = c[block - 4 + f];
  }
  for (std::ptrdiff_t k = num_powers - 4; k >= 0; k -= 2) {
    for (int f = 0; f < 4; ++f) {
      even[f] = even[f] * u + c[4 * k + f];
      odd[f] = odd[f] * u + c[4 * k + 4 + f];
    }
  }
  for (int f = 0; f < 4; ++f) even[f] += t * odd[f];
  return even;
}

}  // namespace cdcr::detail
