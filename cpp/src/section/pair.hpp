#pragma once

#include <Eigen/Core>
#include <cstring>
#include <type_traits>

#include "base/number_traits.hpp"

namespace cdcr::detail {

/// Two doubles that are worked on at once, by one instruction where the processor has it. A scalar
/// to Eigen.
struct Pair {
  typedef double Native __attribute__((vector_size(16)));  // NOLINT(modernize-use-using)
  Native both;

  Pair() = default;
  Pair(double value) : both{value, value} {}  // NOLINT(google-explicit-constructor)
  explicit Pair(Native values) : both(values) {}

  Pair& operator+=(Pair b) { return *this = *this + b; }
  Pair& operator-=(Pair b) { return *this = *this - b; }
  Pair& operator*=(Pair b) { return *this = *this * b; }
  friend Pair operator+(Pair a, Pair b) { return Pair(a.both + b.both); }
  friend Pair operator-(Pair a, Pair b) { return Pair(a.both - b.both); }
  friend Pair operator*(Pair a, Pair b) { return Pair(a.both * b.both); }
  friend Pair operator/(Pair a, Pair b) { return Pair(a.both / b.both); }
  friend Pair operator-(Pair a) { return Pair(-a.both); }
  friend Pair sqrt(Pair a) {
    const Eigen::Array2d root = Eigen::Array2d(a.both[0], a.both[1]).sqrt();
    return Pair(Native{root[0], root[1]});
  }
};

/// How many numbers S are worked on at once, and as what: two doubles, one of any other.
template <class S>
struct Lanes {
  using Pack = S;
  using Weights = double;  // what packs are multiplied by
  static constexpr int count = 1;

  static Weights weights(const double* from) { return *from; }
  static const Pack& load(const S* from) { return *from; }
  static void store(const Pack& pack, S* to) { *to = pack; }
  static S total(const Pack& pack) { return pack; }
  /// Both, next to one another, the lanes this far apart.
  static void store(const Pack& a, const Pack& b, S* to, int /*apart*/) {
    to[0] = a;
    to[1] = b;
  }
  static S get(const Pack& pack, int) { return pack; }
  static void set(Pack& pack, int, const S& value) { pack = value; }
  /// f(lane) of all.
  template <class F>
  static void each(const F& f) {
    f(std::integral_constant<int, 0>());
  }
};

template <>
struct Lanes<double> {
  using Pack = Pair;
  using Weights = Pair;
  static constexpr int count = 2;

  static Pair load(const double* from) {
    Pair pair;
    std::memcpy(&pair, from, sizeof pair);
    return pair;
  }
  static Pair weights(const double* from) { return load(from); }
  static void store(Pair pair, double* to) { std::memcpy(to, &pair, sizeof pair); }
  static double total(Pair pair) { return pair.both[0] + pair.both[1]; }
  static void store(Pair a, Pair b, double* to, int apart) {
    const Pair::Native first{a.both[0], b.both[0]}, second{a.both[1], b.both[1]};
    std::memcpy(to, &first, sizeof first);
    std::memcpy(to + apart, &second, sizeof second);
  }
  static double get(Pair pair, int lane) { return pair.both[lane]; }
  static void set(Pair& pair, int lane, double value) { pair.both[lane] = value; }
  template <class F>
  static void each(const F& f) {
    f(std::integral_constant<int, 0>());
    f(std::integral_constant<int, 1>());
  }
};

/// The same in rows of numbers that stand next to one another, aligned as packs are; four doubles.
template <class S>
struct Rows {
  using Pack = S;
  static constexpr int count = 1;
  static void clear(Pack* packs, int size) {
    for (int i = 0; i < size; ++i) packs[i] = S(0.0);
  }
};
template <>
struct Rows<double> {
  // NOLINTNEXTLINE(modernize-use-using)
  typedef double Pack __attribute__((vector_size(32), may_alias));
  static constexpr int count = 4;
  static void clear(Pack* packs, int size) {
    for (int i = 0; i < size; ++i) packs[i] = Pack{};
  }
};
inline constexpr std::size_t row_alignment = sizeof(Rows<double>::Pack);
template <class S>
[[nodiscard]] const typename Rows<S>::Pack* packs_of(const S* row) {
  return reinterpret_cast<const typename Rows<S>::Pack*>(row);
}
template <class S>
[[nodiscard]] typename Rows<S>::Pack* packs_of(S* row) {
  return reinterpret_cast<typename Rows<S>::Pack*>(row);
}

}  // namespace cdcr::detail

namespace Eigen {

template <>
struct NumTraits<cdcr::detail::Pair> : cdcr::detail::NumberTraits<cdcr::detail::Pair> {};
template <class Operation>
struct ScalarBinaryOpTraits<cdcr::detail::Pair, double, Operation> {
  using ReturnType = cdcr::detail::Pair;
};
template <class Operation>
struct ScalarBinaryOpTraits<double, cdcr::detail::Pair, Operation> {
  using ReturnType = cdcr::detail::Pair;
};

}  // namespace Eigen
