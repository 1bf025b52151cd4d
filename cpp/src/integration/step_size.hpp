#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "cdcr/integrator.hpp"

// What first steps are chosen by.

namespace cdcr::detail {

/// Root mean square of v in units of the tolerances at y.
inline double weighted_norm(const VectorXd& v, const VectorXd& y, double rtol, double atol) {
  double sum = 0.0;
  for (Index i = 0; i < v.size(); ++i) {
    const double scaled = v[i] / (atol + rtol * std::abs(y[i]));
    sum += scaled * scaled;
  }
  return std::sqrt(sum / static_cast<double>(v.size()));
}

/// Steps below it are lost in the time, from t to the end of a stretch [s].
inline double time_resolution(double t, double end) {
  return 4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t), std::abs(end));
}

}  // namespace cdcr::detail
