#include "section/rod_cable.hpp"

namespace cdcr::detail {

RodCable::RodCable(const RodParameters& rod, const CableRoute& route) {
  const double widens = route.tip_radius - route.base_radius;
  const double winds = route.tip_angle - route.base_angle;
  for (const auto& [at, weight] : gauss_legendre(rod.num_nodes())) {
    const auto x = static_cast<double>(at);
    const double radius = route.base_radius + x * widens;
    const double angle = route.base_angle + x * winds;
    const double c = std::cos(angle), s = std::sin(angle);
    points_.push_back({static_cast<double>(weight), radius * c, radius * s,
                       widens * c - radius * winds * s, widens * s + radius * winds * c,
                       legendre(x)});
  }
}

}  // namespace cdcr::detail
