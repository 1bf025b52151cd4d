#pragma once

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <vector>

#include "cdcr/allocation.hpp"

// The best tensions for a generalised force by trying every choice of cables at their limits: slow
// and obvious.

namespace cdcr::test {

/// Sizes that the distance to a force and the norm of tensions are compared with.
inline double force_size(const Model& model, const VectorXd& force, const VectorXd& tension) {
  return force.norm() + model.actuation_matrix().norm() * tension.norm();
}

struct Best {
  double distance = std::numeric_limits<double>::infinity(),
         norm = std::numeric_limits<double>::infinity();
};

/// Calls body(F) for the best tensions of every choice of cables at lower, at upper, and free.
template <class Body>
void for_each_active_set(const Model& model, const VectorXd& force, const TensionLimits& limits,
                         Body body) {
  const MatrixXd& B = model.actuation_matrix();
  const Index count = model.num_cables();
  std::vector<bool> usable(static_cast<std::size_t>(count), limits.cables.empty());
  for (const Index cable : limits.cables) usable[static_cast<std::size_t>(cable)] = true;
  const int num_sets = static_cast<int>(std::lround(std::pow(3.0, count)));
  for (int set = 0; set < num_sets; ++set) {
    VectorXd F = VectorXd::Zero(count);
    std::vector<Index> free;
    bool possible = true;
    int rest = set;
    for (Index j = 0; j < count; ++j, rest /= 3) {
      const int place = rest % 3;
      if (!usable[static_cast<std::size_t>(j)]) {
        possible = possible && place == 0;  // one of three is enough
        continue;
      }
      if (place == 2) {
        free.push_back(j);
        continue;
      }
      F[j] = place == 0 ? limits.min_tension : limits.max_tension;
      possible = possible && std::isfinite(F[j]);
    }
    if (!possible) continue;
    if (!free.empty()) {
      MatrixXd B_free(B.rows(), static_cast<Index>(free.size()));
      for (Index k = 0; k < B_free.cols(); ++k) {
        B_free.col(k) = B.col(free[static_cast<std::size_t>(k)]);
      }
      const VectorXd missing = force - B * F;
      const VectorXd F_free = B_free.completeOrthogonalDecomposition().solve(missing);
      for (Index k = 0; k < F_free.size(); ++k) F[free[static_cast<std::size_t>(k)]] = F_free[k];
    }
    body(F);
  }
}

inline bool within(const VectorXd& F, const TensionLimits& limits, double slack) {
  for (Index j = 0; j < F.size(); ++j) {
    if (F[j] < limits.min_tension - slack || F[j] > limits.max_tension + slack) return false;
  }
  return true;
}

/// Least distance, and the least norm of all that come as near.
inline Best best_of_all(const Model& model, const VectorXd& force, const TensionLimits& limits) {
  std::vector<VectorXd> found;
  for_each_active_set(model, force, limits, [&](const VectorXd& F) {
    VectorXd used = F;
    if (!limits.cables.empty()) {
      used.resize(static_cast<Index>(limits.cables.size()));
      for (Index k = 0; k < used.size(); ++k) {
        used[k] = F[limits.cables[static_cast<std::size_t>(k)]];
      }
    }
    if (within(used, limits, 1e-12 * (1.0 + F.norm()))) found.push_back(F);
  });
  Best best;
  const auto distance_of = [&](const VectorXd& F) {
    return (model.actuation_matrix() * F - force).norm();
  };
  for (const VectorXd& F : found) best.distance = std::fmin(best.distance, distance_of(F));
  for (const VectorXd& F : found) {
    const double slack = 1e-11 * force_size(model, force, F);
    if (distance_of(F) <= best.distance + slack) best.norm = std::fmin(best.norm, F.norm());
  }
  return best;
}

}  // namespace cdcr::test
