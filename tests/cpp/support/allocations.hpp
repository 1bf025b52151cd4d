#pragma once

// Counts this thread's heap allocations, C and C++ alike, by standing in for malloc and its kin.
// Under AddressSanitizer and ThreadSanitizer, which do the same, counting is off and the counts
// stay zero.

#include "sanitizers.hpp"

namespace cdcr::test {

#if CDCR_ADDRESS_SANITIZER || CDCR_THREAD_SANITIZER || !defined(__GLIBC__)
inline constexpr bool allocations_counted = false;
#else
inline constexpr bool allocations_counted = true;
#endif

/// Allocations of this thread so far.
long allocations() noexcept;

/// Lets the n-th allocation of this thread from here on fail, 0 being the next.
void fail_allocation(long n) noexcept;

/// Allocations made by a call.
template <class Call>
long allocations_of(Call&& call) {
  const long before = allocations();
  call();
  return allocations() - before;
}

}  // namespace cdcr::test
