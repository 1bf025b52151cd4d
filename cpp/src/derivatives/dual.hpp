#pragma once

#include <algorithm>
#include <cmath>

#include "cdcr/robot.hpp"
#include "derivatives/quad.hpp"
#include "section/polynomial_table.hpp"

// Derivatives to rounding, without formulas: what is written for any scalar runs on dual numbers.

namespace cdcr::detail {

/// A number and its derivatives in four directions at once. A scalar to Eigen.
struct Dual {
  static constexpr int width = Quad::count;

  Dual() = default;
  Dual(double x) : number(x), slopes(0.0) {}  // NOLINT(google-explicit-constructor)
  Dual(const Quad& x, const Quad& d) : number(x), slopes(d) {}

  [[nodiscard]] double value() const { return number[0]; }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.number + b.number, a.slopes + b.slopes};
  }
  friend Dual operator+(const Dual& a, double b) { return {a.number + b, a.slopes}; }
  friend Dual operator+(double a, const Dual& b) { return {a + b.number, b.slopes}; }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return {a.number - b.number, a.slopes - b.slopes};
  }
  friend Dual operator-(const Dual& a, double b) { return {a.number - b, a.slopes}; }
  friend Dual operator-(double a, const Dual& b) { return {a - b.number, -b.slopes}; }
  friend Dual operator-(const Dual& a) { return {-a.number, -a.slopes}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.number * b.number, a.number * b.slopes + b.number * a.slopes};
  }
  friend Dual operator*(const Dual& a, double b) { return {a.number * b, a.slopes * b}; }
  friend Dual operator*(double a, const Dual& b) { return {a * b.number, a * b.slopes}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double inverse = 1.0 / b.value(), quotient = a.value() * inverse;
    return {quotient, inverse * (a.slopes - quotient * b.slopes)};
  }
  friend Dual operator/(const Dual& a, double b) { return a * (1.0 / b); }
  friend Dual operator/(double a, const Dual& b) { return Dual(a) / b; }

  friend bool operator<(const Dual& a, const Dual& b) { return a.value() < b.value(); }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.value() <= b.value(); }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value() > b.value(); }

  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value());
    return a.with(root, 0.5 / root);
  }
  friend Dual exp(const Dual& a) {
    const double power = std::exp(a.value());
    return a.with(power, power);
  }
  friend Dual sinh(const Dual& a) { return a.with(std::sinh(a.value()), std::cosh(a.value())); }
  friend Dual tanh(const Dual& a) {
    const double t = std::tanh(a.value());
    return a.with(t, 1.0 - t * t);
  }
  friend Dual abs(const Dual& a) { return a.value() < 0.0 ? -a : a; }

  Quad number;  // in all lanes
  Quad slopes;

 private:
  /// f of it and f'.
  [[nodiscard]] Dual with(double f, double slope) const { return {f, slope * slopes}; }
};

template <int N>
void read(const PolynomialTable<N>& table, const Dual& sigma, Eigen::Array<Dual, N, 1>& f) {
  Eigen::Array<double, N, 1> values, slopes;
  table(sigma.value(), values, slopes);
  for (int k = 0; k < N; ++k) f[k] = Dual(values[k], slopes[k] * sigma.slopes);
}

/// Adds `factor` times dy/dx (size, size) of f(const Dual* x, Dual* y), whose y begin at zero, to
/// J.
template <class F>
void differentiate(Index size, const double* x, MatrixRef J, double factor, const F& f) {
  Dual in[max_coordinates], out[max_coordinates];
  for (Index i = 0; i < size; ++i) in[i] = Dual(x[i]);
  for (Index first = 0; first < size; first += Dual::width) {
    const int count = static_cast<int>(std::min<Index>(Dual::width, size - first));
    for (Index i = 0; i < size; ++i) out[i] = Dual(0.0);
    for (int k = 0; k < count; ++k) in[first + k].slopes[k] = 1.0;
    f(static_cast<const Dual*>(in), static_cast<Dual*>(out));
    for (int k = 0; k < count; ++k) {
      for (Index i = 0; i < size; ++i) J(i, first + k) += factor * out[i].slopes[k];
      in[first + k].slopes[k] = 0.0;
    }
  }
}

}  // namespace cdcr::detail

namespace Eigen {

template <>
struct NumTraits<cdcr::detail::Dual> : NumTraits<cdcr::detail::Quad> {
  using Real = cdcr::detail::Dual;
  using NonInteger = cdcr::detail::Dual;
  using Nested = cdcr::detail::Dual;
  using Literal = double;
};
template <class Operation>
struct ScalarBinaryOpTraits<cdcr::detail::Dual, double, Operation> {
  using ReturnType = cdcr::detail::Dual;
};
template <class Operation>
struct ScalarBinaryOpTraits<double, cdcr::detail::Dual, Operation> {
  using ReturnType = cdcr::detail::Dual;
};

// Duals are aligned by themselves, further than Eigen aligns its arrays; Clang refuses less.
namespace internal {
template <int Size>
struct compute_default_alignment<cdcr::detail::Dual, Size> {
  enum { value = 0 };  // NOLINT(readability-identifier-naming): a name of Eigen
};
}  // namespace internal

}  // namespace Eigen
