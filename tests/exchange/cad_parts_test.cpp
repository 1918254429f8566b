#include "keyline/exchange/cad/cad_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/closest_point.h"
#include "keyline/curve/conversion.h"
#include "keyline/curve/length.h"
#include "keyline/document/arc.h"

namespace keyline::exchange {
namespace {

using core::Point2;

constexpr double kTolerance = 1e-4;

/// A line, an arc to the right, a line of points and a cubic, end to end.
CadParts chain() {
  CadParts parts;
  parts.parts.emplace_back(CadLine{{0, 0}, {2, 0}});
  parts.parts.emplace_back(document::Arc{{2, -1}, 1, core::kPi / 2, -core::kPi / 2});
  parts.parts.emplace_back(curve::Polyline2{{{3, -1}, {3.5, -2}, {3.2, -2.5}, {4, -3}}});
  parts.parts.emplace_back(
      curve::BSpline2{3, {0, 0, 0, 0, 1, 1, 1, 1}, {{4, -3}, {5, -3}, {6, -4}, {6, -5}}, {}});
  return parts;
}

Point2 at(const CadPart& part, double t) {
  if (const auto* line = std::get_if<CadLine>(&part)) return mix(line->from, line->to, t);
  if (const auto* arc = std::get_if<document::Arc>(&part))
    return document::point_on(*arc, arc->start + t * arc->turn);
  if (const auto* line = std::get_if<curve::Polyline2>(&part)) return evaluate(*line, t);
  return evaluate(std::get<curve::BSpline2>(part), t);
}

TEST(CadParts, MeetWhereOneEndsAndTheNextStarts) {
  CadParts parts = chain();
  EXPECT_TRUE(is_chain(parts));
  EXPECT_FALSE(is_bulged(parts));
  for (const CadPart& part : parts.parts) {
    EXPECT_LT(distance(start_of(part), at(part, 0)), 1e-15);
    EXPECT_LT(distance(end_of(part), at(part, 1)), 1e-15);
  }
  std::swap(parts.parts[0], parts.parts[1]);
  EXPECT_FALSE(is_chain(parts));
  parts.parts.resize(1);
  EXPECT_FALSE(is_chain(parts));
  EXPECT_TRUE(is_bulged(parts));
}

/// A cubic that arrives upwards and one that leaves in that direction, turned by so much.
document::Path two_cubics(double turn) {
  const auto out = [turn](double x, double y) {
    return Point2{2 + x * std::cos(turn) - y * std::sin(turn),
                  2 + x * std::sin(turn) + y * std::cos(turn)};
  };
  return {{{curve::Bezier2{{{0, 0}, {1, 0}, {2, 1}, {2, 2}}, {}}},
           {curve::Bezier2{{{2, 2}, out(0, 1), out(1, 2), out(2, 2)}, {}}}},
          false};
}

TEST(CadParts, GoOnAsOneSplineButForCorners) {
  const CadParts smooth = cad_parts(two_cubics(0), kTolerance).value();
  ASSERT_EQ(smooth.parts.size(), 1U);
  EXPECT_EQ(std::get<curve::BSpline2>(smooth.parts[0]).control.size(), 7U);
  EXPECT_EQ(cad_parts(two_cubics(0.9e-6), kTolerance).value().parts.size(), 1U);
  EXPECT_EQ(cad_parts(two_cubics(1.1e-6), kTolerance).value().parts.size(), 2U);
}

TEST(ChainSpline, FollowsEveryPart) {
  CadParts parts = chain();
  parts.deviation = 1e-3;
  const ChainSpline spline = chain_spline(parts, kTolerance);
  EXPECT_TRUE(spline.curve.weights.empty());
  double farthest = 0;
  for (const CadPart& part : parts.parts)
    for (int i = 0; i <= 60; ++i)
      farthest =
          std::max(farthest, curve::closest_point(spline.curve, at(part, i / 60.0)).distance);
  EXPECT_LE(farthest, spline.deviation - parts.deviation + 1e-14);
  EXPECT_LE(spline.deviation, parts.deviation + kTolerance);
  EXPECT_EQ(evaluate(spline.curve, 0), (Point2{0, 0}));
  EXPECT_LT(distance(evaluate(spline.curve, 1), {6, -5}), 1e-15);
  // No more than the parts are: as long as they are together.
  const double length = 2 + core::kPi / 2 +
                        curve::arc_length(std::get<curve::Polyline2>(parts.parts[2])) +
                        curve::arc_length(std::get<curve::BSpline2>(parts.parts[3]));
  EXPECT_NEAR(curve::arc_length(spline.curve), length, 1e-3);
}

TEST(BulgedPolyline, HasTheParts) {
  CadParts parts = chain();
  const BulgedPolyline line = bulged_polyline(parts, false, kTolerance);
  ASSERT_GT(line.vertices.size(), 8u);
  EXPECT_EQ(line.vertices[0].point, (Point2{0, 0}));
  EXPECT_EQ(line.vertices[1].point, (Point2{2, 0}));
  EXPECT_EQ(line.vertices[0].bulge, 0);
  EXPECT_NEAR(line.vertices[1].bulge, std::tan(-core::kPi / 8), 1e-15);
  EXPECT_EQ(line.vertices[3].point, (Point2{3.5, -2}));
  EXPECT_EQ(line.vertices.back().point, (Point2{6, -5}));
  EXPECT_LE(line.deviation, kTolerance);
  EXPECT_GT(line.deviation, 0);
  EXPECT_FALSE(line.closed);
  // Closed, the last point is the first where they are one.
  parts.parts.emplace_back(CadLine{{6, -5}, {0, 0}});
  const BulgedPolyline closed = bulged_polyline(parts, true, kTolerance);
  EXPECT_TRUE(closed.closed);
  EXPECT_EQ(closed.vertices.size(), line.vertices.size());
  EXPECT_EQ(closed.vertices.back().point, (Point2{6, -5}));
}

// A straight cubic is one edge, a bent one as many as its second derivative asks for: of
// (0, 0), (1, 0), (2, 1), (3, 1) that is 6, so that n edges are within 6 / 8 / n^2. Half of the
// tolerance is theirs, 0.031: five, for four are within 0.047.
TEST(BulgedPolyline, HasNoMoreEdgesThanItTakes) {
  for (const auto& [high, edges] : {std::pair{0.0, 1U}, {1.0, 5U}}) {
    CadParts parts;
    parts.parts.emplace_back(
        curve::BSpline2{3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0}, {1, 0}, {2, high}, {3, high}}, {}});
    const BulgedPolyline line = bulged_polyline(parts, false, 0.062);
    ASSERT_EQ(line.vertices.size(), edges + 1);
    EXPECT_NEAR(line.deviation, high * 6 / 8 / (edges * edges), 1e-15);
    EXPECT_EQ(line.vertices.back().point, (Point2{3, high}));
  }
}

}  // namespace
}  // namespace keyline::exchange
