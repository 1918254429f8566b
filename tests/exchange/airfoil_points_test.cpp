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

bool unfolds(acquire::RawCurve& curve) {
  std::vector<std::string> told;
  const bool done = unfold_lednicer(curve, told);
  EXPECT_TRUE(told.empty());
  return done;
}

const std::vector<core::Point3> kLednicer{{3, 4}, {0, 0},      {0.5, 0.1},  {1, 0},
                                          {0, 0}, {0.3, -0.1}, {0.6, -.05}, {1, 0}};

// Counts of 3 and 4, then the upper side from the nose, then the lower: from the tail over the
// nose.
TEST(AirfoilPoints, LednicersOrderBecomesOneCurve) {
  acquire::RawCurve curve = curve_of(kLednicer);
  ASSERT_TRUE(unfolds(curve));
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
    return !unfolds(curve) && curve.points == before && curve.notes.empty();
  };
  EXPECT_FALSE(stays([](auto&) {}));
  EXPECT_TRUE(stays([](auto& c) { c.points[0] = {3.5, 3.5}; }));
  EXPECT_TRUE(stays([](auto& c) { c.points[0] = {2, 5}; }));
  EXPECT_TRUE(stays([](auto& c) { c.points[0] = {5, 2}; }));
  EXPECT_TRUE(stays([](auto& c) { c.has_z = true; }));
  // both sides lead from the nose to the tail, in whatever unit
  EXPECT_TRUE(stays([](auto& c) { c.points[1].x = 0.9; }));
  EXPECT_TRUE(stays([](auto& c) { c.points[3].x = 0.1; }));
  EXPECT_TRUE(stays([](auto& c) { c.points[4].x = 0.9, c.points[5].x = 0.8; }));
  EXPECT_TRUE(stays([](auto& c) { c.points[7].x = 0.1; }));
  EXPECT_FALSE(stays([](auto& c) {
    for (std::size_t i = 1; i < c.points.size(); ++i)
      c.points[i] = {100 * c.points[i].x, 100 * c.points[i].y};
  }));
}

// Sides part where the points go back to the nose, whatever the counts say, if they can be no
// point: of an airfoil from 0 to 1 the first is none beyond 2. In percent they may be one off.
TEST(AirfoilPoints, LednicersCountsMayBeOff) {
  const auto unfolded = [](core::Point3 counts, double scale) -> std::string {
    std::vector<std::string> told;
    acquire::RawCurve curve = curve_of(kLednicer);
    for (core::Point3& p : curve.points) p = {scale * p.x, scale * p.y};
    curve.points[0] = counts;
    if (!unfold_lednicer(curve, told)) return "none";
    EXPECT_EQ(curve.points.size(), 7U);
    EXPECT_EQ(curve.points[0].x, scale);
    EXPECT_EQ(curve.points[2].x, 0);
    EXPECT_EQ(curve.points[3].x, 0);
    return told.empty() ? "" : told.at(0);
  };
  const std::string plain;
  const auto told = [&](const std::string& counts) {
    return "line 1: the counts " + counts + " of sides that have 3 and 4 points";
  };
  EXPECT_EQ(unfolded({3, 4}, 1), plain);
  EXPECT_EQ(unfolded({3, 5}, 1), told("3 and 5"));
  EXPECT_EQ(unfolded({4, 3}, 1), told("4 and 3"));
  EXPECT_EQ(unfolded({4, 4}, 1), told("4 and 4"));
  EXPECT_EQ(unfolded({35, 30}, 1), told("35 and 30"));
  EXPECT_EQ(unfolded({3, 4}, 100), plain);
  EXPECT_EQ(unfolded({4, 5}, 100), told("4 and 5"));
  EXPECT_EQ(unfolded({4, 6}, 100), "none");
  EXPECT_EQ(unfolded({5, 4}, 100), "none");
  EXPECT_EQ(unfolded({6, 30}, 3), "none");
  EXPECT_EQ(unfolded({7, 30}, 3), told("7 and 30"));
  EXPECT_EQ(unfolded({1e10, 30}, 1), "none");
}

TEST(AirfoilPoints, SidesGoBackToTheNoseOnce) {
  acquire::RawCurve twice = curve_of({{9, 9}, {0, 0}, {1, 0}, {0, 0}, {1, 0}, {0, 0}, {1, 0}});
  EXPECT_FALSE(unfolds(twice));
  acquire::RawCurve never =
      curve_of({{9, 9}, {0, 0}, {0.2, 0}, {0.4, 0}, {0.6, 0}, {0.8, 0}, {1, 0}});
  EXPECT_FALSE(unfolds(never));
  acquire::RawCurve few = curve_of({{3, 3}});
  EXPECT_FALSE(unfolds(few));
}

// A point in the very middle is not back in the fore half.
TEST(AirfoilPoints, AStepToTheMiddleIsNoWayBack) {
  std::vector<std::string> told;
  acquire::RawCurve curve =
      curve_of({{4, 4}, {0, 0}, {0.6, 0.1}, {0.5, 0.1}, {1, 0}, {0, 0}, {0.5, -0.1}, {1, 0}});
  ASSERT_TRUE(unfold_lednicer(curve, told));
  EXPECT_EQ(told.size(), 1U);
  EXPECT_EQ(curve.points[1].x, 0.5);
  EXPECT_EQ(curve.points[2].x, 0.6);
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
