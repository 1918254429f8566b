#include "keyline/surface/closest_point.h"

#include <array>

#include <gtest/gtest.h>

namespace keyline::surface {
namespace {

using core::Vector3;

/// A plane whose sides stand at an angle, of sizes of their own.
SurfaceJet plane() {
  SurfaceJet j;
  j.u = {2, 0, 0};
  j.v = {1, 3, 0};
  return j;
}

// Of a plane one step comes to the foot: what is left of the offset is square to both sides.
TEST(FootStep, OfAPlaneIsTheWholeWay) {
  const SurfaceJet j = plane();
  for (const Vector3 off : {Vector3{1, -2, 5}, {-3, 1, 0}, {0, 0, 4}}) {
    const auto [du, dv] = foot_step(j, off, 0.4, 0.6);
    const Vector3 left = off + du * j.u + dv * j.v;
    EXPECT_NEAR(core::dot(left, j.u), 0, 1e-14);
    EXPECT_NEAR(core::dot(left, j.v), 0, 1e-14);
  }
}

// At a border the side that pulls out stays, and the other goes to the foot of its own line.
TEST(FootStep, StaysAtABorderThatPullsOut) {
  const SurfaceJet j = plane();
  const Vector3 off{1, 6, 0};  // both sides pull down
  EXPECT_EQ(foot_step(j, off, 0, 0), (std::array{0.0, 0.0}));
  EXPECT_EQ(foot_step(j, off, 0, 0.5), (std::array{0.0, -19.0 / 10}));
  EXPECT_EQ(foot_step(j, off, 0.5, 0), (std::array{-2.0 / 4, 0.0}));
  EXPECT_EQ(foot_step(j, -off, 1, 1), (std::array{0.0, 0.0}));
  EXPECT_EQ(foot_step(j, -off, 0.5, 1), (std::array{2.0 / 4, 0.0}));
  // Inwards it is free: as within.
  EXPECT_EQ(foot_step(j, off, 1, 1), foot_step(j, off, 0.5, 0.5));
  EXPECT_EQ(foot_step(j, -off, 0, 0), foot_step(j, -off, 0.5, 0.5));
}

// Where both sides are along one line, u alone goes.
TEST(FootStep, OfOneDirectionTheFirstSideGoes) {
  SurfaceJet j = plane();
  j.v = {3, 0, 0};
  EXPECT_EQ(foot_step(j, {1, 2, 3}, 0.5, 0.5), (std::array{-0.5, 0.0}));
}

// Of a rectangle and its half the whole reaches farther, whichever is named first.
TEST(Departure, IsThatOfTheFarthestOfBoth) {
  const auto rectangle = [](double width) {
    return BezierSurface{{2, 2, {{0, 0, 0}, {0, 1, 0}, {width, 0, 0}, {width, 1, 0}}}, {}};
  };
  const Surface whole = rectangle(2), half = rectangle(1);
  EXPECT_NEAR(departure(whole, half, 5), 1, 1e-12);
  EXPECT_NEAR(departure(half, whole, 5), 1, 1e-12);
  EXPECT_NEAR(departure(half, half, 5), 0, 1e-12);
}

}  // namespace
}  // namespace keyline::surface
