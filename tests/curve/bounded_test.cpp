#include "keyline/curve/bounded.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

/// Bounds by the arithmetic of intervals: the extreme corners of what the numbers may be.
namespace keyline::curve::detail {
namespace {

constexpr double kSlack = 1e-14;

TEST(Bounded, SumsAndDifferencesAddTheirErrors) {
  for (const Bounded& x :
       {Bounded(2, 0.25) + Bounded(3, 0.5), Bounded(2, 0.25) - Bounded(-3, 0.5)}) {
    EXPECT_EQ(x.value, 5);
    EXPECT_GE(x.error, 0.75);
    EXPECT_LE(x.error, 0.75 + kSlack);
  }
}

TEST(Bounded, ProductsAndQuotientsReachTheirCorners) {
  const Bounded a(2, 0.1), b(-3, 0.2);
  const Bounded product = a * b;
  EXPECT_EQ(product.value, -6);
  EXPECT_GE(product.error, 2.1 * 3.2 - 6);
  EXPECT_LE(product.error, 2.1 * 3.2 - 6 + kSlack);
  const Bounded quotient = a / b;
  EXPECT_NEAR(quotient.value, -2.0 / 3, 1e-16);
  EXPECT_GE(quotient.error, 2.1 / 2.8 - 2.0 / 3 - kSlack);
  EXPECT_LE(quotient.error, 2.1 / 2.8 - 2.0 / 3 + kSlack);
  const Bounded half = half_sum(a, b);
  EXPECT_EQ(half.value, -0.5);
  EXPECT_NEAR(half.error, 0.15, kSlack);
}

TEST(Bounded, RoundingIsInTheBound) {
  const Bounded sum = Bounded(1.0) + Bounded(0x1p-60);
  EXPECT_GE(sum.error, 0x1p-60);
  EXPECT_LE(sum.error, 0x1p-50);
  const Bounded third = Bounded(1.0) / Bounded(3.0);
  EXPECT_GE(third.error, std::abs(static_cast<double>(1.0L / 3 - third.value)));
  EXPECT_LE(third.error, 0x1p-52);
  const Bounded square = Bounded(1 + 0x1p-30) * Bounded(1 + 0x1p-30);  // 2^-60 is lost
  EXPECT_GE(square.error, 0x1p-60);
  EXPECT_LE(square.error, 0x1p-50);
}

TEST(Bounded, UnderflowIsInTheBound) {
  for (const Bounded& x : {Bounded(1e-200) * Bounded(1e-200), Bounded(-1e-200) / Bounded(1e200)})
    EXPECT_EQ(sign_of(x), Sign::unknown);
  EXPECT_EQ(sign_of(Bounded(0.0) * Bounded(3.0)), Sign::zero);
  EXPECT_EQ(sign_of(Bounded(3.0) * Bounded(0.0)), Sign::zero);
  EXPECT_EQ(sign_of(Bounded(0.0) / Bounded(3.0)), Sign::zero);
  EXPECT_EQ(sign_of(Bounded(1e-100) * Bounded(1e-100)), Sign::positive);
}

TEST(Bounded, SignsAreKnownOutsideTheError) {
  EXPECT_EQ(sign_of(Bounded(2, 1)), Sign::positive);
  EXPECT_EQ(sign_of(Bounded(-2, 1)), Sign::negative);
  for (const double v : {1.0, 0.5, 0.0, -0.5, -1.0})
    EXPECT_EQ(sign_of(Bounded(v, 1)), Sign::unknown) << v;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sign_of(Bounded(2, nan)), Sign::unknown);
  EXPECT_EQ(sign_of(Bounded(2, std::numeric_limits<double>::infinity())), Sign::unknown);
}

}  // namespace
}  // namespace keyline::curve::detail
