#include <cmath>

#include "cdcr/kinematics.hpp"

namespace cdcr {
namespace {

constexpr double full_circle = 2.0 * 3.14159265358979323846;

/// Squared distance, in units of the length, between the tip at angle theta and the point
/// (rho, z) of the bending plane.
double squared_distance(double theta, double rho, double z) noexcept {
  const double half = std::sin(0.5 * theta);
  const double sideways = theta > 0.0 ? 2.0 * half * half / theta : 0.0;
  const double upwards = theta > 0.0 ? std::sin(theta) / theta : 1.0;
  return (sideways - rho) * (sideways - rho) + (upwards - z) * (upwards - z);
}

/// Angle of the nearest point of the tip curve: the best of a grid fine enough to tell its
/// valleys apart, then golden section search between the neighbours of that point.
double nearest_angle(double rho, double z) noexcept {
  constexpr int num_points = 256;
  constexpr double spacing = full_circle / num_points;
  int best = 0;
  for (int i = 1; i <= num_points; ++i) {
    if (squared_distance(i * spacing, rho, z) < squared_distance(best * spacing, rho, z)) best = i;
  }
  double low = std::fmax(0.0, (best - 1) * spacing);
  double high = std::fmin(full_circle, (best + 1) * spacing);
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (high - low > 1e-9) {  // a minimum is located to the square root of rounding at best
    const double left = high - golden * (high - low);
    const double right = low + golden * (high - low);
    if (squared_distance(left, rho, z) < squared_distance(right, rho, z)) {
      high = right;
    } else {
      low = left;
    }
  }
  const double middle = 0.5 * (low + high);
  // The ends of the range are candidates of their own: the search never quite reaches them.
  double theta = middle;
  for (const double end : {0.0, full_circle}) {
    if (squared_distance(end, rho, z) < squared_distance(theta, rho, z)) theta = end;
  }
  return theta;
}

}  // namespace

InverseKinematics inverse_kinematics(const Model& model, const Vector3d& p) noexcept {
  // What counts as rounding error in a distance, in units of the length.
  constexpr double rounding = 1e-14;
  const double length = model.robot().sections[0].length;
  const double rho = std::hypot(p[0], p[1]);
  const double u = rho / length, z = p[2] / length;

  double theta = 2.0 * std::atan2(rho, p[2]);  // eq. (7): the chord leaves at half the angle
  if (rho == 0.0 && p[2] <= 0.0) theta = full_circle;
  if (!(squared_distance(theta, u, z) <= rounding * rounding)) {
    const double nearest = nearest_angle(u, z);
    if (squared_distance(nearest, u, z) < squared_distance(theta, u, z)) theta = nearest;
  }

  InverseKinematics answer;
  const Eigen::Vector2d direction =
      rho > 0.0 ? Eigen::Vector2d(p[0] / rho, p[1] / rho) : Eigen::Vector2d::UnitX();
  answer.q = theta * direction;
  answer.position = tip(model, answer.q).p;
  answer.distance = (answer.position - p).norm();
  answer.reachable = answer.distance <= 100.0 * rounding * length;
  return answer;
}

}  // namespace cdcr
