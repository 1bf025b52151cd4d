#pragma once

#include <Eigen/Core>
#include <limits>

#include "section/polynomial_table.hpp"

namespace cdcr::detail {

/// W doubles of as many states, worked on at once: a scalar to Eigen, on which the recursions run
/// as they are. To be used within a function compiled for registers of this width
/// (batch/lanes.hpp): how such a number is passed by value depends on that, so that everything here
/// is inlined.
template <int W>
struct alignas(8 * W) Pack {
  typedef double Native __attribute__((vector_size(8 * W)));  // NOLINT(modernize-use-using)
  Native lanes;

  Pack() = default;
  // By the register: what the compiler makes of its own accord, GCC copies in halves.
  [[gnu::always_inline]] Pack(const Pack& b) : lanes(b.lanes) {}
  [[gnu::always_inline]] Pack& operator=(const Pack& b) {
    lanes = b.lanes;
    return *this;
  }
  // NOLINTNEXTLINE(google-explicit-constructor)
  [[gnu::always_inline]] Pack(double value) : lanes(value - Native{}) {}
  [[gnu::always_inline]] explicit Pack(const Native& values) : lanes(values) {}

  [[gnu::always_inline]] Pack& operator+=(const Pack& b) {
    lanes += b.lanes;
    return *this;
  }
  [[gnu::always_inline]] Pack& operator-=(const Pack& b) {
    lanes -= b.lanes;
    return *this;
  }
  [[gnu::always_inline]] Pack& operator*=(const Pack& b) {
    lanes *= b.lanes;
    return *this;
  }
  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) {
    return Pack(a.lanes + b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) {
    return Pack(a.lanes - b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) {
    return Pack(a.lanes * b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) {
    return Pack(a.lanes / b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a) { return Pack(-a.lanes); }
};

/// values[f] = sum_k c(k, f) t^k; even and odd powers apart, for short chains of dependency.
template <int N, int W, class Coefficient>
[[gnu::always_inline]] inline void sum_powers(const Pack<W>& t, const Coefficient& c,
                                              Pack<W>* values) {
  constexpr int together = 4;  // functions, whose sums stay in registers
  const Pack<W> u = t * t;
  for (int first = 0; first < N; first += together) {
    const int count = N - first < together ? N - first : together;
    Pack<W> odd[together], even[together];
    for (int f = 0; f < count; ++f) {
      odd[f] = c(num_powers - 1, first + f);
      even[f] = c(num_powers - 2, first + f);
    }
    for (int k = num_powers - 3; k > 0; k -= 2) {
      for (int f = 0; f < count; ++f) {
        odd[f] = odd[f] * u + c(k, first + f);
        even[f] = even[f] * u + c(k - 1, first + f);
      }
    }
    for (int f = 0; f < count; ++f) values[first + f] = even[f] + t * odd[f];
  }
}

/// The functions of a table in all lanes; NaN in those beyond the largest bending angle.
template <int N, int W>
[[gnu::always_inline]] inline void read(const PolynomialTable<N>& table, const Pack<W>& sigma,
                                        Eigen::Array<Pack<W>, N, 1>& f) {
  // Mostly all lanes lie in the piece of the first.
  double place = 0.0;
  const double first = sigma.lanes[0];
  const int piece = first <= sigma_limit ? find_piece(first, place) : 0;
  Pack<W> t = 2.0 * (sigma * Pack<W>(1.0 / piece_width) - Pack<W>(piece)) - Pack<W>(1.0);
  const auto inside = (t.lanes >= -1.0) & (t.lanes < 1.0);
  auto all_inside = inside[0];
  for (int i = 1; i < W; ++i) all_inside &= inside[i];
  if (all_inside != 0) {
    const double* row = table.piece(piece);
    sum_powers<N>(t, [row](int k, int j) { return Pack<W>(row[k * N + j]); }, f.data());
    return;
  }
  const double* rows[W];
  for (int i = 0; i < W; ++i) {
    place = std::numeric_limits<double>::quiet_NaN();
    rows[i] = table.piece(sigma.lanes[i] <= sigma_limit ? find_piece(sigma.lanes[i], place) : 0);
    t.lanes[i] = place;
  }
  const auto gather = [&rows](int k, int j) {
    Pack<W> c;
    for (int i = 0; i < W; ++i) c.lanes[i] = rows[i][k * N + j];
    return c;
  };
  sum_powers<N>(t, gather, f.data());
}

}  // namespace cdcr::detail

namespace Eigen {

template <int W>
struct NumTraits<cdcr::detail::Pack<W>> : GenericNumTraits<cdcr::detail::Pack<W>> {
  enum {  // NOLINTBEGIN(readability-identifier-naming): names of Eigen
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };  // NOLINTEND(readability-identifier-naming)
};
template <int W, class Operation>
struct ScalarBinaryOpTraits<cdcr::detail::Pack<W>, double, Operation> {
  using ReturnType = cdcr::detail::Pack<W>;
};
template <int W, class Operation>
struct ScalarBinaryOpTraits<double, cdcr::detail::Pack<W>, Operation> {
  using ReturnType = cdcr::detail::Pack<W>;
};

// Packs are aligned by themselves, further than Eigen aligns its arrays; Clang refuses less.
namespace internal {
template <int W, int Size>
struct compute_default_alignment<cdcr::detail::Pack<W>, Size> {
  enum { value = 0 };  // NOLINT(readability-identifier-naming): a name of Eigen
};
}  // namespace internal

}  // namespace Eigen
