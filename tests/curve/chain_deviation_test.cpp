#include "keyline/curve/chain_deviation.h"

#include <cmath>

#include <gtest/gtest.h>

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
}  // namespace keyline::curve
