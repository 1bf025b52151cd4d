#pragma once

#include <Eigen/Core>

#include "cdcr/export.hpp"

// Eigen lays out its types and allocates them in other ways under -mavx, -march=native or a
// sanitizer, and a vector freed in another way than it was allocated in ruins the heap. So library
// and program must agree. The target cdcr::cdcr and cdcr.pc hand on EIGEN_MAX_ALIGN_BYTES=16 and
// EIGEN_MALLOC_ALREADY_ALIGNED=0: with these, flags make no difference to what crosses the
// interface, and each block of memory knows where it begins, however far it was aligned. Where they
// do not agree, linking fails for want of this symbol, whose name holds what the program was built
// with; the library defines its own (eigen_abi.cpp). Functions of Eigen that both instantiate are
// kept once by the linker, the program's where the library is static.
#define CDCR_JOIN_NOW(a, b, c, d) a##b##c##d
#define CDCR_JOIN(a, b, c, d) CDCR_JOIN_NOW(a, b, c, d)
#define CDCR_EIGEN_ABI                                                                  \
  CDCR_JOIN(build_cdcr_with_the_same_flags_alignment_, EIGEN_MAX_ALIGN_BYTES, _malloc_, \
            EIGEN_MALLOC_ALREADY_ALIGNED)

namespace cdcr::detail {
CDCR_EXPORT extern const char CDCR_EIGEN_ABI;
[[gnu::used]] inline const char* const eigen_abi = &CDCR_EIGEN_ABI;
}  // namespace cdcr::detail

// In programs too: the linker keeps one copy of what both instantiate of Eigen, maybe the
// program's.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "cdcr cannot be built with -ffast-math, -Ofast or a part of them: its checks would vanish"
#endif
