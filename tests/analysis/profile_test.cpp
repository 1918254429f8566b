#include "keyline/analysis/profile.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/curve/bezier.h"

namespace keyline::analysis {
namespace {

// Rates are differences, one-sided at the ends, turning the area below curvature.
TEST(Profile, FilledColumnsAreDifferencesAndTrapezia) {
  const CurvatureProfile p = complete({{0, 1, 3}, {0, 1, 5}, {}, {}}).value();
  EXPECT_EQ(p.curvature_rate, (std::vector<double>{1, 5.0 / 3, 2}));
  EXPECT_EQ(p.turning, (std::vector<double>{0, 0.5, 6.5}));
}

TEST(Profile, ReversedIsReadFromTheEnd) {
  const CurvatureProfile p = reversed({{0, 1, 3}, {2, 1, 5}, {7, 8, 9}, {0, 1, 4}});
  EXPECT_EQ(p.arc_length, (std::vector<double>{0, 2, 3}));
  EXPECT_EQ(p.curvature, (std::vector<double>{-5, -1, -2}));
  EXPECT_EQ(p.curvature_rate, (std::vector<double>{9, 8, 7}));
  EXPECT_EQ(p.turning, (std::vector<double>{0, -3, -4}));
}

// A curve that starts without a direction has no curvature there: it is its neighbour's.
TEST(Profile, WhatIsNotFiniteIsItsNeighbours) {
  const curve::Bezier2 c{{{0, 0}, {0, 0}, {1, 1}, {2, 0}}, {}};
  EXPECT_FALSE(std::isfinite(curve::curvature(jet(c, 0))));
  const CurvatureProfile p = curvature_profile(c, 11);
  ASSERT_EQ(p.curvature.size(), 11U);
  for (const double k : p.curvature) EXPECT_TRUE(std::isfinite(k));
  EXPECT_EQ(p.curvature[0], p.curvature[1]);
}

}  // namespace
}  // namespace keyline::analysis
