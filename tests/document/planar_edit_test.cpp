#include "keyline/document/planar_edit.h"

#include <numbers>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/curve/length.h"

namespace keyline::document {
namespace {

// Three edges: both cuts lie inside one, inside two, at a vertex.
TEST(Part, OfAPolylineBeginsAndEndsWhereItIsCut) {
  using Points = std::vector<core::Point2>;
  const Path line{{{curve::Polyline2{{{0, 0}, {3, 0}, {3, 3}, {0, 3}}}}}, false};
  const auto points = [&](double low, double high) {
    return std::get<curve::Polyline2>(part(line, {low / 12, high / 12}).curves.at(0).value).points;
  };
  const auto expect = [&](double low, double high, const Points& wanted) {
    const Points got = points(low, high);
    ASSERT_EQ(got.size(), wanted.size());
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_LT(distance(got[i], wanted[i]), 1e-14);
  };
  expect(1, 3, {{0.75, 0}, {2.25, 0}});
  expect(2, 7, {{1.5, 0}, {3, 0}, {3, 2.25}});
  expect(6, 11, {{3, 1.5}, {3, 3}, {0.75, 3}});
  expect(4, 10, {{3, 0}, {3, 3}, {1.5, 3}});
}

// A circle of radius 2 from its lowest point on; from 0.8 to 0.3 of it are its half.
TEST(PartOverSeam, OfACircleIsAnArcOfOneChain) {
  const double half = 2 * std::numbers::pi;
  const lac::Chain circle{{{0, -2}, 0}, {{-1, half, 0.5, 0.5}, {-1, half, 0.5, 0.5}}, true};
  const Path part = part_over_seam({{{circle}}, true}, 0.8, 0.3);
  EXPECT_FALSE(part.closed);
  ASSERT_EQ(part.curves.size(), 1U);
  const auto& arc = std::get<lac::Chain>(part.curves[0].value);
  EXPECT_NEAR(lac::arc_length(arc), half, 1e-14);
  for (const auto& [t, turn] : {std::pair{0.0, 0.8}, {1.0, 0.3}}) {
    const double angle = 2 * std::numbers::pi * turn;
    EXPECT_LT(distance(evaluate(part, t), {2 * std::sin(angle), -2 * std::cos(angle)}), 1e-13);
  }
  const Path beginning = part_over_seam({{{circle}}, true}, 1, 0.25);
  ASSERT_EQ(beginning.curves.size(), 1U);
  EXPECT_NEAR(lac::arc_length(std::get<lac::Chain>(beginning.curves[0].value)), half / 2, 1e-14);
}

// A drop: three quarters of a circle round, its straight sides meet at right angles at the seam.
TEST(PartOverSeam, LeavesACornerAtTheSeam) {
  const double turn = 1.5 * std::numbers::pi;
  const lac::Chain drop{
      {{0, 0}, -std::numbers::pi / 4}, {{-1, 1, 0, 0}, {-1, turn, 1, 1}, {-1, 1, 0, 0}}, true};
  const Path closed{{{drop}}, true};
  ASSERT_LT(distance(evaluate(closed, 0), evaluate(closed, 1)), 1e-15);
  const Path part = part_over_seam(closed, 0.9, 0.1);
  ASSERT_EQ(part.curves.size(), 2U);
  EXPECT_LT(distance(evaluate(part.curves[0], 1), {0, 0}), 1e-15);
  EXPECT_LT(distance(evaluate(part.curves[1], 0), {0, 0}), 1e-15);
}

/// Of one that comes back, a hundred-thousandth of an offset's length being no gap.
core::Result<Offset> offset_of(const Path& path, double distance) {
  return offset(path, distance, 1e-6, 1e-5);
}

// Steiner: outside a convex outline the offset is longer by the distance times one full turn,
// whether or not the outline is called closed.
TEST(Offset, RunsAroundACornerWhereTheCurveComesBack) {
  const double turn = 1.5 * std::numbers::pi;
  const PlanarCurve square{curve::Polyline2{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}}};
  const PlanarCurve drop{lac::Chain{
      {{0, 0}, -std::numbers::pi / 4}, {{-1, 1, 0, 0}, {-1, turn, 1, 1}, {-1, 1, 0, 0}}, false}};
  PlanarCurve closed_drop = drop;
  std::get<lac::Chain>(closed_drop.value).closed = true;
  for (const bool closed : {false, true})
    for (const auto& [outline, length, corners] :
         {std::tuple{square, 4.0, 4}, {closed ? closed_drop : drop, 2 + turn, 1}}) {
      const Path path{{outline}, closed};
      const auto outside = offset_of(path, -0.3);
      ASSERT_TRUE(outside) << outside.error().message;
      EXPECT_EQ(outside->arcs, corners);
      EXPECT_TRUE(outside->path.closed);
      EXPECT_LT(distance(evaluate(outside->path, 0), evaluate(outside->path, 1)), 1e-14);
      const double around = 0.6 * std::numbers::pi;
      double all = 0;
      for (const PlanarCurve& c : outside->path.curves)
        if (const auto* chain = std::get_if<lac::Chain>(&c.value)) {
          EXPECT_FALSE(chain->closed);
          all += lac::arc_length(*chain);
        } else {
          all += distance(evaluate(c, 0), evaluate(c, 1));
        }
      EXPECT_NEAR(all, length + around, 1e-6);
      EXPECT_FALSE(offset_of(path, 0.3));
    }
  const Path open{{{curve::Polyline2{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}}, false};
  EXPECT_FALSE(offset_of(open, -0.3)->path.closed);
}

// A loop that leaves its start along x and comes back along y: on the inside its offset crosses
// itself there, and so it does begun anywhere else.
TEST(Offset, IsRefusedWhereACornerAtTheStartCloses) {
  const curve::Bezier2 loop{{{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}}, {}};
  EXPECT_FALSE(offset_of({{{loop}}, false}, 0.2));
  const auto [first, second] = split(loop, 0.5);
  EXPECT_FALSE(offset_of({{{second}, {first}}, true}, 0.2));
  const auto outside = offset_of({{{loop}}, false}, -0.2);
  ASSERT_TRUE(outside);
  EXPECT_EQ(outside->arcs, 1);
}

// A circle whose turning is a ten-millionth short of a full one: a circle, in one piece.
TEST(Offset, TakesRoundingAtTheStartForNoCorner) {
  const double length = 2 * std::numbers::pi * (1 - 1e-7);
  const auto made =
      offset_of({{{lac::Chain{{{0, -1}, 0}, {{-1, length, 1, 1}}, false}}}, false}, 0.5);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->arcs, 0);
  ASSERT_EQ(made->path.curves.size(), 1U);
  EXPECT_TRUE(std::get<lac::Chain>(made->path.curves[0].value).closed);
}

double length_of(const Path& path) {
  double all = 0;
  for (const PlanarCurve& c : path.curves) {
    const auto* chain = std::get_if<lac::Chain>(&c.value);
    all += chain ? lac::arc_length(*chain) : curve::arc_length(PlacedCurve(c));
  }
  return all;
}

/// The largest gap between two of its members.
double gap_of(const Path& path) {
  double most = 0;
  for (std::size_t i = 0; i + 1 < path.curves.size(); ++i)
    most = std::max(most, distance(evaluate(path.curves[i], 1), evaluate(path.curves[i + 1], 0)));
  return most;
}

// Two straight edges of one spline: turned about on the outside, refused on the inside.
TEST(Offset, TurnsTheCornersOfASpline) {
  const core::Point2 a{0, 0}, b{1, 1}, c{2, 4};
  const curve::BSpline2 splines[] = {
      {1, {0, 0, 1, 2, 2}, {a, b, c}, {}},
      {1, {0, 0, 1, 2, 3, 3}, {a, b, b, c}, {}},
      {2, {0, 0, 0, 1, 1, 2, 2, 2}, {a, core::mix(a, b, 0.5), b, core::mix(b, c, 0.5), c}, {}},
      {3, {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4}, {a, core::mix(a, b, 0.5), b, b, b, c, c}, {}}};
  const double turn = std::atan2(3, 1) - std::numbers::pi / 4;
  const double edges = distance(a, b) + distance(b, c);
  for (const curve::BSpline2& spline : splines) {
    ASSERT_TRUE(validate(spline));
    const auto outside = offset_of({{{spline}}, false}, -0.05);
    ASSERT_TRUE(outside) << outside.error().message;
    EXPECT_EQ(outside->arcs, 1);
    EXPECT_LT(gap_of(outside->path), 1e-12);
    EXPECT_NEAR(length_of(outside->path), edges + 0.05 * turn, 1e-6);
    EXPECT_FALSE(offset_of({{{spline}}, false}, 0.05));
  }
}

// A cubic with a cusp at its middle, where it turns back: half a circle about that on the side on
// which curvature is 0 at most.
TEST(Offset, TurnsAboutACusp) {
  const curve::Bezier2 cusp{{{0, 0}, {1, 1}, {0, 1}, {1, 0}}, {}};
  const auto made = offset_of({{{cusp}}, false}, -0.02);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->arcs, 1);
  EXPECT_LE(made->deviation, 1e-6);
  EXPECT_LT(gap_of(made->path), 1e-9);
  EXPECT_FALSE(offset_of({{{cusp}}, false}, 0.02));
}

// There and back: half a circle about the far end on either side.
TEST(Offset, OpensWhereTheCurveTurnsBack) {
  for (const double distance : {0.1, -0.1}) {
    const auto made =
        offset({{{curve::Polyline2{{{0, 0}, {1, 0}, {0, 0.0}}}}}, false}, distance, 1e-6, 0);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->arcs, 2);  // it closes
    EXPECT_NEAR(length_of(made->path), 2 + 0.2 * std::numbers::pi, 1e-9);
  }
}

TEST(Offset, LeavesMembersWithoutLengthOut) {
  const auto line = [](core::Point2 from, core::Point2 to) {
    return PlanarCurve{curve::Bezier2{{from, to}, {}}};
  };
  const Path up{{line({0, 0}, {0, 1}), line({0, 1}, {0, 1}), line({0, 1}, {0, 2})}, false};
  for (const double distance : {0.1, -0.1}) {
    const auto made = offset_of(up, distance);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->arcs, 0);
    EXPECT_NEAR(length_of(made->path), 2, 1e-9);
  }
  EXPECT_FALSE(offset_of({{line({0, 1}, {0, 1})}, false}, 0.1));
}

TEST(PartOverSeam, KeepsTheMembersOfAPath) {
  const Path triangle{{{curve::Bezier2{{{0, 0}, {4, 0}}, {}}},
                       {curve::Bezier2{{{4, 0}, {0, 3}}, {}}},
                       {curve::Bezier2{{{0, 3}, {0, 0}}, {}}}},
                      true};
  const Path part = part_over_seam(triangle, 0.5, 1.0 / 6);
  ASSERT_EQ(part.curves.size(), 3U);
  EXPECT_LT(distance(evaluate(part, 0), {2, 1.5}), 1e-15);
  EXPECT_LT(distance(evaluate(part, 1), {2, 0}), 1e-15);
  EXPECT_EQ(part_over_seam(triangle, 1, 0.5).curves.size(), 2U);
  EXPECT_EQ(part_over_seam(triangle, 0.5, 0).curves.size(), 2U);
  const Path square{{{curve::Polyline2{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}}}}, true};
  const Path line = part_over_seam(square, 0.875, 0.125);
  ASSERT_EQ(line.curves.size(), 1U);
  EXPECT_EQ(std::get<curve::Polyline2>(line.curves[0].value).points,
            (std::vector<core::Point2>{{0, 0.5}, {0, 0}, {0.5, 0}}));
  const Path halves{
      {{curve::Polyline2{{{0, 0}, {1, 0}, {1, 1}}}}, {curve::Polyline2{{{1, 1}, {0, 1}, {0, 0}}}}},
      true};
  EXPECT_EQ(part_over_seam(halves, 0.75, 0.25).curves.size(), 2U);
}

}  // namespace
}  // namespace keyline::document
