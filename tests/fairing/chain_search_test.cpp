#include "keyline/fairing/chain_search.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/fairing/chain_weights.h"
#include "keyline/lac/chain/chain.h"

/// What a search takes and where it starts.
namespace keyline::fairing {
namespace {

TEST(Accepts, NoisyIsASixthOfTheTolerance) {
  EXPECT_FALSE(noisy({.tolerance = 1, .noise = 0}));
  EXPECT_FALSE(noisy({.tolerance = 1, .noise = 0.16}));
  EXPECT_TRUE(noisy({.tolerance = 1, .noise = 0.17}));
}

TEST(Accepts, OffsetsAndGapsKeepTheTolerance) {
  const std::vector<FitPoint> points(4);
  const std::vector<double> none(4, 0);
  const auto taken = [&](double offset, double gap) {
    ChainFitReport fit;
    fit.max_offset = offset;
    fit.max_gap = gap;
    return accepts({.tolerance = 1, .noise = 0}, fit, points, none);
  };
  EXPECT_TRUE(taken(1, 0.05));
  EXPECT_FALSE(taken(1.01, 0));
  EXPECT_FALSE(taken(0, 0.051));
  EXPECT_FALSE(taken(std::nan(""), 0));
}

bool takes(const std::vector<double>& offsets, double noise, double count = 1) {
  std::vector<FitPoint> points(offsets.size());
  for (FitPoint& p : points) p.count = count;
  return accepts({.tolerance = 4 * noise, .noise = noise}, {}, points, offsets);
}

// Means of m offsets may be 0.3 noises and 3.5 standard errors, noise / sqrt(m), off; runs of 4, 8,
// 16, … up to half of all are asked.
TEST(Accepts, TrendsBeyondChanceAreRefused) {
  const auto run = [](std::size_t n, std::size_t from, std::size_t m, double height) {
    std::vector<double> offsets(n, 0);
    for (std::size_t i = 0; i < m; ++i) offsets[from + i] = height;
    return offsets;
  };
  for (const std::size_t m : {4, 8, 16}) {
    const double most = 0.3 + 3.5 / std::sqrt(double(m));
    for (const std::size_t from : {std::size_t{0}, std::size_t{7}, 64 - m}) {
      EXPECT_TRUE(takes(run(64, from, m, 0.99 * most), 1)) << m << ' ' << from;
      EXPECT_FALSE(takes(run(64, from, m, 1.01 * most), 1)) << m << ' ' << from;
      EXPECT_FALSE(takes(run(64, from, m, -1.01 * most), 1)) << m << ' ' << from;
    }
  }
  // Runs of more than half of the points are not asked.
  const double most = 0.3 + 3.5 / std::sqrt(8.0);
  EXPECT_TRUE(takes(run(15, 0, 8, 1.01 * most), 1));
  EXPECT_FALSE(takes(run(16, 0, 8, 1.01 * most), 1));
}

// Means of four points each: runs of sixteen are of four of them.
TEST(Accepts, TrendsAreCountedInMeasuredPoints) {
  std::vector<double> offsets(64, 0);
  const double most = 0.3 + 3.5 / std::sqrt(4.0);  // of a single mean of four
  offsets[20] = 0.99 * most;
  EXPECT_TRUE(takes(offsets, 1, 4));
  offsets[20] = 1.01 * most;
  EXPECT_FALSE(takes(offsets, 1, 4));
}

TEST(WeighUp, LeavesPointsToBePassedAlone) {
  std::vector<FitPoint> points(3);
  points[1].must_pass = true;
  const auto original = points;
  const numeric::Push push{0.3, 2};
  weigh_up(points, original, {2, 2, -2}, 1, push);
  EXPECT_EQ(points[0].weight, numeric::pushed_weight(1, 1, 2, push));
  EXPECT_GT(points[0].weight, 1);
  EXPECT_EQ(points[1].weight, 1);
  EXPECT_EQ(points[2].weight, points[0].weight);
  // Half the tolerance away: weights fall by 0.3 + 2 * 0.25.
  const double before = points[0].weight;
  weigh_up(points, original, {2, 2, 2}, 4, push);
  EXPECT_NEAR(points[0].weight, before * 0.8, 1e-12);
}

std::vector<FitPoint> circle(int n, double radius) {
  std::vector<FitPoint> points;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n;
    points.push_back({.position = {radius * std::cos(t), radius * std::sin(t)}});
  }
  return points;
}

// Poses and curvatures of a circle are known, and how far each foot is along.
TEST(DenseChain, FollowsACircle) {
  const double radius = 0.5 / std::numbers::pi;  // of length 1
  const auto points = circle(90, radius);
  const FitChain chain = dense_chain(points, true, 6);
  ASSERT_EQ(chain.pieces.size(), 6U);
  ASSERT_EQ(chain.joints.size(), 7U);
  EXPECT_TRUE(chain.closed);
  EXPECT_FALSE(chain.first_at_start);
  EXPECT_NEAR(chain.turning, 2 * std::numbers::pi, 1e-12);
  for (int i = 0; i <= 6; ++i) {
    const double t = 2 * std::numbers::pi * i / 6;
    const FitJoint& joint = chain.joints[i];
    EXPECT_NEAR(joint.position.x, radius * std::cos(t), 2e-4) << i;
    EXPECT_NEAR(joint.position.y, radius * std::sin(t), 2e-4) << i;
    EXPECT_NEAR(joint.direction, t + std::numbers::pi / 2, 0.02) << i;
    EXPECT_NEAR(joint.curvature, 1 / radius, 0.1 / radius) << i;
  }
  for (const FitPiece& piece : chain.pieces) {
    EXPECT_NEAR(piece.length, 1 / 6.0, 1e-3);
    EXPECT_EQ(piece.alpha, -1);
  }
  for (std::size_t j = 0; j < points.size(); ++j)
    EXPECT_NEAR(chain.feet[j].piece + chain.feet[j].fraction, double(j) / 15, 1e-9) << j;
}

TEST(DenseChain, OfAnOpenLineEndsAtItsEnds) {
  std::vector<FitPoint> points;
  for (int i = 0; i <= 12; ++i) points.push_back({.position = {i / 12.0, 0.25}});
  const FitChain chain = dense_chain(points, false, 4);
  EXPECT_TRUE(chain.first_at_start && chain.last_at_end);
  EXPECT_EQ(chain.turning, 0);
  EXPECT_EQ(chain.feet.back().piece, 3);
  EXPECT_EQ(chain.feet.back().fraction, 1);
  EXPECT_EQ(chain.feet[4].piece + chain.feet[4].fraction, 4 / 3.0);
  for (int i = 0; i <= 4; ++i) EXPECT_NEAR(chain.joints[i].position.x, i / 4.0, 1e-9);
}

// A spline through points has them for its joints; guides stand half way.
TEST(SplineChain, HasAJointAtEveryMeasuredPoint) {
  std::vector<FitPoint> points;
  for (int i = 0; i <= 8; ++i) {
    points.push_back({.position = {i / 8.0, 0.05 * std::sin(0.5 * i)}});
    if (i == 3) points.push_back({.position = {3.5 / 8, 0.05}, .count = 0});
  }
  const FitChain chain = spline_chain(points, false);
  ASSERT_EQ(chain.pieces.size(), 8U);
  ASSERT_EQ(chain.feet.size(), 10U);
  EXPECT_EQ(chain.feet[4].piece, 3);
  EXPECT_EQ(chain.feet[4].fraction, 0.5);
  EXPECT_EQ(chain.feet[5].piece, 4);
  EXPECT_EQ(chain.feet[5].fraction, 0);
  EXPECT_EQ(chain.feet.back().piece, 7);
  EXPECT_EQ(chain.feet.back().fraction, 1);
  EXPECT_EQ(chain.joints[4].position, points[5].position);
  EXPECT_EQ(chain.joints.back().position, points.back().position);
  EXPECT_TRUE(chain.first_at_start && chain.last_at_end);
  const FitChain round = spline_chain(circle(8, 1), true);
  ASSERT_EQ(round.pieces.size(), 8U);
  EXPECT_NEAR(round.turning, 2 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(round.joints[2].curvature, 1, 1e-6);
}

// As few as draw it: points of one clothoid are one piece, and a wanted number is met.
TEST(SearchChain, FindsOnePieceForAClothoidAndWhatIsWanted) {
  const lac::Chain truth{{{0, 0}, 0.2}, {{-1, 1, 0.5, 3}}, false};
  std::vector<FitPoint> points;
  for (const core::Point2 p : lac::sample(truth, 60)) points.push_back({.position = p});
  ChainSearchOptions options;
  options.accept.tolerance = 1e-4;
  options.threads = 1;
  const ChainSearchResult found = search_chain(points, false, options);
  EXPECT_TRUE(found.within_tolerance);
  EXPECT_FALSE(found.cancelled);
  EXPECT_EQ(found.chain.pieces.size(), 1U);
  EXPECT_LE(found.fit.max_offset, 1e-4);
  EXPECT_EQ(found.weights.size(), 60U);
  EXPECT_GT(found.trials, 0);
  options.wanted_pieces = 3;
  EXPECT_EQ(search_chain(points, false, options).chain.pieces.size(), 3U);
}

}  // namespace
}  // namespace keyline::fairing
