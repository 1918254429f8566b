#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/numeric/random.h"

#include "truth.h"

/// A part of the key-line is faired; the rest stays the points' spline.
namespace keyline::fairing {
namespace {

const lac::Chain kHood{{{0, 0}, 0.1}, {{0.5, 90, 0.003, 0.02}, {-0.5, 20, 0.02, 0.006}}, false};

acquire::KeyLine hood() { return testing::line_through(testing::measure(kHood, 160, 2e-4, 3)); }

TEST(Region, KeepsTheRest) {
  FairOptions options;
  options.region = core::Interval{0.25, 0.7};
  const FairResult result = fair(hood(), options).value();
  ASSERT_EQ(result.curves.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<curve::BSpline2>(result.curves[0]));
  EXPECT_TRUE(std::holds_alternative<lac::Chain>(result.curves[1]));
  for (const auto& joint : result.joints) EXPECT_LE(joint.gap, 1e-9 * result.length);
}

TEST(Region, OfAClosedOutlineKeepsTheRest) {
  std::vector<core::Point2> ellipse;
  for (int i = 0; i < 240; ++i) {
    const double t = 2 * core::kPi * i / 240;
    ellipse.push_back({3 * std::cos(t), std::sin(t)});
  }
  const acquire::KeyLine line = testing::line_through(ellipse);
  ASSERT_TRUE(line.closed);
  FairOptions options;
  for (const core::Interval region : {core::Interval{0.1, 0.4}, {0, 0.3}, {0.6, 1}}) {
    options.region = region;
    const FairResult result = fair(line, options).value();
    EXPECT_TRUE(result.within_tolerance);
    ASSERT_GE(result.curves.size(), 2U);
    for (const auto& joint : result.joints) {
      EXPECT_LE(joint.gap, 1e-9 * result.length) << region.low;
      EXPECT_LE(std::abs(joint.angle), 1e-6) << region.low;
    }
  }
}

/// Points along a curve whose curvature is a + b s + c s^2, of length 1.
acquire::KeyLine bent(double a, double b, double c) {
  constexpr int kPoints = 20, kSteps = 200;
  std::vector<core::Point2> points{{0, 0}};
  const auto direction = [&](double s) { return a * s + b * s * s / 2 + c * s * s * s / 3; };
  for (int i = 1; i < kPoints; ++i) {
    core::Point2 at = points.back();
    for (int k = 0; k < kSteps; ++k) {
      const double s = (i - 1 + (k + 0.5) / kSteps) / (kPoints - 1);
      at = at + 1.0 / kSteps / (kPoints - 1) * core::unit_vector(direction(s));
    }
    points.push_back(at);
  }
  return testing::line_through(points);
}

/// Where two or three pieces would do, more of them meet what stays at both ends with equal
/// curvature: the answer is the calmest still, and as near as the spline that stays.
TEST(Region, OfFewPiecesMeetsTheRest) {
  FairOptions options;
  options.region = core::Interval{0.3, 0.7};
  for (const auto& [a, b, c] :
       std::vector<std::array<double, 3>>{{1, 1, 0.5}, {2, 1, 1}, {-1, 2, -0.5}, {1, 2, 3}}) {
    const FairResult result = fair(bent(a, b, c), options).value();
    EXPECT_FALSE(result.calm_missed) << a << b << c;
    EXPECT_TRUE(result.within_tolerance) << a << b << c;
    ASSERT_GE(result.joints.size(), 2U) << a << b << c;
    for (const auto& joint : result.joints) {
      EXPECT_LE(joint.gap, 1e-9) << a << b << c;
      EXPECT_GE(joint.order, 2) << a << b << c;
    }
  }
}

/// An arc at an end of the part would have a curvature of its own.
TEST(Region, OfNoisyOutlinesHasTheCurvatureOfTheRest) {
  FairOptions options;
  options.region = core::Interval{0.3, 0.7};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    numeric::Random random(seed);
    const double two = random.uniform(0, 0.25), turned = random.uniform(0, 6);
    std::vector<core::Point2> points;
    for (int i = 0; i < 40; ++i) {
      const double t = 2 * core::kPi * i / 40;
      const double r = 1 + two * std::cos(2 * t + turned) + 0.003 * random.normal();
      points.push_back({1.4 * r * std::cos(t), r * std::sin(t)});
    }
    points.push_back(points.front());
    const FairResult result = fair(testing::line_through(points), options).value();
    ASSERT_GE(result.joints.size(), 2U) << seed;
    for (const auto& joint : result.joints)
      EXPECT_LE(joint.relative_curvature_jump.value(), 1e-9) << seed;
  }
}

/// Two straights and the corner between them, exactly; the region is a part of the second.
TEST(Region, CornersBesideItStay) {
  std::vector<core::Point2> points;
  for (int i = 0; i < 50; ++i) points.push_back({0.04 * i, 0});
  for (int i = 0; i <= 60; ++i) {
    const double t = i / 60.0;
    points.push_back({2 + 0.2 * t * t, 2 * t});
  }
  FairOptions options;
  options.region = core::Interval{0.7, 0.95};
  const FairResult result = fair(testing::line_through(points), options).value();
  ASSERT_EQ(result.curves.size(), 4U);  // first side, and before, in and behind the region
  const auto& side = std::get<curve::BSpline2>(result.curves[0]);
  for (int k = 0; k <= 1000; ++k)
    EXPECT_LE(std::abs(evaluate(side, k / 1000.0).y), result.tolerance) << k;
  EXPECT_EQ(evaluate(side, 1), (core::Point2{2, 0}));
  for (const auto& joint : result.joints) EXPECT_LE(joint.gap, 1e-9);
}

/// Of a region with a corner both sides are faired up to its point.
TEST(Region, MayHoldACorner) {
  std::vector<core::Point2> points;
  for (int i = 0; i < 60; ++i) points.push_back({0.04 * i, 0.1 * std::sin(0.04 * i)});
  const core::Point2 corner{2.4, 0.1 * std::sin(2.4)};
  for (int i = 0; i <= 60; ++i)
    points.push_back({corner.x + 0.3 * i / 60, corner.y + 2.0 * i / 60});
  FairOptions options;
  options.region = core::Interval{0.2, 0.8};
  const FairResult result = fair(testing::line_through(points), options).value();
  ASSERT_EQ(result.curves.size(), 4U);
  EXPECT_LE(core::distance(evaluate(std::get<lac::Chain>(result.curves[1]), 1), corner), 1e-9);
  EXPECT_LE(core::distance(evaluate(std::get<lac::Chain>(result.curves[2]), 0), corner), 1e-9);
  for (const auto& joint : result.joints) EXPECT_LE(joint.gap, 1e-9);
}

/// The largest and mean deviation are the region's; that of what stays is told by itself.
TEST(Region, WhatStaysIsMeasuredByItself) {
  FairOptions options;
  options.region = core::Interval{0.25, 0.7};
  const FairResult result = fair(hood(), options).value();
  double square = 0;
  int within = 0, beside = 0;
  for (std::size_t i = 0; i < result.offsets.size(); ++i) {
    const double share =
        (static_cast<double>(i) + 0.5) / static_cast<double>(result.offsets.size());
    if (share > 0.27 && share < 0.68) {
      square += result.offsets[i] * result.offsets[i];
      ++within;
    } else if (share < 0.23 || share > 0.72) {
      beside += std::isnan(result.offsets[i]);
    }
  }
  EXPECT_NEAR(result.rms_deviation, std::sqrt(square / within), 0.1 * result.rms_deviation);
  EXPECT_GT(beside, 70);
  EXPECT_TRUE(std::ranges::any_of(result.notes, [](const std::string& note) {
    return note.starts_with("outside the region the points' spline stays");
  }));
  EXPECT_GT(result.pieces.front().start, 0.2 * result.length);
}

/// A half-breadth section with a chine: the side up to the chine is the region, and the keel's end,
/// which a bound holds, is none of it.
TEST(Region, ThatEndsAtACornerIsNotTiedToTheLinesEnd) {
  std::vector<core::Point2> points;
  for (int i = 0; i < 40; ++i) points.push_back({5 - 0.0125 * i, 4 - 0.075 * i});
  for (int i = 0; i <= 60; ++i) points.push_back({4.5 * (60 - i) / 60, 1.0 * (60 - i) / 60});
  FairOptions options;
  options.region = core::Interval{0, 0.4};
  options.keep_inside = {{.axis = Axis::x, .at_least = 0, .at_most = {}}};
  const FairResult result = fair(testing::line_through(points), options).value();
  ASSERT_EQ(result.curves.size(), 2U);
  for (const auto& joint : result.joints) EXPECT_LE(joint.gap, 1e-9);
  EXPECT_LE(core::distance(evaluate(std::get<lac::Chain>(result.curves[0]), 1), {4.5, 1}), 1e-9);
}

/// The spline that stays outside the region passes too.
TEST(Region, PassesWhatItMustAndSoDoesTheRest) {
  FairOptions options;
  options.must_pass = {20, 70, 90};
  options.region = core::Interval{0.25, 0.7};
  const acquire::KeyLine line = hood();
  const FairResult result = fair(line, options).value();
  EXPECT_LE(std::abs(result.offsets[70]), 0.05 * result.tolerance);
  EXPECT_LE(std::abs(result.offsets[90]), 0.05 * result.tolerance);
  const auto& kept = std::get<curve::BSpline2>(result.curves.at(0));
  double nearest = HUGE_VAL;
  for (int k = 0; k <= 20000; ++k)
    nearest = std::min(nearest, core::distance(evaluate(kept, k / 20000.0), line.points[20]));
  EXPECT_LE(nearest, 0.05 * result.tolerance);
}

}  // namespace
}  // namespace keyline::fairing
