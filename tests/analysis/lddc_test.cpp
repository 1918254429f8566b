#include "keyline/analysis/lddc.h"

#include <cmath>

#include <gtest/gtest.h>

#include "spirals.h"

namespace keyline::analysis {
namespace {

int points_in(const Lddc& d) {
  int sum = d.below + d.above;
  for (const LddcBar& bar : d.bars) sum += bar.count;
  return sum;
}

TEST(Lddc, BarsAreThePapers) {
  const Lddc d = curvature_distribution_diagram(testing::involute(0.1, 0.3, 1));
  ASSERT_EQ(d.bars.size(), 100u);
  EXPECT_EQ(d.bars.front().low, -3);
  EXPECT_NEAR(d.bars.back().low, 1.95, 1e-12);
  EXPECT_EQ(points_in(d), 1000);
  for (const LddcBar& bar : d.bars) {
    if (bar.count == 0) continue;
    EXPECT_NEAR(bar.height, std::log10(bar.count / 1000.0), 1e-15);
  }
}

TEST(Lddc, AnArcIsOneBar) {
  const Lddc d = curvature_distribution_diagram(testing::arcs({2}, {1}));
  ASSERT_EQ(d.tops.size(), 1u);
  EXPECT_EQ(d.tops[0].count, 1000);
  EXPECT_EQ(d.tops[0].y, 0);
  EXPECT_NEAR(d.tops[0].x, std::log10(0.5), 0.025 + 1e-12);
  EXPECT_FALSE(d.has_gradient);
  EXPECT_EQ(d.distance_ab, 0);
}

TEST(Lddc, ALineLiesOutside) {
  const Lddc d = curvature_distribution_diagram(testing::arcs({0}, {1}));
  EXPECT_EQ(d.above, 1000);
  EXPECT_TRUE(d.c_curve.empty());
}

TEST(Lddc, GradientIsTheSlope) {
  struct Case {
    const char* name;
    testing::SpiralCurve curve;
    double slope;
  };
  // Counting 1000 points into bars leaves a few percent of each height to chance.
  const Case cases[] = {{"clothoid", testing::clothoid(0.5, 8, 1), -1},
                        {"Nielsen", testing::nielsen(1, 2.5, 1), 0},
                        {"logarithmic", testing::logarithmic(0.05, 0.5, 1), 1},
                        {"involute", testing::involute(0.1, 0.3, 1), 2}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const Lddc d = curvature_distribution_diagram(c.curve);
    ASSERT_TRUE(d.has_gradient);
    EXPECT_NEAR(d.gradient, c.slope, 0.05);
  }
}

// A clothoid of curvature c s (length 1) has ds = ln(10) kappa dx / c where 10^x is the radius: a
// bar of width w holds 2 sinh(w ln(10) / 2) 10^-x / c of the length, a line of slope -1.
TEST(Lddc, InterceptIsThatOfTheClosedForm) {
  for (const double k1 : {4.0, 8.0}) {
    const double c = k1 - 0.5;
    const Lddc d = curvature_distribution_diagram(testing::clothoid(0.5, k1, 1));
    const double there = std::log10(2 * std::sinh(0.025 * std::log(10.0)) / c);
    EXPECT_NEAR(d.intercept, there, 0.03) << k1;
  }
}

TEST(Lddc, FullerCurvesHaveShorterDistanceAB) {
  const Lddc flat = curvature_distribution_diagram(testing::clothoid(0.1, 3, 1));
  const Lddc full = curvature_distribution_diagram(testing::clothoid(1, 3, 1));
  EXPECT_LT(full.distance_ab, flat.distance_ab);
  EXPECT_LT(full.a.x, full.b.x);
}

TEST(Lddc, PartialEndsAndSpikesAreNoise) {
  // A clothoid with a short arc in it: one bar stands out.
  const double k = 2.0;
  const auto clothoid = testing::clothoid(0.5, 4, 1);
  CurvatureProfile p = curvature_profile(clothoid, 2001);
  for (double& kappa : p.curvature) {
    if (std::abs(kappa - k) < 0.25) kappa = k;
  }
  const Lddc d = curvature_distribution_diagram(p);
  int spikes = 0;
  for (const LddcTop& top : d.tops) spikes += top.noise == LddcNoise::spike;
  EXPECT_GE(spikes, 1);
  ASSERT_TRUE(d.has_gradient);
  EXPECT_NEAR(d.gradient, -1, 0.2);
  EXPECT_EQ(d.tops.front().noise, LddcNoise::partial_end);
}

TEST(Lddc, DirectionAndSizeDoNotMatter) {
  const CurvatureProfile p = curvature_profile(testing::involute(0.1, 0.3, 1), 2001);
  const Lddc there = curvature_distribution_diagram(p);
  const Lddc back = curvature_distribution_diagram(reversed(p));
  CurvatureProfile big = p;
  for (double& s : big.arc_length) s *= 64;
  for (double& k : big.curvature) k /= 64;
  const Lddc scaled = curvature_distribution_diagram(big);
  for (int m = 0; m < kLddcBars; ++m) {
    EXPECT_EQ(there.bars[m].count, back.bars[m].count);
    EXPECT_EQ(there.bars[m].count, scaled.bars[m].count);
  }
}

TEST(Lddc, NothingToCount) {
  EXPECT_TRUE(curvature_distribution_diagram(CurvatureProfile{}).tops.empty());
  EXPECT_EQ(curvature_distribution_diagram(CurvatureProfile{}).bars.size(), 100u);
}

}  // namespace
}  // namespace keyline::analysis
