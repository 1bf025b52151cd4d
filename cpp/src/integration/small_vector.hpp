#pragma once

#include <nvector/nvector_serial.h>

#include <algorithm>
#include <array>
#include <cmath>

// Vector operations for a handful of states. Those of the serial N_Vector choose between special
// cases at every call, which costs more than the arithmetic itself: with these plain loops a
// step of CVODE on four states takes about three fifths of the time.

namespace cdcr::detail {

/// These operations on vectors of `size` numbers; 0 stands for any number.
template <int size>
struct SmallVector {
  static sunindextype size_of(N_Vector v) noexcept { return size > 0 ? size : NV_LENGTH_S(v); }

  /// z_i = f(i). As in all operations here z may be what f reads, which for a size that is known
  /// is read before anything is written.
  template <class F>
  static void set(N_Vector z, const F& f) noexcept {
    double* to = NV_DATA_S(z);
    if constexpr (size > 0) {
      std::array<double, size> values;
      for (int i = 0; i < size; ++i) values[static_cast<std::size_t>(i)] = f(i);
      std::copy_n(values.data(), size, to);
    } else {
      for (sunindextype i = 0, n = size_of(z); i < n; ++i) to[i] = f(i);
    }
  }

  static void fill(double value, N_Vector z) noexcept {
    set(z, [&](auto /*i*/) { return value; });
  }
  /// z = a x + b y
  static void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) noexcept {
    const double *from_x = NV_DATA_S(x), *from_y = NV_DATA_S(y);
    set(z, [&](auto i) { return a * from_x[i] + b * from_y[i]; });
  }
  /// z = a x
  static void scale(double a, N_Vector x, N_Vector z) noexcept {
    const double* from = NV_DATA_S(x);
    set(z, [&](auto i) { return a * from[i]; });
  }
  /// Root mean square of x_i w_i.
  static double weighted_norm(N_Vector x, N_Vector w) noexcept {
    const double *value = NV_DATA_S(x), *weight = NV_DATA_S(w);
    const sunindextype n = size_of(x);
    double sum = 0.0;
    for (sunindextype i = 0; i < n; ++i) {
      const double weighted = value[i] * weight[i];
      sum += weighted * weighted;
    }
    return std::sqrt(sum / static_cast<double>(n));
  }
  /// z = sum over k of c_k x_k
  static int linear_combination(int count, double* c, N_Vector* x, N_Vector z) noexcept {
    set(z, [&](auto i) {
      double sum = 0.0;
      for (int k = 0; k < count; ++k) sum += c[k] * NV_DATA_S(x[k])[i];
      return sum;
    });
    return 0;
  }
  /// z_k = a_k x + y_k
  static int scale_add_multi(int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) noexcept {
    for (int k = 0; k < count; ++k) linear_sum(a[k], x, 1.0, y[k], z[k]);
    return 0;
  }
  /// z_k = c_k x_k
  static int scale_all(int count, double* c, N_Vector* x, N_Vector* z) noexcept {
    for (int k = 0; k < count; ++k) scale(c[k], x[k], z[k]);
    return 0;
  }

  static void serve(N_Vector v) noexcept {
    v->ops->nvconst = fill;
    v->ops->nvlinearsum = linear_sum;
    v->ops->nvscale = scale;
    v->ops->nvwrmsnorm = weighted_norm;
    v->ops->nvlinearcombination = linear_combination;
    v->ops->nvscaleaddmulti = scale_add_multi;
    v->ops->nvscalevectorarray = scale_all;
  }
};

/// Gives a serial vector, and all vectors cloned from it, the operations above: of the four states
/// of one section those with unrolled loops.
inline void use_small_operations(N_Vector v) noexcept {
  NV_LENGTH_S(v) == 4 ? SmallVector<4>::serve(v) : SmallVector<0>::serve(v);
}

}  // namespace cdcr::detail
