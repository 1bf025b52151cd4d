#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/number_traits.hpp"
#include "cdcr/types.hpp"

namespace cdcr::detail {

/// W doubles of as many states, worked on at once: a scalar to Eigen, on which the recursions run
/// as they are. To be used within a function compiled for registers of this width
/// (base/lanes.hpp): how such a number is passed by value depends on that, so that everything here
/// is inlined.
template <int W>
// NOLINTNEXTLINE(cppcoreguidelines-special-member-functions): copies by the register, below
struct alignas(8 * W) Pack {
  static constexpr int size = W;
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
  /// f(lane) in each: in a register at once, since one read after lanes were written waits for all.
  template <class F>
  [[gnu::always_inline]] static Pack of_lanes(const F& f) {
    if constexpr (W == 2) {
      return Pack(Native{f(0), f(1)});
    } else {
      static_assert(W == 4);
      return Pack(Native{f(0), f(1), f(2), f(3)});
    }
  }

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

  /// Of each lane, whether it is so.
  struct Mask {
    typedef std::int64_t Bits __attribute__((vector_size(8 * W)));  // NOLINT(modernize-use-using)
    Bits lanes;
  };
  [[gnu::always_inline]] friend Mask operator<(const Pack& a, const Pack& b) {
    return {a.lanes < b.lanes};
  }
  [[gnu::always_inline]] friend Mask operator>(const Pack& a, const Pack& b) {
    return {a.lanes > b.lanes};
  }
  [[gnu::always_inline]] friend Pack choose(const Mask& so, const Pack& a, const Pack& b) {
    return Pack(so.lanes ? a.lanes : b.lanes);
  }
};

template <int W>
[[nodiscard]] double get_lane(const Pack<W>& pack, Index lane) {
  return pack.lanes[lane];
}
template <int W>
void set_lane(Pack<W>& pack, Index lane, double value) {
  pack.lanes[lane] = value;
}

/// Two packs side by side, for what would wait for its own last result: a scalar to Eigen too.
template <int W>
// NOLINTNEXTLINE(cppcoreguidelines-special-member-functions): as of Pack
struct Twin {
  static constexpr int size = 2 * W;
  Pack<W> a, b;

  Twin() = default;
  // NOLINTNEXTLINE(google-explicit-constructor)
  [[gnu::always_inline]] Twin(double value) : a(value), b(value) {}
  [[gnu::always_inline]] Twin(const Pack<W>& first, const Pack<W>& second) : a(first), b(second) {}
  template <class F>
  [[gnu::always_inline]] static Twin of_lanes(const F& f) {
    return Twin(Pack<W>::of_lanes(f), Pack<W>::of_lanes([&](Index lane) { return f(W + lane); }));
  }
  [[gnu::always_inline]] Twin(const Twin& t) : a(t.a), b(t.b) {}
  [[gnu::always_inline]] Twin& operator=(const Twin& t) {
    a = t.a;
    b = t.b;
    return *this;
  }

  [[gnu::always_inline]] Twin& operator+=(const Twin& t) { return *this = *this + t; }
  [[gnu::always_inline]] Twin& operator-=(const Twin& t) { return *this = *this - t; }
  [[gnu::always_inline]] friend Twin operator+(const Twin& s, const Twin& t) {
    return Twin(s.a + t.a, s.b + t.b);
  }
  [[gnu::always_inline]] friend Twin operator-(const Twin& s, const Twin& t) {
    return Twin(s.a - t.a, s.b - t.b);
  }
  [[gnu::always_inline]] friend Twin operator*(const Twin& s, const Twin& t) {
    return Twin(s.a * t.a, s.b * t.b);
  }
  [[gnu::always_inline]] friend Twin operator/(const Twin& s, const Twin& t) {
    return Twin(s.a / t.a, s.b / t.b);
  }
};

template <int W>
[[nodiscard]] double get_lane(const Twin<W>& twin, Index lane) {
  return get_lane(lane < W ? twin.a : twin.b, lane % W);
}
template <int W>
void set_lane(Twin<W>& twin, Index lane, double value) {
  set_lane(lane < W ? twin.a : twin.b, lane % W, value);
}

}  // namespace cdcr::detail

namespace Eigen {

template <int W>
struct NumTraits<cdcr::detail::Pack<W>> : cdcr::detail::NumberTraits<cdcr::detail::Pack<W>> {};
template <int W>
struct NumTraits<cdcr::detail::Twin<W>> : NumTraits<cdcr::detail::Pack<W>> {};
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
template <int W, int Size>
struct compute_default_alignment<cdcr::detail::Twin<W>, Size>
    : compute_default_alignment<cdcr::detail::Pack<W>, Size> {};
}  // namespace internal

}  // namespace Eigen
