#include "section/rubbing_path.hpp"

#include "section/rod_cable.hpp"

namespace cdcr::detail {

RubbingPath::RubbingPath(const RodParameters& rod, const CableRoute& route) {
  const double widens = route.tip_radius - route.base_radius;
  const double winds = route.tip_angle - route.base_angle;
  const std::vector<GaussPoint> rule = gauss_legendre(num_path_points(rod, route));
  for (const auto& [at, weight] : rule) {
    const auto x = static_cast<double>(at);
    const double radius = route.base_radius + x * widens;
    const double angle = route.base_angle + x * winds;
    const double c = std::cos(angle), s = std::sin(angle);
    Point point{static_cast<double>(weight),
                radius * c,
                radius * s,
                widens * c - radius * winds * s,
                widens * s + radius * winds * c,
                -2.0 * widens * winds * s - radius * winds * winds * c,
                2.0 * widens * winds * c - radius * winds * winds * s,
                legendre(x),
                legendre_slope(x),
                {}};
    // Integral from 0 to x of the polynomial through the values at the points.
    for (std::size_t j = 0; j < rule.size(); ++j) {
      long double sum = 0.0L;
      for (const auto& [inner, share] : gauss_legendre()) {
        long double cardinal = 1.0L;
        for (std::size_t k = 0; k < rule.size(); ++k) {
          if (k != j) cardinal *= (inner * at - rule[k].x) / (rule[j].x - rule[k].x);
        }
        sum += share * at * cardinal;
      }
      point.before.push_back(static_cast<double>(sum));
    }
    points_.push_back(std::move(point));
    weights_.push_back(static_cast<double>(weight));
  }
}

}  // namespace cdcr::detail
