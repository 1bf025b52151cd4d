#pragma once

// The sanitizer this is built with: GCC defines a macro for each, clang answers a question.

#ifdef __has_feature
#define CDCR_HAS_FEATURE(name) __has_feature(name)
#else
#define CDCR_HAS_FEATURE(name) 0
#endif

#if defined(__SANITIZE_ADDRESS__) || CDCR_HAS_FEATURE(address_sanitizer)
#define CDCR_ADDRESS_SANITIZER 1
#else
#define CDCR_ADDRESS_SANITIZER 0
#endif

#if defined(__SANITIZE_THREAD__) || CDCR_HAS_FEATURE(thread_sanitizer)
#define CDCR_THREAD_SANITIZER 1
#else
#define CDCR_THREAD_SANITIZER 0
#endif
