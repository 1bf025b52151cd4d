#include "cdcr/coordinates.hpp"

#include <cmath>

#include "base/constants.hpp"

namespace cdcr {
namespace {

using detail::pi;

// Two samples in a row further apart than this have swung through straight; closer ones have
// turned. A quarter turn beyond the even split, so that fast turning is still read as turning.
constexpr double swing_angle = 0.75 * pi;

}  // namespace

Polar polar(double q_x, double q_y) noexcept {
  // + 0.0 turns a negative zero into zero, whose angle would otherwise be pi.
  return {std::hypot(q_x, q_y), std::atan2(q_y + 0.0, q_x + 0.0)};
}

Eigen::Vector2d bending(double theta, double phi) noexcept {
  return {theta * std::cos(phi), theta * std::sin(phi)};
}

void polar_along(const RowMatrixXd& q, RowMatrixXd& theta, RowMatrixXd& phi) {
  const Index num_samples = q.rows(), n = q.cols() / 2;
  theta.resize(num_samples, n);
  phi.resize(num_samples, n);
  for (Index s = 0; s < n; ++s) {
    double previous = 0.0;
    for (Index i = 0; i < num_samples; ++i) {  // a straight start takes the first direction
      const Polar first = polar(q(i, 2 * s), q(i, 2 * s + 1));
      if (first.theta > 0.0) {
        previous = first.phi;
        break;
      }
    }
    for (Index i = 0; i < num_samples; ++i) {
      Polar now = polar(q(i, 2 * s), q(i, 2 * s + 1));
      if (now.theta > 0.0) {
        double turn = std::remainder(now.phi - previous, 2.0 * pi);
        // The branch taken before may have theta < 0; either branch is a valid description.
        if (std::abs(turn) > swing_angle) {
          now.theta = -now.theta;
          turn = std::remainder(turn - pi, 2.0 * pi);
        }
        previous += turn;
      }
      theta(i, s) = now.theta;
      phi(i, s) = previous;
    }
  }
}

}  // namespace cdcr
