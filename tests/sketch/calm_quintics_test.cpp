#include "keyline/sketch/calm_quintics.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "keyline/fit/quintic_chain.h"

namespace keyline::sketch {
namespace {

using core::Point2;

constexpr double kLength = 600;

/// Places a pixel apart on a clothoid (curvature from 0.001 to 0.009 per pixel, so no wave), moved
/// across by a wobble.
std::vector<Point2> clothoid(double amplitude, double wavelength) {
  std::vector<Point2> points;
  Point2 p;
  const double step = 0.01;
  for (int i = 0; i <= kLength / step; ++i) {
    const double s = i * step;
    const double angle = 0.001 * s + 0.5 * 0.008 / kLength * s * s;
    if (i % 100 == 0) {
      const double off = amplitude * std::sin(2 * M_PI * s / wavelength);
      points.push_back(p + off * core::Vector2{-std::sin(angle), std::cos(angle)});
    }
    p = p + step * core::Vector2{std::cos(angle), std::sin(angle)};
  }
  return points;
}

double farthest(const std::vector<curve::Bezier2>& pieces, const std::vector<Point2>& from) {
  double worst = 0;
  for (const curve::Bezier2& piece : pieces)
    for (int k = 0; k <= 50; ++k) {
      double least = HUGE_VAL;
      for (const Point2 p : from)
        least = std::min(least, core::distance(p, evaluate(piece, k / 50.0)));
      worst = std::max(worst, least);
    }
  return worst;
}

TEST(CalmQuintics, TakesAWobbleOfOnePixelOut) {
  for (const double wavelength : {20.0, 45.0, 90.0}) {
    SCOPED_TRACE(wavelength);
    const std::vector<Point2> points = clothoid(1, wavelength);
    const auto given = fit::fit_quintic_chain(points, false, {0.5, 48});
    ASSERT_GE(waves_of(given.pieces), 10);
    const CalmQuintics calm = calm_quintics(points, false, 1.5, given.pieces);
    ASSERT_FALSE(calm.pieces.empty());
    EXPECT_LE(waves_of(calm.pieces), 1);
    EXPECT_LE(farthest(calm.pieces, clothoid(0, 1)), 1.2);  // points stand a pixel apart
    EXPECT_LE(core::distance(calm.pieces.front().control.front(), points.front()), 1e-3);
    EXPECT_LE(core::distance(calm.pieces.back().control.back(), points.back()), 1e-3);
  }
}

TEST(CalmQuintics, LeavesWhatIsCalm) {
  const std::vector<Point2> points = clothoid(0, 1);
  const auto given = fit::fit_quintic_chain(points, false, {0.01, 48});
  ASSERT_EQ(waves_of(given.pieces), 0);
  const CalmQuintics calm = calm_quintics(points, false, 1.5, given.pieces);
  if (!calm.pieces.empty()) {
    EXPECT_EQ(waves_of(calm.pieces), 0);
  }
}

TEST(CalmQuintics, KeepsTurnsThatArePartOfTheShape) {
  std::vector<Point2> points;  // an S of two arcs of radius 100: one wave of its own, not more
  for (int i = 0; i <= 600; ++i) {
    const double s = i - 300.0;
    points.push_back({s, 60 * std::sin(s / 100)});
  }
  const auto given = fit::fit_quintic_chain(points, false, {0.5, 48});
  const CalmQuintics calm = calm_quintics(points, false, 1.5, given.pieces);
  const auto& pieces = calm.pieces.empty() ? given.pieces : calm.pieces;
  EXPECT_LE(farthest(pieces, points), 2.1);
  EXPECT_GE(waves_of(pieces), 2);
}

}  // namespace
}  // namespace keyline::sketch
