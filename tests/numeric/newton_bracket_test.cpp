#include "keyline/numeric/newton_bracket.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

// x^2 - 2 at 1 is -1 with the slope 2: Newton goes to 1.5, and the zero is above 1.
TEST(NewtonBracket, TakesNewtonsStepWithin) {
  NewtonBracket between{0, 2};
  EXPECT_EQ(between.next(1, -1, 2), 1.5);
  EXPECT_EQ(between.low, 1);
  EXPECT_EQ(between.high, 2);
  EXPECT_EQ(between.next(1.5, 0.25, 3), 1.5 - 0.25 / 3);
  EXPECT_EQ(between.high, 1.5);
}

// Of x - 2 the zero is the end itself.
TEST(NewtonBracket, ReachesItsEnds) { EXPECT_EQ(NewtonBracket({0, 2}).next(1, -1, 1), 2); }

TEST(NewtonBracket, HalvesWhereTheStepIsOfNoUse) {
  EXPECT_EQ(NewtonBracket({0, 2}).next(1, -1, 0.1), 1.5);  // it leads past an end
  EXPECT_EQ(NewtonBracket({0, 2}).next(1, 1, 0), 0.5);     // there is none
  EXPECT_EQ(NewtonBracket({0, 2}).next(1, 1e-20, -1),
            0.5);  // away from a zero through which it falls
}

// Newton's steps for the cube root go to -2x, ever farther off; every other one at least halves the
// bracket.
TEST(NewtonBracket, FindsWhatNewtonAloneLoses) {
  NewtonBracket between{-1, 2};
  double x = 0.9;
  for (int i = 0; i < 60; ++i) x = between.next(x, std::cbrt(x), 1 / (3 * std::cbrt(x * x)));
  EXPECT_NEAR(x, 0, std::ldexp(3, -30));
}

}  // namespace
}  // namespace keyline::numeric
