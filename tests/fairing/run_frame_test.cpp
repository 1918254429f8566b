#include "keyline/fairing/run_frame.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

/// A run's own frame.
namespace keyline::fairing::detail {
namespace {

using core::Point2;

Run open_run(std::vector<Point2> points, double length) {
  detail::Run run;
  run.points = std::move(points);
  run.length = length;
  return run;
}

/// The end farther from the centroid comes last: points crowd at the start.
const std::vector<Point2> kCrowded{{0, 0}, {0.5, 0.1}, {1, 0.3}, {4, 1}};

TEST(RunFrame, FirstPointIsTheOriginAndTheCentroidLiesOnTheAxis) {
  const detail::Run run = open_run(kCrowded, 5);
  const RunFrame frame = make_frame(run);
  EXPECT_FALSE(frame.reversed);
  EXPECT_EQ(frame.order, (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_NEAR(frame.points[0].x, 0, 1e-15);
  EXPECT_NEAR(frame.points[0].y, 0, 1e-15);
  double x = 0, y = 0;
  for (const Point2 p : frame.points) {
    x += p.x / 4;
    y += p.y / 4;
  }
  EXPECT_NEAR(y, 0, 1e-15);
  EXPECT_NEAR(x, std::hypot(5.5 / 4, 1.4 / 4) / 5, 1e-15);  // a fifth: scaled to length 1
  for (std::size_t i = 0; i < 4; ++i) {
    const Point2 p = core::apply(frame.to_canonical, run.points[i]);
    EXPECT_NEAR(p.x, frame.points[i].x, 1e-15);
    EXPECT_NEAR(p.y, frame.points[i].y, 1e-15);
  }
}

TEST(RunFrame, IsTheSameFromEitherEnd) {
  const RunFrame one = make_frame(open_run(kCrowded, 5));
  const RunFrame other = make_frame(open_run({kCrowded.rbegin(), kCrowded.rend()}, 5));
  EXPECT_TRUE(other.reversed);
  EXPECT_EQ(other.order, (std::vector<std::size_t>{3, 2, 1, 0}));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(one.points[i].x, other.points[i].x, 1e-15);
    EXPECT_NEAR(one.points[i].y, other.points[i].y, 1e-15);
  }
}

// The centroid (1, 1.25) of a kite: its farthest corner, 1.75 off, comes first, though another is
// 1.25 off, and it is run to the left.
TEST(RunFrame, ClosedRunsTurnLeftFromTheFarthestPoint) {
  detail::Run run = open_run({{0, 1}, {1, 0}, {2, 1}, {1, 3}}, 1);
  run.closed = true;
  const RunFrame left = make_frame(run);
  EXPECT_FALSE(left.reversed);
  EXPECT_EQ(left.order, (std::vector<std::size_t>{3, 0, 1, 2}));
  run.points = {{1, 3}, {2, 1}, {1, 0}, {0, 1}};
  const RunFrame right = make_frame(run);
  EXPECT_TRUE(right.reversed);
  EXPECT_EQ(right.order, (std::vector<std::size_t>{0, 3, 2, 1}));
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(core::distance(left.points[i], right.points[i]), 0, 1e-14);
}

TEST(RunFrame, PointsToBePassedAreHeavy) {
  detail::Run run = open_run({kCrowded.rbegin(), kCrowded.rend()}, 5);
  run.weights = {1, 2, 3, 4};
  run.must_pass = {1};
  const RunFrame frame = make_frame(run);
  EXPECT_EQ(frame.weights, (std::vector<double>{4, 3, 2e6, 1}));
  run.weights.clear();
  EXPECT_EQ(make_frame(run).weights, (std::vector<double>{1, 1, 1e6, 1}));
}

// A half's line of symmetry lies along x; the centroid to the right of the start.
TEST(RunFrame, HalvesLieAlongTheirAxis) {
  detail::Run run = open_run(kCrowded, 5);
  for (const double direction : {0.3, 0.3 + std::numbers::pi}) {
    run.axis = core::Pose2{{0, 0}, direction};
    const RunFrame frame = make_frame(run);
    const core::Vector2 along{std::cos(0.3), std::sin(0.3)};
    for (std::size_t i = 0; i < 4; ++i) {
      const core::Vector2 v = run.points[i] - run.points[0];
      EXPECT_NEAR(frame.points[i].x, (along.x * v.x + along.y * v.y) / 5, 1e-15);
      EXPECT_NEAR(frame.points[i].y, (along.x * v.y - along.y * v.x) / 5, 1e-15);
    }
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
