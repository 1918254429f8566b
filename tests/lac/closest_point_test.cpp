#include "keyline/lac/chain/closest_point.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "keyline/lac/g2/spline.h"

namespace keyline::lac {
namespace {

using core::Point2;

double fraction(int steps = 1000) { return *rc::gen::inRange(-steps, steps + 1) / double(steps); }

TEST(ClosestPoint, IsAtLeastAsNearAsTheGenericOneAndEverySample) {
  EXPECT_TRUE(rc::check([] {
    const double alpha = 3 * fraction();
    const double k1 = 2 * fraction();
    const Segment s{{{0, 0}, 1}, alpha, 3, 0.7, alpha < 0 ? k1 : std::abs(k1) + 0.1};
    const Point2 p{4 * fraction(), 4 * fraction()};
    const auto found = closest_point(s, p);
    RC_ASSERT(distance(evaluate(s, found.t), p) < found.distance + 1e-13);
    RC_ASSERT(found.distance <= curve::closest_point(s, p).distance + 1e-12);
    for (const Point2& q : sample(s, 200)) RC_ASSERT(found.distance <= distance(q, p) + 1e-12);
  }));
}

TEST(ClosestPoint, OfAChainIsThatOfItsNearestPiece) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Point2> points;
    for (int i = 0; i < 6; ++i) points.push_back({double(i), 0.7 * fraction()});
    const auto spline = solve_spline(points);
    RC_ASSERT(spline.has_value());
    const Point2 p{6 * fraction(), 3 * fraction()};
    const auto found = closest_point(spline->chain, p);
    double least = INFINITY;
    for (const Segment& s : segments(spline->chain)) {
      least = std::min(least, closest_point(s, p).distance);
    }
    RC_ASSERT(std::abs(found.distance - least) < 1e-13);
    RC_ASSERT(distance(evaluate(spline->chain, found.t), p) < least + 1e-12);
  }));
}

TEST(ClosestPoint, FromTheCentreOfAnArcIsItsStart) {
  const Segment arc{{{1, 0}, 1.5707963267948966}, 0, 2, 1, 1};
  EXPECT_NEAR(closest_point(arc, {0, 0}).distance, 1, 1e-14);
}

}  // namespace
}  // namespace keyline::lac
