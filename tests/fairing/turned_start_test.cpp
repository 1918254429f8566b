#include "keyline/fairing/turned_start.h"

#include <cmath>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/length.h"

#include "truth.h"

namespace keyline::fairing {
namespace {

// Half a region lies before the start of the outline, half behind it; what is told of points is
// told of those that were given.
TEST(TurnedStart, ARegionRunsOverTheStartOfAClosedOutline) {
  std::vector<core::Point2> ellipse;
  for (int i = 0; i < 120; ++i) {
    const double t = 2 * core::kPi * i / 120;
    ellipse.push_back({3 * std::cos(t), std::sin(t)});
  }
  constexpr std::size_t kOff = 2;
  ellipse[kOff] = ellipse[kOff] + core::Vector2{0.03, 0};
  const acquire::KeyLine line = testing::line_through(ellipse);
  FairOptions options;
  options.tolerance = 0.05;
  for (const core::Interval region : {core::Interval{-0.1, 0.1}, {0.9, 1.1}}) {
    options.region = region;
    const FairResult result = fair(line, options).value();
    EXPECT_TRUE(result.within_tolerance);
    ASSERT_EQ(result.curves.size(), 3U);
    const auto& faired = std::get<lac::Chain>(result.curves[1]);
    const double share = arc_length(faired) / result.length;
    EXPECT_NEAR(share, 0.2, 0.02);
    EXPECT_LT(distance(evaluate(faired, 0.5), core::Point2{3, 0}), 0.5);
    for (const auto& joint : result.joints) {
      EXPECT_LE(joint.gap, 1e-9 * result.length);
      EXPECT_LE(std::abs(joint.angle), 1e-6);
    }
    EXPECT_EQ(result.worst_point, kOff);
    EXPECT_GT(std::abs(result.offsets[kOff]), 0.01);
  }
}

}  // namespace
}  // namespace keyline::fairing
