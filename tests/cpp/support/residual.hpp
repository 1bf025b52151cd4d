#pragma once

#include <cmath>
#include <ostream>

#include "cdcr/types.hpp"
#include "settings.hpp"

namespace cdcr::test {

/// A relative difference. Compared with <= to a tolerance times CDCR_TOL_SCALE; NaN never passes.
struct Residual {
  double value;
};

/// With CDCR_RESIDUALS=1, prints a residual over its tolerance, the tolerance and the test, in
/// columns with tabs between them, to stderr.
void tell(Residual residual, double tolerance);

inline bool operator<=(Residual residual, double tolerance) {
  tell(residual, tolerance);
  return residual.value <= tolerance * tolerance_scale();
}

inline std::ostream& operator<<(std::ostream& out, Residual residual) {
  return out << residual.value;
}

/// Largest magnitude; NaN where there is one.
template <class Derived>
double largest(const Eigen::MatrixBase<Derived>& values) {
  double found = 0.0;
  for (Index j = 0; j < values.cols(); ++j) {
    for (Index i = 0; i < values.rows(); ++i) {
      const auto magnitude = static_cast<double>(std::abs(values(i, j)));
      if (!(magnitude <= found)) found = magnitude;
      if (std::isnan(found)) return found;
    }
  }
  return found;
}

/// Largest difference over `scale`; a difference of exactly zero needs no scale.
template <class A, class B>
Residual residual(const Eigen::MatrixBase<A>& actual, const Eigen::MatrixBase<B>& expected,
                  double scale) {
  const double difference =
      largest(actual.template cast<long double>() - expected.template cast<long double>());
  return {difference == 0.0 ? 0.0 : difference / scale};
}

/// Largest difference over the largest expected magnitude.
template <class A, class B>
Residual residual(const Eigen::MatrixBase<A>& actual, const Eigen::MatrixBase<B>& expected) {
  return residual(actual, expected, largest(expected));
}

inline Residual residual(long double actual, long double expected, long double scale) {
  const long double difference = std::abs(actual - expected);
  return {difference == 0.0L ? 0.0 : static_cast<double>(difference / scale)};
}

inline Residual residual(long double actual, long double expected) {
  return residual(actual, expected, std::abs(expected));
}

}  // namespace cdcr::test
