#include "keyline/exchange/points/airfoil_points.h"

#include <gtest/gtest.h>

/// Airfoils as they are collected.
namespace keyline::exchange::detail {
namespace {

acquire::RawCurve curve_of(const std::vector<core::Point3>& points) {
  acquire::RawCurve curve;
  curve.id = "foil";
  curve.points = points;
  for (std::size_t i = 0; i < points.size(); ++i)
    curve.source_lines.push_back(static_cast<int>(i) + 1);
  return curve;
}

const std::vector<core::Point3> kLednicer{{3, 4}, {0, 0},      {0.5, 0.1},  {1, 0},
                                          {0, 0}, {0.3, -0.1}, {0.6, -.05}, {1, 0}};

// Counts of 3 and 4, then the upper side from the nose, then the lower: from the tail over the
// nose.
TEST(AirfoilPoints, LednicersOrderBecomesOneCurve) {
  acquire::RawCurve curve = curve_of(kLednicer);
  ASSERT_TRUE(unfold_lednicer(curve));
  ASSERT_EQ(curve.points.size(), 7U);
  const std::vector<double> xs{1, 0.5, 0, 0, 0.3, 0.6, 1};
  const std::vector<int> lines{4, 3, 2, 5, 6, 7, 8};
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(curve.points[i].x, xs[i]) << i;
    EXPECT_EQ(static_cast<int>(curve.source_lines[i]), lines[i]) << i;
  }
  EXPECT_EQ(curve.notes.size(), 1U);
}

TEST(AirfoilPoints, OtherPointsStayAsTheyAre) {
  const auto stays = [](auto change) {
    acquire::RawCurve curve = curve_of(kLednicer);
    change(curve);
    const auto before = curve.points;
    return !unfold_lednicer(curve) && curve.points == before && curve.notes.empty();
  };
  EXPECT_FALSE(stays([](auto&) {}));
  EXPECT_TRUE(stays([](auto& c) { c.points[0] = {3, 5}; }));
  EXPECT_TRUE(stays([](auto& c) { c.points[0] = {3.5, 3.5}; }));
  EXPECT_TRUE(stays([](auto& c) { c.points[0] = {2, 5}; }));
  EXPECT_TRUE(stays([](auto& c) { c.points[0] = {5, 2}; }));
  EXPECT_TRUE(stays([](auto& c) { c.has_z = true; }));
  // both sides lead from the nose to the tail, in whatever unit
  EXPECT_TRUE(stays([](auto& c) { c.points[1].x = 0.9; }));
  EXPECT_TRUE(stays([](auto& c) { c.points[3].x = 0.1; }));
  EXPECT_TRUE(stays([](auto& c) { c.points[4].x = 0.9; }));
  EXPECT_TRUE(stays([](auto& c) { c.points[7].x = 0.1; }));
  EXPECT_FALSE(stays([](auto& c) {
    for (std::size_t i = 1; i < c.points.size(); ++i)
      c.points[i] = {100 * c.points[i].x, 100 * c.points[i].y};
  }));
}

// Two elements parted by (999, 999).
TEST(AirfoilPoints, ElementsArePartedByTheirMark) {
  std::vector<acquire::RawCurve> curves{
      curve_of({{1, 0}, {0, 0.1}, {999, 999}, {999, 999}, {1.2, 0}, {1.1, 0.2}, {1.3, 0}})};
  part_elements(curves);
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0].points.size(), 2U);
  EXPECT_EQ(curves[1].points.size(), 3U);
  EXPECT_EQ(curves[0].id, "foil");
  EXPECT_EQ(curves[1].id, "");
  EXPECT_EQ(static_cast<int>(curves[1].source_lines[0]), 5);
  EXPECT_EQ(curves[0].notes.size(), 1U);
}

// 999 is no mark where a curve could pass it, in x or in y; nor is half of it.
TEST(AirfoilPoints, MarksStandApart) {
  const auto parts = [](const std::vector<core::Point3>& points) {
    std::vector<acquire::RawCurve> curves{curve_of(points)};
    part_elements(curves);
    return curves.size();
  };
  EXPECT_EQ(parts({{0, 0}, {1, 1}, {999, 999}, {0, 0}, {1, 1}}), 2U);
  EXPECT_EQ(parts({{0, 0}, {1, 1}, {999, 998}, {0, 0}, {1, 1}}), 1U);
  EXPECT_EQ(parts({{0, 0}, {1, 1}, {998, 999}, {0, 0}, {1, 1}}), 1U);
  // Up to 499 the box doubled ends at 998.
  EXPECT_EQ(parts({{0, 0}, {499, 1}, {999, 999}, {0, 0}, {1, 1}}), 2U);
  EXPECT_EQ(parts({{0, 0}, {500, 1}, {999, 999}, {0, 0}, {1, 1}}), 1U);
  EXPECT_EQ(parts({{0, 0}, {1, 500}, {999, 999}, {0, 0}, {1, 1}}), 1U);
  EXPECT_EQ(parts({{0, 0}, {1, 1}, {2, 2}}), 1U);
}

}  // namespace
}  // namespace keyline::exchange::detail
