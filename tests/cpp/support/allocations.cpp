#include "allocations.hpp"

#include <cstddef>
#include <cstdlib>  // also defines __GLIBC__, which allocations.hpp asks for

namespace {

thread_local long count = 0, failing = -1;

/// Counts an allocation; whether it is the one to fail.
[[maybe_unused]] bool fails() {
  return count++ == failing;
}

}  // namespace

long cdcr::test::allocations() noexcept {
  return count;
}

void cdcr::test::fail_allocation(long n) noexcept {
  failing = count + n;
}

#if !CDCR_ADDRESS_SANITIZER && !CDCR_THREAD_SANITIZER && defined(__GLIBC__)

// The allocator behind the names taken over here. operator new ends in malloc.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t number, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  return fails() ? nullptr : __libc_malloc(size);
}

void* calloc(std::size_t number, std::size_t size) {
  return fails() ? nullptr : __libc_calloc(number, size);
}

void* realloc(void* block, std::size_t size) {
  return fails() ? nullptr : __libc_realloc(block, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails() ? nullptr : __libc_memalign(alignment, size);
}
}

#endif
