#include "keyline/fit/quintic_chain.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/core/error.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/closest_point.h"

namespace keyline::fit {
namespace {

using core::Point2;

/// Points of (300 cos t, 200 sin t) for t in [from, to].
std::vector<Point2> ellipse(int n, double from, double to) {
  std::vector<Point2> points;
  for (int i = 0; i < n; ++i) {
    const double t = std::lerp(from, to, i / (n - 1.0));
    points.push_back({300 * std::cos(t), 200 * std::sin(t)});
  }
  return points;
}

/// Distances of the points from the chain by the curves' own nearest places.
struct Measured {
  double most = 0, rms = 0;
};

Measured measured(const std::vector<Point2>& points, const QuinticChain& chain) {
  Measured m;
  for (const Point2 p : points) {
    double least = HUGE_VAL;
    for (const curve::Bezier2& piece : chain.pieces)
      least = std::min(least, curve::closest_point(piece, p).distance);
    m.most = std::max(m.most, least);
    m.rms += least * least / static_cast<double>(points.size());
  }
  m.rms = std::sqrt(m.rms);
  return m;
}

void expect_smooth(const QuinticChain& chain, bool closed) {
  const std::size_t n = chain.pieces.size();
  for (std::size_t k = 0; k + (closed ? 0 : 1) < n; ++k) {
    const auto before = jet(chain.pieces[k], 1.0), after = jet(chain.pieces[(k + 1) % n], 0.0);
    EXPECT_LT(core::distance(before.point, after.point), 1e-12);
    EXPECT_NEAR(
        core::wrap_angle(core::direction_of(before.first) - core::direction_of(after.first)), 0,
        1e-12);
    EXPECT_NEAR(curvature(before), curvature(after), 1e-12);
  }
}

TEST(QuinticChain, FollowsAnEllipseWithinTheTolerance) {
  std::size_t before = 0;
  for (const double tolerance : {3.0, 0.1, 0.003}) {
    SCOPED_TRACE(tolerance);
    for (const bool closed : {false, true}) {
      const auto points = closed ? ellipse(150, 0, 2 * M_PI * 149 / 150) : ellipse(120, 0.3, 4);
      const QuinticChain chain = fit_quintic_chain(points, closed, {.tolerance = tolerance});
      EXPECT_TRUE(chain.within_tolerance);
      expect_smooth(chain, closed);
      const Measured m = measured(points, chain);
      EXPECT_LE(m.most, tolerance);
      EXPECT_NEAR(chain.max_deviation, m.most, 0.01 * m.most + 2e-4);
      EXPECT_NEAR(chain.rms_deviation, m.rms, 0.01 * m.rms + 2e-4);
      if (!closed) {
        EXPECT_EQ(chain.pieces.front().control.front(), points.front());
        EXPECT_EQ(chain.pieces.back().control.back(), points.back());
        EXPECT_GE(chain.pieces.size(), before);
        before = chain.pieces.size();
      }
    }
  }
}

// Of smooth points every third says enough; what is left out is measured all the same, and a point
// left out that lies off is followed as by looking at all.
TEST(QuinticChain, PointsLeftOutAreKeptToAsWell) {
  for (const bool closed : {false, true}) {
    SCOPED_TRACE(closed);
    auto points = closed ? ellipse(900, 0, 2 * M_PI * 899 / 900) : ellipse(700, 0.3, 4);
    for (const bool calm : {false, true}) {
      const QuinticChain some =
          fit_quintic_chain(points, closed, {.tolerance = 0.5, .calm = calm, .every = 3});
      EXPECT_TRUE(some.within_tolerance);
      const Measured m = measured(points, some);
      EXPECT_LE(m.most, 0.5);
      EXPECT_NEAR(some.max_deviation, m.most, 0.01 * m.most);
      EXPECT_NEAR(some.rms_deviation, m.rms, 0.01 * m.rms);
    }
    points[301] = {1.005 * points[301].x,
                   1.005 * points[301].y};  // every third from 0 on is 300, 303, …
    const QuinticChain all = fit_quintic_chain(points, closed, {.tolerance = 0.5});
    const QuinticChain some = fit_quintic_chain(points, closed, {.tolerance = 0.5, .every = 3});
    EXPECT_EQ(some.within_tolerance, all.within_tolerance);
    EXPECT_EQ(some.max_deviation, all.max_deviation);
  }
}

// Points in turn inside and outside of a circle: every second one lies outside.
TEST(QuinticChain, PointsLeftOutSayWhereTheirNeighboursLie) {
  constexpr double kRadius = 100;
  for (const bool closed : {false, true}) {
    SCOPED_TRACE(closed);
    std::vector<Point2> points;
    for (int i = 0; i < 600; ++i) {
      const double r = kRadius + (i % 2 == 0 ? 0.3 : -0.3);
      const double a = (closed ? 2 * M_PI : 3) * i / 600;
      points.push_back({r * std::cos(a), r * std::sin(a)});
    }
    const QuinticChain chain =
        fit_quintic_chain(points, closed, {.tolerance = 1, .calm = true, .every = 2});
    ASSERT_TRUE(chain.within_tolerance);
    double sum = 0;
    for (const curve::Bezier2& piece : chain.pieces)
      for (int k = 0; k < 64; ++k) sum += norm(evaluate(piece, (k + 0.5) / 64) - Point2{});
    EXPECT_NEAR(sum / (64.0 * static_cast<double>(chain.pieces.size())), kRadius, 0.15);
  }
}

// Means of three neighbours on a circle, h apart, lie (1 + 2 cos h) / 3 of its radius from the
// middle, of five (1 + 2 cos h + 2 cos 2h) / 5: the chain through every second, or fourth, is as
// much smaller.
TEST(QuinticChain, PointsLeftOutCountAsMuchAsThoseKept) {
  constexpr double kRadius = 100;
  const int n = 120;
  const double h = 2 * M_PI / n;
  const double three = (1 + 2 * std::cos(h)) / 3;
  const double five = (1 + 2 * std::cos(h) + 2 * std::cos(2 * h)) / 5;
  for (const auto& [every, share] : {std::pair{1, 1.0}, {2, three}, {4, five}}) {
    SCOPED_TRACE(every);
    std::vector<Point2> points;
    for (int i = 0; i < n; ++i)
      points.push_back({kRadius * std::cos(i * h), kRadius * std::sin(i * h)});
    const QuinticChain chain = fit_quintic_chain(
        points, true, {.tolerance = 0.35, .every = static_cast<std::size_t>(every)});
    ASSERT_TRUE(chain.within_tolerance);
    double sum = 0;
    for (const curve::Bezier2& piece : chain.pieces)
      for (int k = 0; k < 64; ++k) sum += norm(evaluate(piece, (k + 0.5) / 64) - Point2{});
    EXPECT_NEAR(sum / (64.0 * static_cast<double>(chain.pieces.size())), share * kRadius,
                0.1 * (1 - three) * kRadius);
  }
}

// A quintic can come within a ten-thousandth of the length (fit_bezier's within 1e-6 of it).
TEST(QuinticChain, OnePieceIsNearWhatOneCanBe) {
  for (const double to : {1.5, 2.2, 3.0}) {
    SCOPED_TRACE(to);
    const auto points = ellipse(100, 0.2, to);
    const QuinticChain chain =
        fit_quintic_chain(points, false, {.tolerance = 1e-9, .max_pieces = 1});
    ASSERT_EQ(chain.pieces.size(), 1U);
    EXPECT_FALSE(chain.within_tolerance);
    EXPECT_LT(measured(points, chain).rms, 0.01);
  }
}

// The last point but one overshoots the last, the second falls short of the first: the nearest
// places to them are the ends.
TEST(QuinticChain, PointsBeyondTheEndsAreNearestToThem) {
  std::vector<Point2> points;
  for (int i = 0; i <= 60; ++i) points.push_back({10.0 * i, 0.002 * i * i * i});
  points[1] = points[0] - core::Vector2{3, 0};
  points[59] = points[60] + core::Vector2{0.5, 1.0};
  const QuinticChain chain = fit_quintic_chain(points, false, {.tolerance = 0.2, .max_pieces = 3});
  EXPECT_FALSE(chain.within_tolerance);
  const Measured m = measured(points, chain);
  EXPECT_NEAR(chain.max_deviation, m.most, 0.01 * m.most);
  EXPECT_NEAR(m.most, 3, 0.3);
}

/// L³ ∫ (dκ/ds)² ds.
double variation(const std::vector<curve::Bezier2>& pieces) {
  constexpr int kParts = 4000;
  double length = 0;
  double sum = 0;
  for (const curve::Bezier2& piece : pieces)
    for (int i = 0; i < kParts; ++i) {
      const auto from = jet(piece, i / double{kParts});
      const auto to = jet(piece, (i + 1) / double{kParts});
      const double step = core::distance(from.point, to.point);
      length += step;
      sum += std::pow(curvature(to) - curvature(from), 2) / step;
    }
  return length * length * length * sum;
}

// The points' own curve lies within any tolerance of them, so the calmest varies no more; one
// quintic that just follows them bends as four times that at its ends.
TEST(QuinticChain, TakesAPieceMoreWhereTooFewMakeANeedle) {
  constexpr int kLength = 360;
  const auto bend = [](double s) {
    const auto hump = [](double x) { return std::exp(-x * x / 1600); };
    return -(0.07 * hump(s) + 0.003 + 0.042 * hump(kLength - s) + 0.002 * std::sin(s / 30));
  };
  std::vector<Point2> points{{0, 0}};
  double direction = 1.2;
  double own = 0;
  for (int i = 0; i < kLength; ++i) {
    if (i > 0) own += std::pow(bend(i) - bend(i - 1), 2);
    direction += bend(i);
    points.push_back(points.back() + core::Vector2{std::cos(direction), std::sin(direction)});
  }
  own *= std::pow(kLength, 3);
  const QuinticChain chain = fit_quintic_chain(
      points, false, {.tolerance = 2.2, .calm = true, .free_start = true, .free_end = true});
  ASSERT_TRUE(chain.within_tolerance);
  EXPECT_LT(variation(chain.pieces), own);
  EXPECT_LE(chain.pieces.size(), 2U);
  expect_smooth(chain, false);
}

TEST(QuinticChain, RefusesWhatIsNone) {
  EXPECT_THROW(fit_quintic_chain({{0, 0}}, false), core::InvalidInput);
  EXPECT_THROW(fit_quintic_chain({{0, 0}, {0, 0}, {1, 1}}, false), core::InvalidInput);
}

}  // namespace
}  // namespace keyline::fit
