#include "keyline/surface/stripe_turn.h"

#include <random>

#include <gtest/gtest.h>

#include "keyline/surface/joints.h"

#include "test_surfaces.h"

namespace keyline::surface {
namespace {

using core::kPi;
using core::Vector3;

/// A quarter of a cylinder below an eighth of a sphere: v = 1 is the equator.
BezierSurface below_the_octant(double r) {
  const double w = std::numbers::sqrt2 / 2;
  const double at[3][2] = {{1, 0}, {1, 1}, {0, 1}};
  BezierSurface s{{3, 2, {}}, {1, 1, w, w, 1, 1}};
  for (const auto& p : at)
    for (const double z : {-3.0, 0.0}) s.net.points.push_back({r * p[0], r * p[1], z});
  return s;
}

// The sphere's stripe leaves the joint at phi, the cylinder's across it, and stripes cross as
// cos phi: the mean of |phi| is pi / 2 - 1, whatever the radius.
TEST(StripeTurn, OfASphereOnACylinderIsHalfPiLessOne) {
  for (const double r : {0.001, 1.0, 500.0}) {
    EdgeTolerance tolerance;
    const auto c = edge_continuity(below_the_octant(r), sphere_octant(r),
                                   std::array{Edge::v1, Edge::v0}, tolerance);
    ASSERT_TRUE(c);
    EXPECT_EQ(c->order, 1);
    EXPECT_NEAR(c->stripe_turn, kPi / 2 - 1, 1e-12);
    EXPECT_NEAR(c->turning, kPi / 2, 1e-3);  // chords of 101 places
  }
}

TEST(StripeTurn, OfHalvesOfOnePatchIsNone) {
  const auto [a, b] = halves_u(crowned_patch());
  const std::vector<BezierSurface> two{a, b};
  const JointSummary summary = measure_joints(joints_of(two, 1e-6), two);
  ASSERT_EQ(summary.joints, 1U);
  EXPECT_LT(summary.zebra.jump, 1e-12);
  EXPECT_LT(summary.zebra.turn, 1e-9);
}

/// A rectangle from the top line of a cylinder of radius r outwards, that falls by `fold`.
BezierSurface tilted(double r, double fold) {
  const double x = 5 * std::cos(fold);
  const double z = 5 * std::sin(fold);
  return {{2, 2, {{0, 0, r}, {0, 7, r}, {-x, 0, r - z}, {-x, 7, r - z}}}, {}};
}

// A mirror that turns by an angle turns the ray by twice as much. Along a straight line of a
// cylinder the normal stands still: stripes run beside it and none turns.
TEST(StripeTurn, FoldsTearByTwiceTheirAngle) {
  const double r = 4;
  for (const double fold : {0.0, 0.01, 0.3}) {
    const std::vector<BezierSurface> two{tilted(r, fold), quarter_cylinder(0, 0, r, 7)};
    const JointSummary summary = measure_joints(joints_of(two, 1e-6), two);
    ASSERT_EQ(summary.joints, 1U);
    EXPECT_NEAR(summary.zebra.jump, 2 * fold, 1e-12);
    EXPECT_NEAR(summary.zebra.mean_jump, 2 * fold, 1e-12);
    EXPECT_EQ(summary.zebra.turn, 0);
    EXPECT_EQ(summary.zebra.mean_turn, 0);
  }
}

// A crease is no gap, and a gap is no crease.
TEST(StripeTurn, GapsAreNotFolds) {
  std::vector<BezierSurface> two{tilted(4, 0.3), quarter_cylinder(0, 0, 4, 7)};
  const auto joints = joints_of(two, 1e-6);
  for (core::Point3& p : two[0].net.points) p.z += 0.01;
  const JointSummary summary = measure_joints(joints, two);
  EXPECT_EQ(summary.order_at_least[0], 0U);
  EXPECT_EQ(summary.angle, 0);
  EXPECT_EQ(summary.zebra.jump, 0);
}

/// Latitude of the mirrored ray at (x, y) of z = (c x^2 + 2 q x y + p y^2) / 2.
double latitude(const CurvatureForm& f, Vector3 view, Vector3 stripes, double x, double y) {
  Vector3 n{-(f.xx * x + f.xy * y), -(f.xy * x + f.yy * y), 1};
  n = n / norm(n);
  return std::asin(dot(2 * dot(view, n) * n - view, stripes));
}

/// The mean turn over random lights, from level lines of the zebra itself by differences.
double turn_by_lights(const CurvatureForm& one, const CurvatureForm& two) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    const Vector3 v{normal(random), normal(random), normal(random)};
    return v / norm(v);
  };
  double sum = 0;
  double crossing = 0;
  for (int i = 0; i < 200'000; ++i) {
    const Vector3 view = direction();
    const Vector3 stripes = direction();
    const double h = 1e-6;
    const auto leaves = [&](const CurvatureForm& f) {
      const double x = latitude(f, view, stripes, h, 0) - latitude(f, view, stripes, -h, 0);
      const double y = latitude(f, view, stripes, 0, h) - latitude(f, view, stripes, 0, -h);
      return std::pair{std::atan(-x / y), std::abs(y)};
    };
    const auto [a, weight] = leaves(one);
    const auto [b, same] = leaves(two);
    EXPECT_NEAR(weight, same, 1e-9);
    sum += weight * std::abs(a - b);
    crossing += weight;
  }
  return sum / crossing;
}

TEST(StripeTurn, IsTheMeanOverRandomLights) {
  const CurvatureForm pairs[][2] = {{{1, 0, 1}, {0, 0, 1}},
                                    {{1, 0, 1}, {-2, 0, 1}},
                                    {{0.5, 0.7, 0.3}, {0.8, 0.7, 0.3}},
                                    {{3, 0.2, -0.5}, {-1, 0.2, -0.5}},
                                    {{0.4, 0.9, 0}, {0.1, 0.9, 0}},
                                    {{1, 0.01, 0.02}, {1.2, 0.01, 0.02}}};
  for (const auto& [one, two] : pairs) {
    const double turn = stripe_turn(one, two);
    EXPECT_NEAR(turn, turn_by_lights(one, two), 0.01) << one.xx << " " << two.xx;
    EXPECT_GT(turn, 0.01);
    EXPECT_NEAR(stripe_turn(two, one), turn, 1e-13);
    const CurvatureForm left{one.xx, -one.xy, one.yy};
    EXPECT_NEAR(stripe_turn(left, {two.xx, -two.xy, two.yy}), turn, 1e-13);
    const CurvatureForm large{1e6 * one.xx, 1e6 * one.xy, 1e6 * one.yy};
    EXPECT_NEAR(stripe_turn(large, {1e6 * two.xx, 1e6 * two.xy, 1e6 * two.yy}), turn, 1e-12);
  }
}

TEST(StripeTurn, VanishesWithTheJumpAndIsFiniteEverywhere) {
  double before = 1;
  for (double jump = 0.1; jump > 1e-9; jump /= 10) {
    const double turn = stripe_turn({1, 0.3, 0.8}, {1 + jump, 0.3, 0.8});
    EXPECT_LT(turn, 0.2 * before);
    before = turn;
  }
  EXPECT_EQ(stripe_turn({1, 0.3, 0.8}, {1, 0.3, 0.8}), 0);
  for (const double small : {0.0, 1e-300, 1e-30, 1e-11, 1e-6}) {
    const double turn = stripe_turn({1, small, small}, {-1, small, small});
    EXPECT_TRUE(std::isfinite(turn)) << small;
    EXPECT_GE(turn, 0);
    EXPECT_LE(turn, kPi);
  }
}

}  // namespace
}  // namespace keyline::surface
