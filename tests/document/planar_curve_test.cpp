#include "keyline/document/planar_curve.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/arriving.h"

namespace keyline::document {
namespace {

Path two_lines() {
  return {{{curve::Polyline2{{{0, 0}, {1, 0}}}}, {curve::Polyline2{{{1, 0}, {1, 2}}}}}, false};
}

TEST(Path, MembersShareTheParameterEvenly) {
  const Path path = two_lines();
  EXPECT_EQ(evaluate(path, 0.25), (core::Point2{0.5, 0}));
  EXPECT_EQ(evaluate(path, 0.75), (core::Point2{1, 1}));
  EXPECT_EQ(evaluate(path, 1), (core::Point2{1, 2}));
  EXPECT_EQ(breakpoints(path), (std::vector<double>{0, 0.5, 1}));
}

TEST(Path, JetIsInThePathsParameter) {
  const curve::Jet2 at = jet(two_lines(), 0.75);
  EXPECT_EQ(at.first, (core::Vector2{0, 4}));
}

// Where a place has no direction by its derivatives, it has that of the curve beside it.
TEST(Path, HasADirectionWhereItRests) {
  const double up = core::kPi / 2;
  const auto leaves = [](const auto& c, double t) { return curve::tangent_angle(jet(c, t)); };
  const auto arrives = [](const auto& c, double t) { return curve::arriving_angle(jet(c, t)); };
  const core::Point2 o{0, 0};
  const PlanarCurve handles{curve::Bezier2{{o, o, o, o, {0, 1}, {1, 2}}, {}}};
  EXPECT_NEAR(leaves(handles, 0), up, 1e-15);
  EXPECT_NEAR(arrives(reverse(handles), 1), -up, 1e-15);
  const PlanarCurve spline{
      curve::BSpline2{1, {0, 0, 1, 2, 3, 4, 4}, {o, o, {0, 1}, {0, 1}, {-1, 1}}, {}}};
  for (const auto& [t, angle] :
       {std::pair{0.0, up}, {0.1, up}, {0.25, up}, {0.5, core::kPi}, {0.6, core::kPi}})
    EXPECT_NEAR(leaves(spline, t), angle, 1e-15) << t;
  EXPECT_NEAR(arrives(PlanarCurve{curve::BSpline2{1, {0, 0, 1, 2, 2}, {o, {0, 1}, {0, 1}}, {}}}, 1),
              up, 1e-15);
  const PlanarCurve point{curve::Bezier2{{{0, 1}, {0, 1}, {0, 1}}, {}}};
  const Path path{{point, {curve::Bezier2{{{0, 1}, {0, 2}}, {}}}, point}, false};
  const PlacedPath placed(path);
  for (const double t : {0.0, 0.2, 0.5, 0.8, 1.0}) {
    EXPECT_NEAR(leaves(path, t), up, 1e-15) << t;
    EXPECT_NEAR(arrives(placed, t), up, 1e-15) << t;
    EXPECT_EQ(norm(jet(placed, t).first) > 0, t == 0.5);
  }
}

TEST(Path, ReverseRunsTheSameWayBack) {
  const Path back = reverse(two_lines());
  EXPECT_EQ(evaluate(back, 0.25), (core::Point2{1, 1}));
}

TEST(Path, ValidationNamesTheMember) {
  Path path = two_lines();
  path.curves[1] = {curve::Polyline2{{{1, 0}}}};
  const auto sound = validate(path);
  ASSERT_FALSE(sound);
  EXPECT_TRUE(sound.error().path.starts_with("curves[1]")) << sound.error().path;
  EXPECT_FALSE(validate(Path{}));
}

/// What views look at in a path's stead, and in that of each member.
TEST(PlacedPath, GivesTheSameToTheBit) {
  lac::Chain chain{{{1, 2}, 0.5}, {{-1, 3, 0, 1.5}, {1, 2, 1.5, 0.2}, {0, 1, 0.2, 0.7}}, false};
  Path path;
  path.curves.push_back({curve::Bezier2{{{0, 0}, {1, 1}, {1, 2}}, {}}});
  path.curves.push_back({chain});
  path.curves.push_back({curve::Polyline2{{{2, 2}, {4, 0}}}});
  const PlacedPath placed = prepared(path);
  for (int i = 0; i <= 300; ++i) {
    const double t = i / 300.0;
    EXPECT_EQ(evaluate(placed, t), evaluate(path, t));
    EXPECT_EQ(jet(placed, t).first, jet(path, t).first);
    EXPECT_EQ(jet(placed, t).third, jet(path, t).third);
  }
  EXPECT_EQ(breakpoints(placed), breakpoints(path));
  EXPECT_EQ(evaluate(prepared(path.curves[1]), 0.7), evaluate(path.curves[1], 0.7));
}

// Lines that turn by a radian each: which member is looked at is told by the direction. In 49 parts
// a breakpoint times their number is not a whole number.
TEST(Path, ABreakpointIsOfTheMemberBehindIt) {
  Path path;
  core::Point2 at;
  for (int i = 0; i < 98; ++i) {
    const core::Point2 next = at + core::unit_vector(1.0 * i);
    path.curves.push_back({curve::Bezier2{{at, next}, {}}});
    at = next;
  }
  const PlacedPath placed = prepared(path);
  const std::vector<double> breaks = breakpoints(path);
  const auto turns = [](const curve::Jet2& j, int i) {
    const core::Vector2 along = core::unit_vector(1.0 * i);
    return dot(curve::unit_tangent(j), along) < 1 - 1e-12;
  };
  for (int i = 0; i < 98; ++i) {
    EXPECT_FALSE(turns(jet(path, breaks[i]), i)) << i;
    EXPECT_FALSE(turns(jet(placed, breaks[i]), i)) << i;
    EXPECT_FALSE(turns(jet(path, std::nextafter(breaks[i + 1], 0)), i)) << i;
    EXPECT_FALSE(turns(jet(placed, std::nextafter(breaks[i + 1], 0)), i)) << i;
  }
}

// Where a member has breakpoints of its own, at which its curvature jumps.
TEST(PlacedPath, WhatIsBeforeABreakpointOfAMemberIsBeforeIt) {
  Path path;
  for (int i = 0; i < 7; ++i) {
    lac::Chain chain{{{0, 0}, 0}, {}, false};
    for (int k = 0; k < 11; ++k) chain.pieces.push_back({-1, 0.3 + 0.1 * k, 1.0 + k, 1.0 + k});
    path.curves.push_back({chain});
  }
  const PlacedPath placed = prepared(path);
  const std::vector<double> breaks = breakpoints(path);
  ASSERT_EQ(breaks.size(), 78U);
  for (int i = 0; i < 77; ++i) {
    EXPECT_NEAR(curve::curvature(jet(placed, breaks[i])), 1 + i % 11, 1e-9) << i;
    EXPECT_NEAR(curve::curvature(jet(placed, std::nextafter(breaks[i + 1], 0))), 1 + i % 11, 1e-9);
  }
}

}  // namespace
}  // namespace keyline::document
