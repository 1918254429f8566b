#pragma once

/// KEYLINE_ADDRESS_SANITIZED and KEYLINE_THREAD_SANITIZED: defined where the compiler, gcc or
/// clang, builds with that sanitizer; KEYLINE_SHADOWED where either does, whose shadow memory is
/// larger than any limit.

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define KEYLINE_ADDRESS_SANITIZED
#endif
#if __has_feature(thread_sanitizer)
#define KEYLINE_THREAD_SANITIZED
#endif
#endif

#if defined(__SANITIZE_ADDRESS__) && !defined(KEYLINE_ADDRESS_SANITIZED)
#define KEYLINE_ADDRESS_SANITIZED
#endif
#if defined(__SANITIZE_THREAD__) && !defined(KEYLINE_THREAD_SANITIZED)
#define KEYLINE_THREAD_SANITIZED
#endif

#if defined(KEYLINE_ADDRESS_SANITIZED) || defined(KEYLINE_THREAD_SANITIZED)
#define KEYLINE_SHADOWED
#endif
