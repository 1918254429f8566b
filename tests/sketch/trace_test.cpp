#include "keyline/sketch/trace.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace keyline::sketch {
namespace {

using core::Point2;

/// White paper with black rings, drawn with soft edges.
Image rings(int size, const std::vector<double>& radii, double width) {
  Image image;
  image.luminance = Raster<std::uint16_t>(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double r = std::hypot(x + 0.5 - 0.5 * size, y + 0.5 - 0.5 * size);
      double cover = 0;
      for (const double radius : radii)
        cover = std::max(cover, std::clamp(0.5 + 0.5 * width - std::abs(r - radius), 0.0, 1.0));
      image.luminance.at(x, y) = static_cast<std::uint16_t>(65535 * (1 - 0.9 * cover));
    }
  return image;
}

TEST(Trace, FindsRingsAsClosedStrokes) {
  const auto result = trace(rings(400, {60, 120, 170}, 4));
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->strokes.size(), 3U);
  const double radii[] = {170, 120, 60};
  for (std::size_t i = 0; i < 3; ++i) {
    const Stroke& stroke = result->strokes[i];
    EXPECT_TRUE(stroke.closed);
    EXPECT_NEAR(stroke.width, 4, 0.2);
    for (const curve::Bezier2& piece : stroke.curve)
      for (const double t : {0.0, 0.3, 0.6})
        EXPECT_NEAR(core::distance(evaluate(piece, t), {200, 200}), radii[i], 0.5);
  }
}

TEST(Trace, SaysThatBlankPicturesHoldNoLine) {
  for (const std::uint16_t level : {0, 30000, 65535}) {
    for (const int size : {1, 2, 50}) {
      Image blank;
      blank.luminance = Raster<std::uint16_t>(size, size, level);
      const auto result = trace(blank);
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().code, core::ErrorCode::undrawable);
    }
  }
}

}  // namespace
}  // namespace keyline::sketch
