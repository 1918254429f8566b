#include "keyline/fairing/run_points.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

/// Points of a run as they are fitted.
namespace keyline::fairing::detail {
namespace {

/// n points along a line of length 1 in the frame of the run, as they come.
struct Given {
  Run run;
  RunFrame frame;
};
Given line(std::size_t n) {
  Given g;
  for (std::size_t i = 0; i < n; ++i) {
    g.run.points.push_back({double(i) / double(n - 1), 0});
    g.frame.order.push_back(i);
  }
  g.frame.points = g.run.points;
  g.frame.weights.assign(n, 1);
  return g;
}

TEST(RunPoints, ThoseToBePassedAreMarkedInTheirMeans) {
  Given g = line(12);
  g.run.must_pass = {0, 4};
  RunResult result;
  take_points(result, g.run, g.frame, 7);
  ASSERT_EQ(result.points.size(), 7U);
  EXPECT_EQ(result.most_points, 7U);
  for (std::size_t j = 0; j < 7; ++j)
    EXPECT_EQ(result.points[j].must_pass, j == 0 || j == 2) << j;  // the runs of two: 1 2, 3 4, …
}

TEST(RunPoints, HoldersAreTheMeansOfAPointInTheFramesOrder) {
  const Given g = line(12);
  RunResult result;
  take_points(result, g.run, g.frame, 7);
  EXPECT_EQ(holders(result, g.frame),
            (std::vector<std::size_t>{0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6}));
  // Guides between the points move what is behind them.
  result.points.insert(result.points.begin() + 2, FitPoint{.position = {}, .count = 0});
  EXPECT_EQ(holders(result, g.frame),
            (std::vector<std::size_t>{0, 1, 1, 3, 3, 4, 4, 5, 5, 6, 6, 7}));
}

// Members are the run's own points where several are one, none where each stands for itself.
TEST(RunPoints, MembersAreOfMeansAlone) {
  const Given g = line(12);
  RunResult result;
  take_points(result, g.run, g.frame, 12);
  EXPECT_TRUE(members_of(result, g.run, g.frame).points.empty());
  take_points(result, g.run, g.frame, 11);
  const Members members = members_of(result, g.run, g.frame);
  EXPECT_EQ(members.points.size(), 12U);
  EXPECT_EQ(members.fitted, holders(result, g.frame));
}

// Measured points beside a half's: counts, and how far they lie left and right.
TEST(RunPoints, MembersSpreadAboutTheirPoints) {
  Given g = line(4);
  g.run.members.points = {{0, 0}, {0.33, 0.01}, {0.34, -0.02}, {0.67, 0.03}, {1, 0}};
  g.run.members.fitted = {0, 1, 1, 2, 3};
  RunResult result;
  take_points(result, g.run, g.frame, 10);
  EXPECT_EQ(result.points[0].count, 1);
  EXPECT_EQ(result.points[1].count, 2);
  EXPECT_NEAR(result.points[1].high, 0.01, 1e-15);
  EXPECT_NEAR(result.points[1].low, -0.02, 1e-15);
  EXPECT_NEAR(result.points[2].high, 0.03, 1e-15);
  EXPECT_EQ(result.points[2].low, 0);
  const Members members = members_of(result, g.run, g.frame);
  EXPECT_EQ(members.fitted, g.run.members.fitted);
  EXPECT_EQ(members.points[3], (core::Point2{0.67, 0.03}));
}

// Straight points are told by 400 means, however many; of a half circle three neighbours of 400
// bend by (pi / 400)^2 / (2 pi) of its length: with less tolerance than that they are 800.
TEST(RunPoints, CalmPointsAreAsManyAsTheBendAsks) {
  Given g = line(5000);
  RunResult result;
  take_calm_points(result, g.run, g.frame, 1e-9);
  EXPECT_EQ(result.points.size(), 400U);
  for (std::size_t i = 0; i < 5000; ++i) {
    const double t = M_PI * double(i) / 4999;
    g.run.points[i] = {std::cos(t) / M_PI, std::sin(t) / M_PI};
  }
  g.frame.points = g.run.points;
  const double bend = std::pow(M_PI / 400, 2) / (2 * M_PI);
  take_calm_points(result, g.run, g.frame, 1.1 * bend);
  EXPECT_EQ(result.points.size(), 400U);
  take_calm_points(result, g.run, g.frame, 0.9 * bend);
  EXPECT_EQ(result.points.size(), 800U);
  take_calm_points(result, g.run, g.frame, 0.2 * bend);
  EXPECT_EQ(result.points.size(), 1600U);  // the first that is as many as the search fits at most
}

// A guide where an end stands on the axis and the points do not come near it.
TEST(RunPoints, GuidesReachTheAxis) {
  std::vector<FitPoint> points;
  for (const double x : {0.1, 0.2, 0.3, 0.4}) points.push_back({.position = {x, 0}});
  HeldEnd start;
  start.slides = true;
  start.joint.position = {0, 0};
  HeldEnd end;
  end.joint.position = {0.5, 0};
  auto guided = points;
  reach_axis(guided, start, end, 0.01);
  ASSERT_EQ(guided.size(), 5U);
  EXPECT_EQ(guided[0].position, (core::Point2{0, 0}));
  EXPECT_EQ(guided[0].count, 0);
  EXPECT_NEAR(guided[0].share, 0.01 / (0.5 * 0.1), 1e-15);
  end.slides = true;
  guided = points;
  reach_axis(guided, start, end, 1);
  ASSERT_EQ(guided.size(), 6U);
  EXPECT_EQ(guided.back().position, (core::Point2{0.5, 0}));
  EXPECT_EQ(guided.back().share, 1);
  // As near as a tenth of the spacing is as good as on it.
  end.joint.position = {0.409, 0};
  start.joint.position = {0.089, 0};
  guided = points;
  reach_axis(guided, start, end, 0.01);
  ASSERT_EQ(guided.size(), 5U);
  EXPECT_EQ(guided[0].count, 0);
}

}  // namespace
}  // namespace keyline::fairing::detail
