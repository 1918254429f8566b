#include "keyline/acquire/join.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace keyline::acquire {
namespace {

core::Point3 truth(double t) { return {10 * t, std::sin(3 * t), 0}; }

RawCurve part(double from, double to, int n, double lift = 0) {
  RawCurve raw;
  for (int i = 0; i < n; ++i) {
    core::Point3 p = truth(from + (to - from) * i / (n - 1));
    p.y += lift;
    raw.points.push_back(p);
  }
  return raw;
}

TEST(AcquireJoined, OrdersTurnsAndAverages) {
  std::vector<RawCurve> parts{part(0.35, 0.7, 70), part(1.0, 0.65, 60, 0.002), part(0, 0.4, 90)};
  const auto line = acquire_joined(parts);
  ASSERT_TRUE(line) << line.error().message;
  EXPECT_FALSE(line->closed);
  EXPECT_EQ(line->report.points_read, 220u);
  EXPECT_LT(line->points.size(), 220u);
  for (std::size_t i = 1; i < line->points.size(); ++i) {
    EXPECT_GT(line->points[i].x, line->points[i - 1].x) << i;
  }
  EXPECT_EQ(line->points.front().x, 0);
  EXPECT_EQ(line->points.back().x, 10);
  for (const core::Point2& p : line->points) {
    EXPECT_LT(std::abs(p.y - std::sin(0.3 * p.x)), 0.0022);
  }
  EXPECT_TRUE(line->corners.empty());
}

TEST(AcquireJoined, GapsStay) {
  const std::vector<RawCurve> parts{part(0, 0.4, 50), part(0.45, 1, 50)};
  const auto line = acquire_joined(parts);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->points.size(), 100u);
}

TEST(AcquireJoined, NothingIsBadInput) {
  EXPECT_FALSE(acquire_joined({}));
  const std::vector<RawCurve> parts{part(0, 0.4, 50), RawCurve{}};
  const auto line = acquire_joined(parts);
  ASSERT_FALSE(line);
  EXPECT_NE(line.error().message.find("part 2"), std::string::npos);
}

}  // namespace
}  // namespace keyline::acquire
