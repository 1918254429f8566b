#include "keyline/sketch/refine_stroke.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/sketch/trace.h"

#include "page.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using core::Vector2;

// What was drawn goes straight on up to the rim, at every angle.
TEST(RefineStroke, LinesThatLeaveThePictureEndOnItsRim) {
  constexpr double kHigh = 80;
  for (const double degrees : {20, 40, 65, 90})
    for (const double width : {2.0, 4.0, 9.0}) {
      SCOPED_TRACE(::testing::Message() << degrees << " degrees, width " << width);
      const double angle = degrees * std::numbers::pi / 180;
      const Vector2 along{std::cos(angle), std::sin(angle)};
      const Point2 from{60, 30};  // y down
      Image page = testing::blank_page(300, static_cast<int>(kHigh));
      testing::draw_line(page, from, from + 260 * along, width);
      const auto result = trace(page);
      ASSERT_TRUE(result) << result.error().message;
      ASSERT_EQ(result->strokes.size(), 1U);
      double lowest = kHigh;
      for (const Point2 p : result->strokes[0].points) {
        lowest = std::min(lowest, p.y);
        EXPECT_NEAR(core::cross(along, Point2{p.x, kHigh - p.y} - from), 0, 0.2) << p.x;
      }
      EXPECT_NEAR(lowest, 0, 0.01);
    }
}

}  // namespace
}  // namespace keyline::sketch
