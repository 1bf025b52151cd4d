#pragma once

#include <nvector/nvector_serial.h>

#include <cmath>

// Vector operations for a handful of states. Those of the serial N_Vector choose between special
// cases at every call, which costs more than the arithmetic itself: with these plain loops a
// step of CVODE on four states takes about three fifths of the time.

namespace cdcr::detail {

/// z = a x + b y; as in all operations here, z may be x or y.
inline void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) noexcept {
  const double *from_x = NV_DATA_S(x), *from_y = NV_DATA_S(y);
  double* to = NV_DATA_S(z);
  for (sunindextype i = 0, n = NV_LENGTH_S(z); i < n; ++i) to[i] = a * from_x[i] + b * from_y[i];
}

/// z = a x
inline void scale(double a, N_Vector x, N_Vector z) noexcept {
  const double* from = NV_DATA_S(x);
  double* to = NV_DATA_S(z);
  for (sunindextype i = 0, n = NV_LENGTH_S(z); i < n; ++i) to[i] = a * from[i];
}

/// Root mean square of x_i w_i.
inline double weighted_norm(N_Vector x, N_Vector w) noexcept {
  const double *value = NV_DATA_S(x), *weight = NV_DATA_S(w);
  const sunindextype n = NV_LENGTH_S(x);
  double sum = 0.0;
  for (sunindextype i = 0; i < n; ++i) {
    const double weighted = value[i] * weight[i];
    sum += weighted * weighted;
  }
  return std::sqrt(sum / static_cast<double>(n));
}

/// z = sum over k of c_k x_k
inline int linear_combination(int count, double* c, N_Vector* x, N_Vector z) noexcept {
  double* to = NV_DATA_S(z);
  for (sunindextype i = 0, n = NV_LENGTH_S(z); i < n; ++i) {
    double sum = 0.0;
    for (int k = 0; k < count; ++k) sum += c[k] * NV_DATA_S(x[k])[i];
    to[i] = sum;
  }
  return 0;
}

/// z_k = a_k x + y_k
inline int scale_add_multi(int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) noexcept {
  for (int k = 0; k < count; ++k) linear_sum(a[k], x, 1.0, y[k], z[k]);
  return 0;
}

/// z_k = c_k x_k
inline int scale_all(int count, double* c, N_Vector* x, N_Vector* z) noexcept {
  for (int k = 0; k < count; ++k) scale(c[k], x[k], z[k]);
  return 0;
}

/// Gives a serial vector, and all vectors cloned from it, the operations above.
inline void use_small_operations(N_Vector v) noexcept {
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvscale = scale;
  v->ops->nvwrmsnorm = weighted_norm;
  v->ops->nvlinearcombination = linear_combination;
  v->ops->nvscaleaddmulti = scale_add_multi;
  v->ops->nvscalevectorarray = scale_all;
}

}  // namespace cdcr::detail
