#include "section/rod_cable.hpp"

namespace cdcr::detail {

int num_path_points(const RodParameters& rod, const CableRoute& route) noexcept {
  const double winds = std::abs(route.tip_angle - route.base_angle);
  const double wanted = rod.num_nodes() + std::ceil(0.5 * winds);
  return static_cast<int>(std::fmin(wanted, max_rod_nodes));
}

RodCable::RodCable(const RodParameters& rod, const CableRoute& route)
    : num_points_(num_path_points(rod, route)) {
  const double widens = route.tip_radius - route.base_radius;
  const double winds = route.tip_angle - route.base_angle;
  std::size_t k = 0;
  for (const auto& [at, weight] : gauss_legendre(num_points_)) {
    const auto x = static_cast<double>(at);
    const double radius = route.base_radius + x * widens, angle = route.base_angle + x * winds;
    const double c = std::cos(angle), s = std::sin(angle);
    weight_[k] = static_cast<double>(weight);
    x_[k] = radius * c;
    y_[k] = radius * s;
    slope_x_[k] = widens * c - radius * winds * s;
    slope_y_[k] = widens * s + radius * winds * c;
    const LegendreValues P = legendre(x);
    for (std::size_t j = 0; j < P.size(); ++j) legendre_[j][k] = P[j];
    ++k;
  }
}

}  // namespace cdcr::detail
