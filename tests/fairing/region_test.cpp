#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

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
