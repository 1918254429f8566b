#include "keyline/sketch/enlargement.h"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

#include "keyline/sketch/trace.h"

#include "kinds_generator.h"

namespace keyline::sketch {
namespace {

using core::Point2;

// Repeated pixels are no steps of the line: the same curves come out, as many times as large.
TEST(Enlargement, PicturesAreTracedAtTheirOwnSize) {
  const Image small = testing::make_kind("width 4", 3).image;
  Image large;
  constexpr int kTimes = 4;
  large.luminance = Raster<std::uint16_t>(kTimes * small.width(), kTimes * small.height());
  for (int y = 0; y < large.height(); ++y)
    for (int x = 0; x < large.width(); ++x)
      large.luminance.at(x, y) = small.luminance.at(x / kTimes, y / kTimes);
  EXPECT_EQ(own_size(small), (OwnSize{small.width(), small.height(), 0}));
  EXPECT_EQ(own_size(large).width, small.width());
  EXPECT_EQ(own_size(large).height, small.height());
  const auto own = trace(small);
  const auto result = trace(large);
  ASSERT_TRUE(own && result);
  ASSERT_EQ(result->strokes.size(), own->strokes.size());
  EXPECT_EQ(result->width, large.width());
  const Stroke& stroke = result->strokes[0];
  EXPECT_EQ(stroke.curve.size(), own->strokes[0].curve.size());
  EXPECT_NEAR(stroke.width, kTimes * own->strokes[0].width, 1e-9);
  EXPECT_EQ(stroke.curve[0].control[0].x, kTimes * own->strokes[0].curve[0].control[0].x);
}

// By two and a half, and through a lossy format since: still no steps of the line.
TEST(Enlargement, ByNoWholeNumberAndNoisySince) {
  const Image small = testing::make_kind("width 4", 3).image;
  constexpr double kTimes = 2.5;
  Image large;
  large.luminance = Raster<std::uint16_t>(static_cast<int>(kTimes * small.width()),
                                          static_cast<int>(kTimes * small.height()));
  std::uint32_t state = 1;
  for (int y = 0; y < large.height(); ++y)
    for (int x = 0; x < large.width(); ++x) {
      state = 1664525U * state + 1013904223U;
      const double level = small.luminance.at(static_cast<int>((x + 0.5) / kTimes),
                                              static_cast<int>((y + 0.5) / kTimes));
      const double noise = 300.0 * (static_cast<double>(state >> 16) / 32768 - 1);
      large.luminance.at(x, y) =
          static_cast<std::uint16_t>(std::clamp(level + noise, 0.0, 65535.0));
    }
  EXPECT_NEAR(own_size(large).width, small.width(), 1);
  const auto own = trace(small);
  const auto result = trace(large);
  ASSERT_TRUE(own && result);
  ASSERT_EQ(result->strokes.size(), own->strokes.size());
  for (std::size_t i = 0; i < own->strokes.size(); ++i) {
    EXPECT_LE(result->strokes[i].curve.size(), own->strokes[i].curve.size() + 1);
    const Point2 p = own->strokes[i].curve[0].control[0];
    const Point2 q = result->strokes[i].curve[0].control[0];
    EXPECT_LE(core::distance({kTimes * p.x, kTimes * p.y}, q), 1);
  }
}

}  // namespace
}  // namespace keyline::sketch
