#include "keyline/lac/chain/offset.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/concept.h"

namespace keyline::lac {
namespace {

using core::Pose2;

static_assert(curve::PlanarCurve<OffsetCurve>);

TEST(Offset, OfAnArcIsAnArc) {
  const OffsetCurve c = offset(Segment{{}, 0, 2, 0.5, 0.5}, 0.5);
  for (const double t : {0.0, 0.3, 1.0}) {
    EXPECT_NEAR(curve::curvature(c, t), 1 / 1.5, 1e-14);
    EXPECT_NEAR(curve::curvature_rate(c, t), 0, 1e-14);
  }
}

TEST(Offset, KeepsItsDistanceAndItsJetIsItsDerivative) {
  for (const double alpha : {-2.0, -1.0, 0.0, 0.5, 2.0}) {
    const Segment s{{{1, 2}, 0.3}, alpha, 3, 0.2, 0.7};
    const OffsetCurve c = offset(s, -0.4);
    for (const double t : {0.2, 0.5, 0.8}) {
      EXPECT_NEAR(distance(evaluate(c, t), evaluate(s, t)), 0.4, 1e-14);
      const double h = 1e-4;
      const auto a = jet(c, t - h);
      const auto b = jet(c, t + h);
      const auto j = jet(c, t);
      EXPECT_LT(norm((b.point - a.point) / (2 * h) - j.first), 1e-6);
      EXPECT_LT(norm((b.first - a.first) / (2 * h) - j.second), 1e-6);
      EXPECT_LT(norm((b.second - a.second) / (2 * h) - j.third), 1e-5) << alpha;
    }
  }
}

TEST(Offset, NamesItsCusps) {
  const OffsetCurve c = offset(Segment{{}, -1, 1, 0.5, 2.5}, 1);
  const auto cusps = offset_cusps(c);
  ASSERT_EQ(cusps.size(), 1u);
  EXPECT_NEAR(cusps[0], 0.25, 1e-14);
  EXPECT_EQ(breakpoints(c).size(), 3u);
  EXPECT_TRUE(offset_cusps(offset(Segment{{}, -1, 1, 0.5, 2.5}, -1)).empty());
}

TEST(Intersections, OfAnArcAndALine) {
  const Segment circle{{{0, -1}, 0}, 1, 1.9 * core::kPi, 1, 1};
  const auto t = intersections(circle, {{-5, 0.5}, 0});
  ASSERT_EQ(t.size(), 2u);
  for (const double at : t) EXPECT_NEAR(evaluate(circle, at).y, 0.5, 1e-14);
  EXPECT_EQ(intersections(circle, {{-5, 1}, 0}).size(), 1u);
  EXPECT_TRUE(intersections(circle, {{-5, 1.001}, 0}).empty());
}

TEST(Intersections, FindsEveryOneOnASpiralAndAnS) {
  // A clothoid from curvature 0 to 30 over length 2 turns by 30 rad around its pole.
  const Segment clothoid{{}, -1, 2, 0, 30};
  const Pose2 line{evaluate(clothoid, 1), 0.3};
  const auto many = intersections(clothoid, line);
  EXPECT_GT(many.size(), 5u);
  int changes = 0;
  double before = to_local(line, evaluate(clothoid, 0)).y;
  for (int i = 1; i <= 20000; ++i) {
    const double y = to_local(line, evaluate(clothoid, i / 20000.0)).y;
    changes += y * before < 0 ? 1 : 0;
    if (y != 0) before = y;
  }
  EXPECT_NEAR(static_cast<double>(many.size()), changes, 1);
  const Segment s{{{0, 0}, 1}, -2, 3, -2, 2};
  const Pose2 chord{{0, 0}, core::direction_of(evaluate(s, 1) - evaluate(s, 0))};
  const auto three = intersections(s, chord);
  ASSERT_EQ(three.size(), 3u);
  EXPECT_NEAR(three[1], 0.5, 1e-12);
  EXPECT_EQ(intersections(chain_of(s), chord).size(), 3u);
}

/// Of any slope; every other one changes the sign of its curvature.
Segment any_segment(std::mt19937& random, bool inflects) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double alpha = inflects ? -0.3 - 2 * unit(random) : 4 * unit(random) - 2;
  const double end = (inflects ? -1 : 1) * (0.5 + 3 * unit(random));
  return {{{unit(random), unit(random)}, 7 * unit(random)}, alpha, 3, 0.2 + unit(random), end};
}

TEST(Intersections, OfRandomLinesAreThoseThatSamplesFind) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 60; ++n) {
    const Segment s = any_segment(random, n % 2 == 0);
    const Pose2 line{evaluate(s, unit(random)), 7 * unit(random)};
    std::vector<double> crossed;
    constexpr int kSamples = 4000;
    double before = to_local(line, evaluate(s, 0)).y;
    for (int i = 1; i <= kSamples; ++i) {
      const double here = to_local(line, evaluate(s, static_cast<double>(i) / kSamples)).y;
      if (before * here < 0) crossed.push_back((i - 0.5) / kSamples);
      before = here;
    }
    const auto found = intersections(s, line);
    ASSERT_EQ(found.size(), crossed.size()) << n;
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], crossed[i], 1e-3);
  }
}

// A tangent touches: no sample changes its side.
TEST(Intersections, FindWhereALineTouches) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 60; ++n) {
    const Segment s = any_segment(random, n % 2 == 0);
    const double t = unit(random);
    if (std::abs(curvature(s, t)) < 0.05) continue;
    for (const double turned : {0.0, core::kPi}) {
      const auto found = intersections(s, Pose2{evaluate(s, t), tangent_angle(s, t) + turned});
      EXPECT_TRUE(std::ranges::any_of(found, [t](double v) { return std::abs(v - t) < 1e-6; }))
          << n << " " << t;
    }
  }
}

TEST(Intersections, AStraightPieceOnTheLineCountsWithItsEnds) {
  const Segment straight{{{0, 0}, 0}, -1, 2, 0, 0};
  EXPECT_EQ(intersections(straight, {{5, 0}, 0}).size(), 2u);
  EXPECT_EQ(intersections(straight, {{1, 1}, core::kPi / 2}).size(), 1u);
}

}  // namespace
}  // namespace keyline::lac
