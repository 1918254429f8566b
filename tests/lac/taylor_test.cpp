#include "keyline/lac/segment/taylor.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/curve/bezier.h"
#include "keyline/lac/segment/bezier_feet.h"

/// Taylor series of pieces and their bounds, and feet on Béziers.
namespace keyline::lac::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(UnitPiece, IsOfLengthOneAndTurnsLeft) {
  const UnitPiece left = unit_piece({-1, 4, 0.5, 1});
  EXPECT_EQ(left.piece, (Piece{-1, 1, 2, 4}));
  EXPECT_EQ(left.length, 4);
  EXPECT_EQ(left.mirror, 1);
  EXPECT_NEAR(left.turning, 3, 1e-15);
  const UnitPiece right = unit_piece({-1, 4, 0.5, -1});
  EXPECT_EQ(right.piece, (Piece{-1, 1, -2, 4}));
  EXPECT_EQ(right.mirror, -1);
  EXPECT_NEAR(right.turning, 1, 1e-15);
}

// Where the series is about, curvature and its logarithmic rate are the piece's; the radius is how
// far it is to the end of the curve, where curvature or radius is 0.
TEST(TaylorSeries, KnowsWhereItIsAndHowFarItGoes) {
  const UnitPiece unit = unit_piece({2, 1, 0.5, 2});
  // Radius squared is linear: 4 at the start, 1/4 at the end; 0 at 16/15.
  const TaylorSeries s = taylor_series(unit, SeriesVariable::arc_length, 0.25, 12);
  const double square = 0.75 * 4 + 0.25 * 0.25;
  EXPECT_NEAR(s.value, 1 / std::sqrt(square), 1e-14);
  EXPECT_NEAR(s.log_rate, 0.5 * 3.75 / square, 1e-13);
  EXPECT_NEAR(s.radius, 16 / 15.0 - 0.25, 1e-12);
  EXPECT_EQ(s.decay, 2);
  EXPECT_TRUE(s.analytic);
  // In tangent angle the radius to the power 1 is: radius falls linearly to 0.
  const TaylorSeries a = taylor_series(unit, SeriesVariable::tangent_angle, 0.25, 12);
  EXPECT_EQ(a.decay, -1);
  EXPECT_EQ(a.radius, kInfinity);  // a polynomial has no end
  EXPECT_NEAR(a.value, unit.turning * (0.75 * 2 + 0.25 * 0.5), 1e-13);
  EXPECT_NEAR(a.log_rate, -1.5 / (0.75 * 2 + 0.25 * 0.5), 1e-13);
}

TEST(TaylorSeries, SaysWhereThereIsNone) {
  const UnitPiece inflected = unit_piece({-2, 1, 0, 3});
  EXPECT_FALSE(taylor_series(inflected, SeriesVariable::arc_length, 0, 9).analytic);
  EXPECT_TRUE(taylor_series(inflected, SeriesVariable::arc_length, 0.1, 9).analytic);
  const UnitPiece clothoid = unit_piece({-1, 1, 0, 3});
  EXPECT_TRUE(taylor_series(clothoid, SeriesVariable::arc_length, 0, 9).analytic);
  EXPECT_FALSE(taylor_series(clothoid, SeriesVariable::tangent_angle, 0, 9).analytic);
  EXPECT_EQ(remainder_bound(taylor_series(inflected, SeriesVariable::arc_length, 0, 9), 0.1),
            kInfinity);
}

// The bound holds, to four digits of what is left out, which a majorant takes for all of one sign;
// beyond the radius there is none.
TEST(RemainderBound, HoldsAndIsNotFarAbove) {
  for (const double alpha : {-2.5, -1.0, -0.4, 0.0, 0.5, 1.0, 3.0})
    for (const SeriesVariable variable :
         {SeriesVariable::arc_length, SeriesVariable::tangent_angle})
      for (const int degree : {4, 9, 16}) {
        const UnitPiece unit = unit_piece({alpha, 1, 0.8, 1.6});
        const TaylorSeries s = taylor_series(unit, variable, 0.5, degree);
        const bool arc = variable == SeriesVariable::arc_length;
        const double reach = 0.3;
        const core::Vector2 middle = displacement(unit.piece, s.arc);
        const double direction = turning(unit.piece, s.arc);
        double most = 0;
        for (int i = -10; i <= 10; ++i) {
          const double x = reach * i / 10;
          const double t = arc ? 0.5 + x : fraction_at_turning(unit.piece, 0.5 + x);
          const core::Vector2 v = sum(s, x);
          const double c = std::cos(direction), q = std::sin(direction);
          const core::Vector2 there = middle + core::Vector2{c * v.x - q * v.y, q * v.x + c * v.y};
          most = std::max(most, core::norm(there - displacement(unit.piece, t)));
        }
        const double bound = remainder_bound(s, reach);
        EXPECT_GE(bound * (1 + 1e-9) + 3e-16, most) << alpha << ' ' << degree;
        EXPECT_LE(bound, 2e4 * most + 1e-15) << alpha << ' ' << degree;
        EXPECT_EQ(remainder_bound(s, 0), 0);
        if (std::isfinite(s.radius)) {
          EXPECT_EQ(remainder_bound(s, s.radius), kInfinity);
        }
      }
}

// On a log spiral of curvature k / (1 - l x) the velocity on the circle of radius r is at most
// (1 - l r)^(-k / l). Cauchy's estimate with it, at the best of many circles, is nearly told.
TEST(RemainderBound, IsNearlyThatOfTheBestCircle) {
  for (const double end : {0.9, 1.3, 4.0, 20.0})
    for (const int degree : {2, 6, 12, 30})
      for (const double reach : {0.001, 0.02, 0.1, 0.3}) {
        const double l = 1 - 1 / end;  // from curvature 1 at the start, where it is expanded
        const UnitPiece unit = unit_piece({1, 1, 1, end});
        const TaylorSeries s = taylor_series(unit, SeriesVariable::arc_length, 0, degree);
        double least = kInfinity;
        for (int i = 1; i < 2000; ++i) {
          const double r = reach * std::pow(1 / (std::abs(l) * reach), i / 2000.0);
          const double velocity = std::pow(1 - std::abs(l) * r, -1 / std::abs(l));
          least = std::min(least, velocity * r * std::pow(reach / r, degree + 1) /
                                      ((degree + 1) * (1 - reach / r)));
        }
        const double bound = remainder_bound(s, reach);
        EXPECT_GE(bound, 0.999 * least) << end << ' ' << degree << ' ' << reach;
        EXPECT_LE(bound, 1.5 * least) << end << ' ' << degree << ' ' << reach;
      }
}

// ---- Feet ------------------------------------------------------------------------------------

/// A quarter of the circle of radius 1 as a rational quadratic Bézier from (0, 0) along x.
curve::Bezier2 quarter() { return {{{0, 0}, {1, 0}, {1, 1}}, {1, std::numbers::sqrt2 / 2, 1}}; }

TEST(Reduced, IsInTheFrameOfTheUnitPiece) {
  const Segment s{{{1, 2}, std::numbers::pi / 2}, -1, 2, -1, -1};  // turning right: mirrored
  const UnitPiece unit = unit_piece(piece_of(s));
  const Homogeneous h = reduced({{{1, 2}, {1, 4}, {3, 6}}, {1, 3, 2}}, s, unit);
  ASSERT_EQ(h.degree(), 2);
  EXPECT_NEAR(h.least_weight, 1 / 3.0, 1e-15);
  EXPECT_NEAR(h.control[1].weight, 1, 1e-15);
  EXPECT_NEAR(h.control[1].point.x, 1, 1e-15);  // two ahead, halved
  EXPECT_NEAR(h.control[1].point.y, 0, 1e-15);
  EXPECT_NEAR(h.control[2].weight, 2 / 3.0, 1e-15);
  EXPECT_NEAR(h.control[2].point.x, 2 / 3.0 * 2, 1e-15);
  EXPECT_NEAR(h.control[2].point.y, 2 / 3.0 * 1, 1e-15);  // to the right, mirrored
}

// On an arc that the Bézier is itself, feet are its own places: at half the angle half way.
TEST(ParameterMap, FindsTheFeetOfAnArc) {
  const Segment arc{{{0, 0}, 0}, -1, std::numbers::pi / 2, 1, 1};
  const UnitPiece unit = unit_piece(piece_of(arc));
  const Homogeneous h = reduced(quarter(), arc, unit);
  const ParameterMap map(h, unit);
  EXPECT_EQ(map(0, 0.3), 0);
  EXPECT_EQ(map(1, 0.3), 1);
  EXPECT_NEAR(map(0.5, 0.45), 0.5, 1e-14);
  for (const double v : {0.1, 0.3, 0.8}) {
    const double t = map(v, v);
    const core::Point2 p = evaluate(quarter(), t);
    EXPECT_NEAR(p.x, std::sin(v * std::numbers::pi / 2), 1e-13);
    EXPECT_NEAR(p.y, 1 - std::cos(v * std::numbers::pi / 2), 1e-13);
    EXPECT_NEAR(map(v, 0.9), t, 1e-13) << v;  // from far off the same
    EXPECT_NEAR(map(v, 0.05), t, 1e-13) << v;
  }
}

// A Bézier that runs on beyond the arc's ends is moved linearly, so that ends meet ends.
TEST(ParameterMap, EndsMeetEnds) {
  const Segment line{{{0, 0}, 0}, -1, 1, 0, 0};
  const UnitPiece unit = unit_piece(piece_of(line));
  const curve::Bezier2 longer{{{-0.1, 0.01}, {1.1, 0.01}}, {}};
  const Homogeneous h = reduced(longer, line, unit);
  const ParameterMap map(h, unit);
  for (const double v : {0.0, 0.25, 0.7, 1.0}) EXPECT_NEAR(map(v, v), v, 1e-13);
  // Backwards there are no feet at all: the guess stands.
  const curve::Bezier2 back{{{1, 0}, {0, 0}}, {}};
  const Homogeneous hb = reduced(back, line, unit);
  EXPECT_EQ(ParameterMap(hb, unit)(0.4, 0.33), 0.33);
}

}  // namespace
}  // namespace keyline::lac::detail
