#pragma once

#include <Eigen/Core>

#include "base/number_traits.hpp"

namespace cdcr::detail {

/// Four doubles that are worked on at once, by one instruction where the processor has it. A scalar
/// to Eigen.
// NOLINTNEXTLINE(cppcoreguidelines-special-member-functions): the rest are the compiler's
struct alignas(32) Quad {                                  // as packs are where there is AVX
  typedef double Native __attribute__((vector_size(32)));  // NOLINT(modernize-use-using)
  static constexpr int count = 4;
  Native all;

  Quad() = default;
  Quad(double value) : all{value, value, value, value} {}  // NOLINT(google-explicit-constructor)
  /// By reference, since without AVX there is no register to pass one in.
  explicit Quad(const Native& values) : all(values) {}
  // As one number: of a struct GCC moves halves, and waits where the whole is read after them.
  Quad(const Quad& b) : all(b.all) {}
  Quad& operator=(const Quad& b) {
    all = b.all;  // NOLINT(bugprone-unhandled-self-assignment,cert-oop54-cpp): no harm done
    return *this;
  }

  double& operator[](int lane) { return reinterpret_cast<double*>(&all)[lane]; }
  double operator[](int lane) const { return reinterpret_cast<const double*>(&all)[lane]; }

  Quad& operator+=(const Quad& b) {
    all += b.all;
    return *this;
  }
  Quad& operator-=(const Quad& b) {
    all -= b.all;
    return *this;
  }
  Quad& operator*=(const Quad& b) {
    all *= b.all;
    return *this;
  }
  friend Quad operator+(const Quad& a, const Quad& b) { return Quad(Native(a.all + b.all)); }
  friend Quad operator-(const Quad& a, const Quad& b) { return Quad(Native(a.all - b.all)); }
  friend Quad operator*(const Quad& a, const Quad& b) { return Quad(Native(a.all * b.all)); }
  friend Quad operator-(const Quad& a) { return Quad(Native(-a.all)); }
};

}  // namespace cdcr::detail

namespace Eigen {

template <>
struct NumTraits<cdcr::detail::Quad> : cdcr::detail::NumberTraits<cdcr::detail::Quad> {};
template <class Operation>
struct ScalarBinaryOpTraits<cdcr::detail::Quad, double, Operation> {
  using ReturnType = cdcr::detail::Quad;
};
template <class Operation>
struct ScalarBinaryOpTraits<double, cdcr::detail::Quad, Operation> {
  using ReturnType = cdcr::detail::Quad;
};

// Quads are aligned by themselves, further than Eigen aligns its arrays; Clang refuses less.
namespace internal {
template <int Size>
struct compute_default_alignment<cdcr::detail::Quad, Size> {
  enum { value = 0 };  // NOLINT(readability-identifier-naming): a name of Eigen
};
}  // namespace internal

}  // namespace Eigen
