#include "keyline/curve/chain_deviation.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/closest_point.h"

/// Distances that are known by hand.
namespace keyline::curve {
namespace {

using core::Point2;

PiecewiseBezier polygon(const std::vector<Point2>& points) {
  PiecewiseBezier chain;
  for (std::size_t i = 1; i < points.size(); ++i)
    chain.pieces.push_back({{points[i - 1], points[i]}, {}});
  return chain;
}

TEST(DeviationBound, OfParallelsIsTheirDistanceHoweverTheyAreCut) {
  const auto a = polygon({{0, 0}, {4, 0}});
  const auto b = polygon({{0, 0.25}, {0.5, 0.25}, {3, 0.25}, {4, 0.25}});
  EXPECT_NEAR(deviation_bound(a, b, 0.25), 0.25, 1e-14);
  EXPECT_NEAR(deviation_bound(b, a, 0.25), 0.25, 1e-14);
}

TEST(DeviationBound, OfARoofIsItsHeight) {
  const auto flat = polygon({{0, 0}, {2, 0}});
  const auto roof = polygon({{0, 0}, {1, 0.5}, {2, 0}});
  EXPECT_NEAR(deviation_bound(flat, roof, 1e-3), 0.5, 1e-14);
  EXPECT_NEAR(deviation_bound(roof, flat, 1e-3), 0.5, 1e-14);
}

TEST(DeviationBound, OfOneCurveInTwoFormsIsNone) {
  const Bezier2 whole{{{0, 0}, {1, 2}, {3, 2}, {4, -1}}, {}};
  const PiecewiseBezier cut{{subcurve(whole, 0, 0.2), elevate_degree(subcurve(whole, 0.2, 0.7), 2),
                             subcurve(whole, 0.7, 1)}};
  EXPECT_LE(deviation_bound({{whole}}, cut, 1e-9), 1e-9);
  EXPECT_LE(deviation_bound(cut, {{whole}}, 1e-9), 1e-9);
}

/// From (0, 0) to (1, 1): a parabola is off its chord by a quarter along y, over sqrt 2.
TEST(DeviationBound, OfAParabolaAndItsChord) {
  const PiecewiseBezier parabola{{{{{0, 0}, {0.5, 0}, {1, 1}}, {}}}};
  const double truth = 0.25 / std::sqrt(2.0);
  const double bound = deviation_bound(parabola, polygon({{0, 0}, {1, 1}}), 1.01 * truth);
  EXPECT_GE(bound, truth);
  EXPECT_LE(bound, 1.01 * truth);
}

/// A line run through unevenly is the same line.
TEST(DeviationBound, SpeedIsNoDistance) {
  const PiecewiseBezier uneven{{{{{0, 0.01}, {0.1, 0.01}, {1, 0.01}}, {}}}};
  const double bound = deviation_bound(polygon({{0, 0}, {1, 0}}), uneven, 0.0101);
  EXPECT_GE(bound, 0.01);
  EXPECT_LE(bound, 0.0101);
}

TEST(DeviationBound, WhatReachesBeyondCountsUnlessTrimmed) {
  const auto a = polygon({{0, 0}, {2, 0}});
  const auto b = polygon({{0.5, 0.1}, {3, 0.1}});
  EXPECT_NEAR(deviation_bound(a, b, 0.1), std::hypot(1, 0.1), 1e-14);
  EXPECT_NEAR(deviation_bound(a, b, 0.1, ChainEnds::trimmed), 0.1, 1e-14);
  EXPECT_NEAR(deviation_bound(b, a, 0.1, ChainEnds::trimmed), 0.1, 1e-14);
}

TEST(DeviationBound, AChainWithoutLengthIsAPoint) {
  const auto point = polygon({{1, 1}, {1, 1}});
  EXPECT_NEAR(deviation_bound(point, polygon({{1, 1}, {4, 5}}), 0.1), 5, 1e-14);
}

TEST(DeviationBound, EmptyAndRationalChainsAreRefused) {
  const auto line = polygon({{0, 0}, {1, 0}});
  const PiecewiseBezier rational{{{{{0, 0}, {1, 1}, {2, 0}}, {1, 2, 1}}}};
  EXPECT_THROW(deviation_bound({}, line, 1), core::InvalidInput);
  EXPECT_THROW(deviation_bound(line, {}, 1), core::InvalidInput);
  EXPECT_THROW(deviation_bound(line, rational, 1), core::InvalidInput);
}

}  // namespace
/// A row of straight or bent pieces with corners of any angle between them.
PiecewiseBezier cornered(std::mt19937& random, bool bent) {
  std::uniform_real_distribution<double> unit(-1, 1);
  PiecewiseBezier c;
  Point2 at{0, 0};
  double direction = 0;
  for (int i = 0; i < 4; ++i) {
    const core::Vector2 leg = (0.3 + 0.7 * std::abs(unit(random))) * core::unit_vector(direction);
    const core::Vector2 side = (bent ? 0.1 : 0.0) * core::perpendicular_left(leg);
    c.pieces.push_back({{at, at + (1 / 3.0) * leg + unit(random) * side,
                         at + (2 / 3.0) * leg + unit(random) * side, at + leg},
                        {}});
    at = at + leg;
    direction += 2.5 * unit(random);
  }
  return c;
}

/// The same with every corner moved, pieces following.
PiecewiseBezier moved_corners(PiecewiseBezier c, std::mt19937& random, double by) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto shift = [&] { return by * core::Vector2{unit(random), unit(random)}; };
  core::Vector2 from = shift();
  for (Bezier2& piece : c.pieces) {
    const core::Vector2 to = shift();
    for (std::size_t i = 0; i < 4; ++i)
      piece.control[i] = piece.control[i] + (1 - i / 3.0) * from + (i / 3.0) * to;
    from = to;
  }
  return c;
}

// Places beside a corner may be nearest to either leg of the other chain, in any order: one change
// of parameter for both directions told up to 25 times the distance.
TEST(DeviationBound, IsCloseNextToCorners) {
  std::mt19937 random(3);
  for (int n = 0; n < 300; ++n) {
    SCOPED_TRACE(n);
    const PiecewiseBezier a = cornered(random, n % 2 == 1);
    const PiecewiseBezier b = moved_corners(a, random, std::pow(10, -1 - n % 5));
    double sampled = 0;
    for (int i = 0; i <= 400; ++i) {
      const double t = i / 400.0;
      sampled = std::max(sampled, closest_point(a, evaluate(b, t)).distance);
      sampled = std::max(sampled, closest_point(b, evaluate(a, t)).distance);
    }
    const double bound = deviation_bound(a, b, 1.01 * sampled);
    EXPECT_GE(bound, sampled * (1 - 1e-9));
    EXPECT_LE(bound, 1.03 * sampled);
    EXPECT_NEAR(deviation_bound(b, a, 1.01 * sampled), bound, 0.03 * sampled);
  }
}

}  // namespace keyline::curve
