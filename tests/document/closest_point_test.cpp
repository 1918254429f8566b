#include "keyline/document/closest_point.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace keyline::document {
namespace {

using core::Point2;

/// One member of each type, not joined: 4 edges, a rational cubic, a cubic B-spline of three spans,
/// and a chain of a clothoid, an arc and a line.
Path one_of_each() {
  Path path;
  path.curves.push_back({curve::Polyline2{{{0, 0}, {2, 1}, {3, -1}, {3, -1.5}, {5, 0}}}});
  path.curves.push_back({curve::Bezier2{{{5, 0}, {6, 3}, {8, -3}, {9, 1}}, {1, 2, 0.5, 1}}});
  path.curves.push_back({curve::BSpline2{3,
                                         {0, 0, 0, 0, 0.3, 0.7, 1, 1, 1, 1},
                                         {{9, 1}, {10, 2}, {9, 4}, {6, 3}, {5, 5}, {2, 4}},
                                         {}}});
  lac::Chain chain;
  chain.start = {{2, 4}, 3.0};
  chain.pieces = {{-1, 3, 0, 1.5}, {0, 2, 1.5, 1.5}, {-1, 1, 0, 0}};
  path.curves.push_back({chain});
  return path;
}

// Against 40,000 samples of the path: nothing sampled is nearer, nothing found is nearer than the
// samples beside it can be, and the place told is where the point is.
TEST(ClosestSearch, FindsTheNearestOfAllMembers) {
  const Path path = one_of_each();
  const ClosestSearch nearest(path);
  std::vector<Point2> samples;
  constexpr int kSamples = 40000;
  for (int i = 0; i <= kSamples; ++i) samples.push_back(evaluate(path, 1.0 * i / kSamples));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(-2, 11), y(-3, 6);
  for (int i = 0; i < 300; ++i) {
    const Point2 p{x(random), y(random)};
    double sampled = INFINITY;
    for (const Point2 q : samples) sampled = std::min(sampled, core::distance(p, q));
    const curve::ClosestPoint found = nearest(p);
    EXPECT_LE(found.distance, sampled + 1e-12);
    EXPECT_GE(found.distance, sampled - 1e-3);
    EXPECT_NEAR(core::distance(found.point, p), found.distance, 1e-14);
    EXPECT_NEAR(core::distance(evaluate(path, found.t), found.point), 0, 1e-9) << found.t;
  }
}

// The corner of a closed polygon where it begins is its end too.
TEST(ClosestSearch, GivesTheFirstOfSeveral) {
  Path path;
  path.curves.push_back({curve::Polyline2{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}}});
  const ClosestSearch nearest(path);
  EXPECT_EQ(nearest({-1, -1}).t, 0);
  EXPECT_EQ(nearest({2, 2}).t, 0.125);
  EXPECT_EQ(nearest({5, 5}).t, 0.5);
}

}  // namespace
}  // namespace keyline::document
