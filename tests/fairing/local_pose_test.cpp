#include "keyline/fairing/local_pose.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

/// Poses from local parabolas.
namespace keyline::fairing::detail {
namespace {

std::vector<FitPoint> at(const std::vector<core::Point2>& places) {
  std::vector<FitPoint> points;
  for (const core::Point2 p : places) points.push_back({.position = p});
  return points;
}

TEST(Track, ReadsClosedCurvesPastTheirEnds) {
  const auto square = at({{0, 0}, {3, 0}, {3, 4}, {0, 4}});
  const Track closed = make_track(square, true);
  EXPECT_EQ(closed.total, 14);
  EXPECT_EQ(closed.position, (std::vector<double>{0, 3, 7, 10}));
  EXPECT_EQ(closed.at(4), 14);
  EXPECT_EQ(closed.at(6), 21);
  EXPECT_EQ(closed.at(-1), -4);
  EXPECT_EQ(closed.at(-4), -14);
  EXPECT_EQ(closed.at(-5), -18);
  EXPECT_EQ(closed.point(5), (core::Point2{3, 0}));
  EXPECT_EQ(closed.point(-1), (core::Point2{0, 4}));
  EXPECT_EQ(closed.point(-5), (core::Point2{0, 4}));
  const Track open = make_track(square, false);
  EXPECT_EQ(open.total, 10);
}

// Evenly spaced along a line both coordinates are linear: any least squares meets them.
TEST(LocalPose, OfALineIsTheLine) {
  std::vector<core::Point2> places;
  for (int i = 0; i <= 20; ++i) places.push_back({0.3 * i, 0.4 * i});
  const auto points = at(places);
  const Track track = make_track(points, false);
  for (const double s : {0.0, 1.23, 5.0, 10.0}) {
    const FitJoint pose = local_pose(track, s, 1);
    EXPECT_NEAR(pose.position.x, 0.6 * s, 1e-9);
    EXPECT_NEAR(pose.position.y, 0.8 * s, 1e-9);
    EXPECT_NEAR(pose.direction, std::atan2(4, 3), 1e-9);
    EXPECT_NEAR(pose.curvature, 0, 1e-9);
  }
}

// Points at equal chords of a circle: a parabola through a few of them bends as it does, to the
// square of the angle they span.
TEST(LocalPose, OfACircleBendsAsItDoes) {
  for (const double sense : {1.0, -1.0}) {
    std::vector<core::Point2> places;
    for (int i = 0; i < 120; ++i) {
      const double t = sense * 2 * std::numbers::pi * i / 120;
      places.push_back({2 * std::cos(t), 2 * std::sin(t)});
    }
    const auto points = at(places);
    const Track track = make_track(points, true);
    for (const double share : {0.0, 0.3, 0.75, 1.0}) {
      const FitJoint pose = local_pose(track, share * track.total, 0.25);
      const double t = sense * 2 * std::numbers::pi * share;
      EXPECT_NEAR(pose.position.x, 2 * std::cos(t), 2e-3);
      EXPECT_NEAR(pose.position.y, 2 * std::sin(t), 2e-3);
      EXPECT_NEAR(pose.curvature, sense * 0.5, 0.005);
      const double direction = t + sense * std::numbers::pi / 2;
      EXPECT_NEAR(std::remainder(pose.direction - direction, 2 * std::numbers::pi), 0, 2e-3);
    }
  }
}

// Five points at least: a reach that holds none does not leave the fit without data.
TEST(LocalPose, TakesFivePointsAtLeast) {
  const auto points = at({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}});
  const Track track = make_track(points, false);
  const FitJoint pose = local_pose(track, 2.5, 1e-6);
  EXPECT_NEAR(pose.position.x, 2.5, 1e-6);
  EXPECT_NEAR(pose.direction, 0, 1e-9);
}

// Weights fall towards the ends of the reach, all count: the largest of a bump of three points is
// above their unweighted mean.
TEST(LocalPose, WeighsWhatIsNearMore) {
  std::vector<core::Point2> places;
  for (int i = -10; i <= 10; ++i) places.push_back({0.1 * i, i == 0 ? 1e-3 : 0.0});
  const auto points = at(places);
  const Track track = make_track(points, false);
  // By hand: least squares of y = a + b u^2 with weights 1.02 - u^2 at u = -1, -0.9, …, 1.
  double w0 = 0, w2 = 0, w4 = 0;
  for (int i = -10; i <= 10; ++i) {
    const double u = 0.1 * i, w = 1.02 - u * u;
    w0 += w;
    w2 += w * u * u;
    w4 += w * u * u * u * u;
  }
  const double a = 1.02e-3 * w4 / (w0 * w4 - w2 * w2);
  EXPECT_NEAR(local_pose(track, track.total / 2, track.total / 2 - 1e-9).position.y, a, 2e-6);
}

}  // namespace
}  // namespace keyline::fairing::detail
