#include "keyline/lac/space/two_slopes.h"

#include <cmath>

#include <gtest/gtest.h>

/// Laws of two slopes by closed forms: the power -slope runs linearly along either piece.
namespace keyline::lac::detail::space {
namespace {

TEST(TwoSlopes, RunFromTheJointBothWays) {
  const TwoSlopes law{{-1, 2}, 0.4};
  const double rate = 0.5;
  EXPECT_NEAR(law.at(rate, 0.1), 1 - 0.5 * 0.3, 1e-15);
  EXPECT_NEAR(law.at(rate, 0.9), 1 / std::sqrt(1 - 2 * 0.5 * 0.5), 1e-15);
  EXPECT_EQ(law.at(rate, 0.4), 1);
  EXPECT_NEAR(law.at(4, 0), 1 - 4 * 0.4, 1e-15);  // through nought
  constexpr double kBy = 1e-6;
  for (const double t : {0.0, 0.2, 0.7, 1.0}) {
    const double slope = (law.at(rate + kBy, t) - law.at(rate - kBy, t)) / (2 * kBy);
    EXPECT_NEAR(law.by_rate(law.at(rate, t), t), slope, 1e-8);
  }
}

TEST(TwoSlopes, RatesDrawnOutHaveNoBound) {
  const TwoSlopes law{{2, 3}, 0.4};
  const double bound = 1 / (3 * 0.6);
  EXPECT_NEAR(law.bound(1), bound, 1e-15);
  EXPECT_NEAR(law.rate(1), bound * (1 - std::exp(-1 / bound)), 1e-15);
  EXPECT_NEAR(law.rate(1e-9), 1e-9, 1e-17);
  EXPECT_NEAR(law.rate_by(1), std::exp(-1 / bound), 1e-15);
  EXPECT_EQ(law.rate_by(0), 1);
  for (const double drawn : {-2.0, -0.1, 0.1, 2.0}) {
    ASSERT_TRUE(law.drawn(law.rate(drawn)));
    EXPECT_NEAR(*law.drawn(law.rate(drawn)), drawn, 1e-12);
    const auto ends = law.ends(drawn);
    ASSERT_TRUE(ends);
    const int grown = drawn < 0 ? 0 : 1;
    EXPECT_NEAR((*ends)[grown], std::exp(std::abs(drawn) * law.length(grown)), 1e-14);
    for (const int end : {0, 1})
      EXPECT_NEAR((*ends)[end], law.at(law.rate(drawn), end), 1e-9) << end;
  }
  EXPECT_FALSE(law.drawn(bound * 1.001));
  EXPECT_EQ((TwoSlopes{{-1, -1}, 0.4}.drawn(50)), 50);
  EXPECT_EQ((TwoSlopes{{1e-320, 5e-324}, 0.4}.rate(3)),
            3);  // of so small a slope the bound is none
}

TEST(TwoSlopes, AreDrawnToWhatTheyGrowTo) {
  for (const double slope : {-2.0, -1.0, 0.0, 0.5, 3.0})
    for (const int piece : {0, 1}) {
      const TwoSlopes law{{slope, slope}, 0.3};
      const double drawn = law.drawn_to(piece, 5);
      EXPECT_EQ(TwoSlopes::grown(drawn), piece);
      ASSERT_TRUE(law.ends(drawn));
      EXPECT_NEAR((*law.ends(drawn))[piece], 5, 1e-13) << slope;
    }
}

TEST(TwoSlopes, TellWhereAPieceIsNoughtOrInfinite) {
  const TwoSlopes law{{-1, 2}, 0.4};
  // 1 + 0.5 (t - 0.4) is nought at t = -1.6, in lengths of the first piece -4.
  EXPECT_NEAR(law.run(0.5, 0).place, -4, 1e-14);
  // 1 - 2 * 0.5 (t - 0.4) is nought at t = 1.4, 1 behind the joint.
  EXPECT_NEAR(law.run(0.5, 1).place, 1 / 0.6, 1e-14);
  EXPECT_EQ(law.run(0, 1).place, HUGE_VAL);
  EXPECT_EQ((TwoSlopes{{-1, 0}, 0.4}.run(2, 1).place), HUGE_VAL);
  EXPECT_NEAR((TwoSlopes{{-1, 0}, 0.4}.run(2, 1).growth), 1.2, 1e-15);
}

}  // namespace
}  // namespace keyline::lac::detail::space
