#include "keyline/numeric/lanes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace keyline::numeric::simd {
namespace {

TEST(ScalarMask, IsATruthValue) {
  for (const bool a : {false, true})
    for (const bool b : {false, true}) {
      EXPECT_EQ((ScalarMask(a) & ScalarMask(b)).on, a && b);
      EXPECT_EQ((ScalarMask(a) | ScalarMask(b)).on, a || b);
      EXPECT_EQ((!ScalarMask(a)).on, !a);
      EXPECT_EQ(any(ScalarMask(a)), a);
    }
  EXPECT_FALSE(ScalarMask().on);
}

TEST(Scalar, IsADouble) {
  for (const double a : {-2.5, 0.75, 3.0})
    for (const double b : {-1.5, 0.5, 3.0}) {
      const Scalar x(a), y(b);
      EXPECT_EQ((x + y).value, a + b);
      EXPECT_EQ((x - y).value, a - b);
      EXPECT_EQ((x * y).value, a * b);
      EXPECT_EQ((x / y).value, a / b);
      EXPECT_EQ((-x).value, -a);
      EXPECT_EQ((x < y).on, a < b);
      EXPECT_EQ((x > y).on, a > b);
      EXPECT_EQ((x == y).on, a == b);
      EXPECT_EQ(fma(x, y, Scalar(7)).value, a * b + 7);
      EXPECT_EQ(fnma(x, y, Scalar(7)).value, 7 - a * b);
      EXPECT_EQ(min(x, y).value, std::min(a, b));
      EXPECT_EQ(abs(x).value, std::abs(a));
      EXPECT_EQ(hadd(x), a);
      EXPECT_EQ(select(ScalarMask(true), x, y).value, a);
      EXPECT_EQ(select(ScalarMask(false), x, y).value, b);
      Scalar sum = x;
      sum += y;
      EXPECT_EQ(sum.value, a + b);
      double stored = 0;
      x.store_aligned(&stored);
      EXPECT_EQ(stored, a);
      EXPECT_EQ(Scalar::load_aligned(&b).value, b);
      EXPECT_EQ(x.get(0), a);
    }
}

}  // namespace
}  // namespace keyline::numeric::simd
