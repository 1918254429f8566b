#include "keyline/numeric/monotone_cubic.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/numeric/random.h"

namespace keyline::numeric {
namespace {

// By hand: secants 2 and 1/2, their harmonic mean 4/5; halfway a cubic of Hermite's form is the
// mean of its ends plus an eighth of the span times the difference of its slopes.
TEST(MonotoneCubic, IsTheCubicOfHarmonicSlopes) {
  const std::vector<double> x{0, 1, 3};
  const std::vector<double> y{0, 2, 3};
  EXPECT_NEAR(monotone_cubic(x, y, 0.5), 1 + (2 - 0.8) / 8, 1e-15);
  EXPECT_NEAR(monotone_cubic(x, y, 2), 2.5 + 2 * (0.8 - 0.5) / 8, 1e-15);
  const std::vector<double> hill{0, 1, 0};  // level at the top
  EXPECT_NEAR(monotone_cubic(x, hill, 0.5), 0.5 + 1.0 / 8, 1e-15);
}

TEST(MonotoneCubic, GoesThroughItsPointsAndIsLevelBeyond) {
  const std::vector<double> x{-1, 0, 2, 5};
  const std::vector<double> y{3, 1, 1, -4};
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_EQ(monotone_cubic(x, y, x[k]), y[k]);
  EXPECT_EQ(monotone_cubic(x, y, -7), 3);
  EXPECT_EQ(monotone_cubic(x, y, 7), -4);
}

TEST(MonotoneCubic, RisesWhereThePointsRise) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    std::vector<double> x{0};
    std::vector<double> y{0};
    for (int k = 0; k < 6; ++k) {
      x.push_back(x.back() + random.uniform(0.1, 2));
      y.push_back(y.back() + (k % 3 == 0 ? 0 : random.uniform(0, 5)));
    }
    double before = 0;
    for (int i = 0; i <= 600; ++i) {
      const double now = monotone_cubic(x, y, x.back() * i / 600);
      EXPECT_GE(now, before - 1e-12) << seed;
      before = std::max(before, now);
    }
  }
}

}  // namespace
}  // namespace keyline::numeric
