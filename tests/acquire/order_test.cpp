#include "keyline/acquire/order.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/acquire/spanning_tree.h"
#include "keyline/core/angle.h"
#include "keyline/numeric/random.h"

namespace keyline::acquire {
namespace {

std::vector<core::Point3> helix(std::size_t count, double noise) {
  numeric::Random random(7);
  std::vector<core::Point3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = 6.0 * static_cast<double>(i) / static_cast<double>(count - 1);
    points.push_back({std::cos(t) + noise * random.normal(), std::sin(t) + noise * random.normal(),
                      t + noise * random.normal()});
  }
  return points;
}

TEST(OrderInSpace, IsThatOfCurvesAndOfScanLines) {
  EXPECT_TRUE(is_ordered(std::span<const core::Point3>(helix(300, 0))));
  EXPECT_TRUE(is_ordered(std::span<const core::Point3>(helix(3000, 0.05))));  // 25 steps of noise
  std::vector<core::Point3> scan;
  for (int row = 0; row < 30; ++row)
    for (int i = 0; i < 40; ++i) scan.push_back({0.1 * i, 0.1 * row, std::sin(0.1 * i)});
  EXPECT_TRUE(is_ordered(std::span<const core::Point3>(scan)));
  EXPECT_TRUE(is_ordered(std::span<const core::Point3>(std::vector<core::Point3>(20))));
}

TEST(OrderInSpace, IsNoneOfPointsStrewnOverASurface) {
  for (const int count : {400, 5000}) {
    numeric::Random random(11);
    std::vector<core::Point3> points;
    for (int i = 0; i < count; ++i) {
      const double u = random.uniform(0, 2 * core::kPi), v = random.uniform(0, 2 * core::kPi);
      points.push_back(
          {(3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v)});
    }
    EXPECT_FALSE(is_ordered(std::span<const core::Point3>(points))) << count;
  }
}

std::vector<core::Point2> strewn_on_a_circle(std::size_t count) {
  numeric::Random random(5);
  std::vector<core::Point2> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = random.uniform(0, 2 * core::kPi);
    points.push_back({std::cos(angle), std::sin(angle)});
  }
  return points;
}

// 200,000 points took five seconds to be cancelled.
TEST(OrderOfPoints, IsLookedForNoLongerOnceCancelled) {
  const std::vector<core::Point2> points = strewn_on_a_circle(300);
  const auto stopped = core::CancellationToken::make();
  EXPECT_FALSE(is_ordered(points, stopped));
  EXPECT_EQ(detail::neighbour_lists(points, stopped)[299].size(), 8U);
  stopped.request_stop();
  EXPECT_TRUE(is_ordered(points, stopped));
  EXPECT_TRUE(detail::neighbour_lists(points, stopped)[0].empty());
  RawCurve raw;
  for (const core::Point2 p : points) raw.points.push_back({p.x, p.y, 0});
  AcquireOptions options;
  options.cancellation = stopped;
  EXPECT_EQ(acquire_key_line(raw, options).error().code, core::ErrorCode::cancelled);
}

}  // namespace
}  // namespace keyline::acquire
