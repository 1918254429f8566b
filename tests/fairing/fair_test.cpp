#include "keyline/fairing/fair.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/curve/concept.h"
#include "keyline/lac/chain/chain.h"

namespace keyline::fairing {
namespace {

acquire::KeyLine line_through(const std::vector<core::Point2>& points) {
  acquire::RawCurve raw;
  for (const core::Point2 p : points) raw.points.push_back({p.x, p.y, 0});
  return acquire::acquire_key_line(raw).value();
}

const lac::Chain kTruth{
    {{10, 5}, 0.3}, {{0.5, 40, 0.01, 0.03}, {-1, 30, 0.03, 0}, {-2, 50, 0, -0.025}}, false};

// Waves of few points, one of them far off: no chain is given that winds between them.
TEST(Fair, NoChainIsAReasonAndNoTangle) {
  int refused = 0;
  for (const double far : {1e3, 1e4, 1e5, 1e6, 1e7, 1e9}) {
    for (const std::size_t stray : {2U, 3U, 5U}) {
      std::vector<core::Point2> points;
      for (int i = 0; i < 7; ++i) points.push_back({4.0 / 3 * i, 0.3 * std::sin(4.0 / 3 * i)});
      points[stray] = {-0.8 * far, -0.6 * far};
      const auto result = fair(line_through(points));
      if (!result) {
        if (result.error().code == core::ErrorCode::bad_input) continue;  // no spline either
        ++refused;
        std::vector<double> steps;
        for (std::size_t i = 1; i < 7; ++i)
          steps.push_back(core::distance(points[i - 1], points[i]));
        std::ranges::sort(steps);  // of six the usual one is the fourth
        const std::string times = core::number_text(steps[5] / steps[3], 3) + " times the usual";
        const std::string& told = result.error().message;
        EXPECT_NE(told.find("the widest step"), std::string::npos);
        EXPECT_NE(told.find("is " + times + " one"), std::string::npos) << told;
        continue;
      }
      double turned = 0;
      for (const auto& curve : result->curves)
        for (const lac::Piece& piece : std::get<lac::Chain>(curve).pieces)
          turned += std::abs(lac::total_turning(piece));
      EXPECT_LE(turned, core::kPi * 8) << far << ' ' << stray;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(Fair, ExactChainComesBack) {
  const FairResult result = fair(line_through(lac::sample(kTruth, 400))).value();
  ASSERT_EQ(result.curves.size(), 1U);
  const auto& chain = std::get<lac::Chain>(result.curves[0]);
  EXPECT_LE(result.max_deviation, 1e-5);
  EXPECT_TRUE(result.within_tolerance);
  // The second and third piece meet in an inflection; one S-shaped piece may stand for both only
  // where it reproduces the points.
  ASSERT_EQ(chain.pieces.size(), 3U);
  EXPECT_NEAR(chain.pieces[0].alpha, 0.5, 1e-2);
  EXPECT_NEAR(chain.pieces[1].alpha, -1, 1e-2);
  EXPECT_NEAR(chain.pieces[2].alpha, -2, 1e-2);
  EXPECT_NEAR(chain.pieces[0].length, 40, 0.05);
  double start = 0;  // each piece starts where the last one ends
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    EXPECT_NEAR(result.pieces[i].start, start, 1e-9);
    start += chain.pieces[i].length;
  }
}

TEST(Fair, JointsAreG2AndPiecesMonotone) {
  const FairResult result = fair(line_through(lac::sample(kTruth, 300))).value();
  ASSERT_EQ(result.joints.size(), 2U);  // between the three pieces of the truth
  for (const auto& joint : result.joints) {
    EXPECT_GE(joint.order, 2);
    EXPECT_LE(joint.relative_curvature_jump, 1e-9);
  }
}

TEST(Fair, CircleIsOneArc) {
  std::vector<core::Point2> points;
  for (int i = 0; i < 90; ++i) points.push_back({50 * std::cos(0.02 * i), 50 * std::sin(0.02 * i)});
  const FairResult result = fair(line_through(points)).value();
  ASSERT_EQ(result.pieces.size(), 1U);
  EXPECT_EQ(result.pieces[0].rhythm, analysis::Rhythm::arc);
}

// The length is that of the curve, not of the way from point to point, which is shorter here.
TEST(Fair, LengthIsThatOfTheCurve) {
  std::vector<core::Point2> points;
  for (int i = 0; i < 5; ++i) points.push_back({std::cos(0.4 * i), std::sin(0.4 * i)});
  EXPECT_NEAR(fair(line_through(points)).value().length, 1.6, 1e-3);
}

TEST(Fair, StraightPointsAreOneLine) {
  std::vector<core::Point2> points;
  for (int i = 0; i < 30; ++i) points.push_back({1.0 * i, 0.5 * i});
  const FairResult result = fair(line_through(points)).value();
  ASSERT_EQ(result.pieces.size(), 1U);
  EXPECT_EQ(result.pieces[0].rhythm, analysis::Rhythm::straight);
  EXPECT_LE(result.max_deviation, 1e-9);
}

// The arc is the calmest curve through three points, however far it turns.
TEST(Fair, ThreePointsOfAnArcAreThatArc) {
  for (const double turning : {0.5, 2.0, 3.1, 4.5}) {
    std::vector<core::Point2> points;
    for (int i = 0; i < 3; ++i)
      points.push_back({10 * std::cos(turning * i / 2), 10 * std::sin(turning * i / 2)});
    const FairResult result = fair(line_through(points)).value();
    EXPECT_EQ(result.pieces.size(), 1U) << turning;
    EXPECT_EQ(result.fairness.answer.waves, 0) << turning;
    EXPECT_NEAR(result.length, 10 * turning, 1e-2) << turning;
  }
}

TEST(Fair, TwoAndThreePointsAreEnough) {
  EXPECT_TRUE(fair(line_through({{0, 0}, {1, 1}})));
  EXPECT_TRUE(fair(line_through({{0, 0}, {1, 1}, {2, 1.5}})));
}

TEST(Fair, OptionsOutOfRangeAreBadInput) {
  const auto line = line_through({{0, 0}, {1, 1}, {2, 1.5}, {3, 1.7}});
  FairOptions options;
  options.tolerance = -1;
  EXPECT_EQ(fair(line, options).error().path, "tolerance");
  options = {};
  options.spline.order = 9;
  EXPECT_EQ(fair(line, options).error().path, "order");
  options = {};
  options.region = core::Interval{0.5, 0.5};
  EXPECT_EQ(fair(line, options).error().path, "region");
  options = {};
  options.must_pass = {17};
  EXPECT_EQ(fair(line, options).error().path, "must_pass");
}

TEST(Fair, DefaultToleranceIsThreeSigmaOrMore) {
  EXPECT_DOUBLE_EQ(default_tolerance(0, 2, 100), 2e-4);
  EXPECT_GE(default_tolerance(1, 2, 10), 3);
  EXPECT_GT(default_tolerance(1, 2, 100000), 4.5);
  EXPECT_LT(default_tolerance(1, 2, 100000), 6);
}

}  // namespace
}  // namespace keyline::fairing
