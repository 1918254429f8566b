#include "keyline/fairing/one_piece.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/fairing/fair.h"
#include "keyline/lac/segment/segment.h"
#include "keyline/numeric/random.h"

#include "truth.h"

namespace keyline::fairing {
namespace {

std::vector<FitPoint> points_of(const lac::Segment& segment, int count) {
  std::vector<FitPoint> points;
  for (const core::Point2 p : lac::sample(segment, count)) points.push_back({.position = p});
  return points;
}

lac::Segment drawn(double alpha, double curvature, double ratio) {
  return {{{300, -20}, 2.1}, alpha, 40, curvature / 40, ratio * curvature / 40};
}

TEST(OnePiece, OfEverySlopeIsFoundFromItsPoints) {
  for (const int count : {8, 9, 15, 60})
    for (const double alpha : {-3.0, -1.0, -0.3, 0.5, 1.0, 2.0, 3.0})
      for (const double ratio : {0.3, 4.0}) {
        const lac::Segment truth = drawn(alpha, -0.8, ratio);
        const detail::OnePiece found = detail::fit_one_piece(points_of(truth, count));
        EXPECT_LT(found.off, 1e-8) << count << " " << alpha << " " << ratio;
        EXPECT_NEAR(found.segment().alpha, alpha, 1e-3) << count << " " << ratio;
        EXPECT_NEAR(found.segment().length, 40, 1e-5);
      }
}

TEST(OnePiece, WithAnInflectionInsideIsFound) {
  const lac::Segment truth = drawn(-1.4, 1.2, -0.7);
  const detail::OnePiece found = detail::fit_one_piece(points_of(truth, 12));
  EXPECT_LT(found.off, 1e-6);
  EXPECT_NEAR(found.segment().alpha, -1.4, 1e-3);
}

/// Of a parabola no piece comes as near as rounding; what is told is the largest distance.
TEST(OnePiece, TellsHowFarItIsFromOthers) {
  std::vector<FitPoint> points;
  for (int i = -6; i <= 6; ++i) points.push_back({.position = {0.2 * i, 0.04 * i * i}});
  const detail::OnePiece found = detail::fit_one_piece(points);
  double most = 0;
  for (const FitPoint& p : points) {
    double nearest = HUGE_VAL;
    for (const core::Point2 q : lac::sample(found.segment(), 20001))
      nearest = std::min(nearest, core::distance(p.position, q));
    most = std::max(most, nearest);
  }
  EXPECT_GT(found.off, 1e-5);
  EXPECT_NEAR(found.off, most, 1e-4 * found.off + 1e-8);
}

/// So few points that an estimate of their noise is one of their spacing.
TEST(FewExactPoints, OfOnePieceGiveItBack) {
  for (const double alpha : {-1.0, 1.0, 2.0}) {
    const lac::Segment truth = drawn(alpha, 0.6, 5);
    for (const int count : {6, 7, 8, 12, 24}) {
      acquire::KeyLine line;
      line.points = lac::sample(truth, count);
      line.length = 40;
      line.noise = 0.01;
      const FairResult result = fair(line).value();
      ASSERT_EQ(result.pieces.size(), 1U) << alpha << " " << count;
      EXPECT_NEAR(result.pieces[0].slopes[0], alpha, 1e-3);
      EXPECT_TRUE(result.fairness.fair);
    }
  }
}

/// One piece passes any five points that bend one way: these may be off by their noise.
TEST(FewExactPoints, OfFiveTellNothing) {
  acquire::KeyLine line;
  line.points = lac::sample(drawn(1, 0.6, 5), 5);
  line.length = 40;
  line.noise = 0.01;
  EXPECT_FALSE(fair(line).value().all_single);
}

/// Limits come before exactness.
TEST(FewExactPoints, KeepToLimits) {
  for (const int count : {12, 100}) {
    acquire::KeyLine line;
    line.points = lac::sample(drawn(1, 0.6, 5), count);
    line.length = 40;
    FairOptions options;
    options.slopes = {-2, 0};
    const FairResult result = fair(line, options).value();
    EXPECT_GT(result.pieces.size(), 1U) << count;
    for (const FairPiece& piece : result.pieces)
      for (const double slope : piece.slopes) EXPECT_LE(slope, 0) << count;
  }
}

/// Whoever noise has moved is no such piece.
TEST(FewExactPoints, WithNoiseAreFaired) {
  acquire::KeyLine line;
  line.points = lac::sample(drawn(1, 0.6, 5), 24);
  numeric::Random random(3);
  for (core::Point2& p : line.points) p.y += 4e-4 * (random.uniform() - 0.5);
  line.length = 40;
  const FairResult result = fair(line).value();
  EXPECT_FALSE(result.all_single);
}

}  // namespace
}  // namespace keyline::fairing
