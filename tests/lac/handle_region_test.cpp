#include "keyline/lac/hermite/handle_region.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/hermite/region.h"

/// Where a handle may stand.
namespace keyline::lac {
namespace {

using core::Point2;

const RegionOfTurning kClothoids = [](double theta) { return drawable_region(-1, theta); };

/// Angle at b of the triangle.
double angle_at(Point2 a, Point2 b, Point2 c) {
  const core::Vector2 u = a - b, v = c - b;
  return std::abs(std::atan2(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y));
}

// On the border the triangle's angles are those of the region's: psi = psi_low or psi_high for the
// turning, whichever handle it is; but where the outline is cut off, 50 chords away.
TEST(HandleRegion, OutlinesAreTheBorders) {
  const std::array<Point2, 3> points{Point2{0, 0}, {1, 1}, {2, 0}};
  for (int handle = 0; handle < 3; ++handle) {
    const HandleRegion region = handle_region(points, handle, kClothoids);
    EXPECT_FALSE(region.nearest);
    const double base = core::distance(points[(handle + 1) % 3], points[(handle + 2) % 3]);
    for (const int side : {0, 1}) {
      const auto& outline = region.outlines[side];
      ASSERT_EQ(outline.size(), 2U * 96 + 2U * 47);
      int on_border = 0;
      for (const Point2 place : outline) {
        if (core::distance(place, points[(handle + 1) % 3]) > 49.9 * base) continue;
        std::array<Point2, 3> now = points;
        now[handle] = place;
        const double theta = std::numbers::pi - angle_at(now[0], now[1], now[2]);
        const double psi = angle_at(now[1], now[0], now[2]);
        if (!(theta > 1e-3 && theta < 3.14)) continue;
        const core::Interval r = drawable_region(-1, theta);
        EXPECT_GT(psi, r.low - 1e-7);
        EXPECT_LT(psi, r.high + 1e-7);
        on_border += std::min(std::abs(psi - r.low), std::abs(psi - r.high)) < 1e-7;
        const double turn = core::cross(now[1] - now[0], now[2] - now[1]);
        EXPECT_EQ(turn > 0, side == 0);
      }
      EXPECT_GT(on_border, 60);
    }
  }
}

// A handle that stands outside is offered the nearest place inside: drawable, and no place of the
// outlines is nearer by more than the margin.
TEST(HandleRegion, NearestIsInsideAndNear) {
  const std::array<Point2, 3> points{Point2{0, 0}, {1.9, 1}, {2, 0}};
  ASSERT_FALSE(solve_g1(points[0], points[1], points[2], -1));
  for (int handle = 0; handle < 3; ++handle) {
    const HandleRegion region = handle_region(points, handle, kClothoids);
    ASSERT_TRUE(region.nearest);
    std::array<Point2, 3> now = points;
    now[handle] = *region.nearest;
    EXPECT_TRUE(solve_g1(now[0], now[1], now[2], -1)) << handle;
    double least = HUGE_VAL;
    for (const auto& outline : region.outlines)
      for (const Point2 p : outline) least = std::min(least, core::distance(p, points[handle]));
    const double moved = core::distance(now[handle], points[handle]);
    EXPECT_LE(moved, least * 1.02 + 1e-9) << handle;
    EXPECT_GE(moved, 0.5 * least) << handle;
  }
}

TEST(HandleRegion, StraightHandlesStandInIt) {
  EXPECT_FALSE(handle_region({Point2{0, 0}, {1, 0}, {2, 0}}, 1, kClothoids).nearest);
  EXPECT_TRUE(handle_region({Point2{0, 0}, {0, 0}, {2, 0}}, 2, kClothoids).outlines[0].empty());
}

}  // namespace
}  // namespace keyline::lac
