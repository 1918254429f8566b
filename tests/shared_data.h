#pragma once

#include <cstdlib>

#include <gtest/gtest.h>

/// Leaves a test that needs ../shared/data where they are absent: skipped on somebody's machine, a
/// failure where CI is set, since there they belong beside the tree.
#define KEYLINE_NEEDS_SHARED_DATA(present, what)                           \
  if (!(present)) {                                                        \
    if (std::getenv("CI")) FAIL() << "shared data are absent: " << (what); \
    GTEST_SKIP() << "shared data are absent: " << (what);                  \
  }                                                                        \
  static_assert(true)
