#include "keyline/analysis/lcg.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "spirals.h"

namespace keyline::analysis {
namespace {

using testing::SpiralCurve;

struct SlopeCase {
  const char* spiral;
  SpiralCurve curve;
  double slope;
};

TEST(Lcg, SlopeMatchesClosedForms) {
  const SlopeCase cases[] = {
      {"clothoid", testing::clothoid(0.1, 2, 1), -1},
      {"clothoid from its inflection", testing::clothoid(0, 2, 1), -1},
      {"clothoid turning right", testing::clothoid(-0.1, -2, 1), -1},
      {"Nielsen", testing::nielsen(1, 1.5, 1), 0},
      {"logarithmic", testing::logarithmic(0.2, 0.5, 1), 1},
      {"involute", testing::involute(0.2, 0.4, 1), 2},
      {"compound of one slope", testing::compound(1, -1, 0.5, 0.7, 0.7, 1), 0.7},
  };
  for (const SlopeCase& c : cases) {
    SCOPED_TRACE(c.spiral);
    const Lcg graph = logarithmic_curvature_graph(c.curve);
    ASSERT_TRUE(graph.defined);
    EXPECT_NEAR(graph.slope, c.slope, 1e-9);
    EXPECT_LT(graph.variance, 1e-18);
  }
}

TEST(Lcg, ArcAndLineHaveNoSlope) {
  EXPECT_FALSE(logarithmic_curvature_graph(testing::arcs({2}, {1})).defined);
  EXPECT_FALSE(logarithmic_curvature_graph(testing::arcs({0}, {1})).defined);
}

TEST(Lcg, ScaleMovesTheLineButNotItsSlope) {
  CurvatureProfile p = curvature_profile(testing::involute(0.2, 0.4, 1));
  const Lcg before = logarithmic_curvature_graph(p);
  for (std::size_t i = 0; i < p.arc_length.size(); ++i) {
    p.arc_length[i] *= 1000;
    p.curvature[i] /= 1000;
    p.curvature_rate[i] /= 1e6;
  }
  const Lcg after = logarithmic_curvature_graph(p);
  EXPECT_NEAR(after.slope, before.slope, 1e-9);
  EXPECT_NEAR(after.variance, before.variance, 1e-12);
  const Lcg back = logarithmic_curvature_graph(reversed(p));
  EXPECT_NEAR(back.slope, after.slope, 1e-9);
}

TEST(Profile, CompleteFillsInAndRefuses) {
  const auto filled = complete({{0, 1, 2}, {0, 1, 2}, {}, {}});
  ASSERT_TRUE(filled);
  EXPECT_DOUBLE_EQ(filled->curvature_rate[1], 1);
  EXPECT_DOUBLE_EQ(filled->turning[2], 2);
  EXPECT_FALSE(complete({}));
  EXPECT_FALSE(complete({{0}, {1}, {}, {}}));
  EXPECT_FALSE(complete({{0, 0}, {1, 1}, {}, {}}));
  EXPECT_FALSE(complete({{0, 1}, {1}, {}, {}}));
  EXPECT_FALSE(complete({{1, 0}, {1, 1}, {}, {}}));
  EXPECT_FALSE(complete({{0, 1}, {1, std::nan("")}, {}, {}}));
}

TEST(ArcLengthTable, InvertsItself) {
  const SpiralCurve c = testing::clothoid(0, 6, 2);
  const ArcLengthTable table(view(c));
  EXPECT_NEAR(table.length(), 2, 1e-12);
  for (double s : {0.0, 0.001, 0.7, 1.9999, 2.0})
    EXPECT_NEAR(table.length_at(table.parameter_at(s)), s, 1e-12);
  EXPECT_EQ(table.parameter_at(-1), 0);
  EXPECT_EQ(table.parameter_at(3), 1);
}

// Points (0, 0), (1, 3) and (2, 0): the nearest line is level at 1, and they are 1, 2 and 1 off it.
TEST(Lcg, LineAndVarianceAreThoseOfLeastSquares) {
  CurvatureProfile profile;
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 3}, {2, 0}}) {
    profile.curvature.push_back(std::exp(-x));
    profile.curvature_rate.push_back(std::exp(-x - y));
  }
  const Lcg graph = logarithmic_curvature_graph(profile);
  ASSERT_TRUE(graph.defined);
  EXPECT_NEAR(graph.slope, 0, 1e-14);
  EXPECT_NEAR(graph.intercept, 1, 1e-14);
  EXPECT_NEAR(graph.variance, 2, 1e-14);
}

}  // namespace
}  // namespace keyline::analysis
