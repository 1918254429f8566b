#include "keyline/sketch/rectify.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "keyline/sketch/trace.h"

#include "drawing_generator.h"
#include "photo_generator.h"

namespace keyline::sketch {
namespace {

using core::Point2;

/// How far traced lines lie from the true ones, in pixels of the rectified sheet.
struct Deviation {
  double rms = 0;
  double uncovered = 0;  ///< share of the true lines with no traced one within a pen's width
};

double nearest(const std::vector<Point2>& points, Point2 p) {
  double least = HUGE_VAL;
  for (const Point2 q : points) least = std::min(least, core::distance(p, q));
  return least;
}

Deviation deviation_of(const testing::TruePhoto& truth, const TraceResult& result) {
  const double across = result.width / truth.width;
  const double down = result.height / truth.height;
  std::vector<Point2> traced;
  for (const Stroke& stroke : result.strokes)
    for (const curve::Bezier2& piece : stroke.curve)
      for (int k = 0; k < 100; ++k) traced.push_back(evaluate(piece, (k + 0.5) / 100));
  std::vector<Point2> real;
  for (const testing::TrueStroke& s : truth.strokes)
    for (const Point2 p : s.points) real.push_back({across * p.x, down * p.y});
  double square = 0;
  for (std::size_t i = 0; i < traced.size(); i += 4)
    square += std::pow(nearest(real, traced[i]), 2);
  double uncovered = 0;
  for (std::size_t i = 0; i < real.size(); i += 4)
    uncovered += nearest(traced, real[i]) > 4 * across ? 1 : 0;
  return {std::sqrt(4 * square / static_cast<double>(traced.size())),
          4 * uncovered / static_cast<double>(real.size())};
}

TEST(Rectify, LinesOfPhotosLieWhereTheyAreOnTheSheet) {
  const int count = std::getenv("KEYLINE_FULL") ? 40 : 4;
  for (int seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    const auto truth = testing::make_photo(static_cast<std::uint64_t>(seed), seed % 2 ? 0.9 : 0.5);
    const auto result = trace(truth.image);
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_TRUE(result->sheet);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LE(core::distance((*result->sheet)[i], truth.corners[i]), 0.5);
    EXPECT_NEAR(static_cast<double>(result->width) / result->height, truth.width / truth.height,
                0.02 * truth.width / truth.height);
    const Deviation off = deviation_of(truth, *result);
    std::printf("seed %2d: %d x %d, rms %.2f, %.1f %% not covered\n", seed, result->width,
                result->height, off.rms, 100 * off.uncovered);
    EXPECT_EQ(result->strokes.size(), truth.strokes.size());
    EXPECT_LE(off.rms, 0.3);
    EXPECT_LE(off.uncovered, 0.02);
  }
}

TEST(Rectify, GivenCornersAreTakenAndOffLeavesThePhoto) {
  const auto truth = testing::make_photo(6, 0.5);
  TraceOptions options;
  options.sheet = truth.corners;
  const auto given = trace(truth.image, options);
  ASSERT_TRUE(given) << given.error().message;
  EXPECT_EQ(*given->sheet, truth.corners);
  EXPECT_LE(deviation_of(truth, *given).rms, 0.3);
  TraceOptions as_it_is;
  as_it_is.rectify = Rectify::off;
  const auto off = trace(truth.image, as_it_is);
  ASSERT_TRUE(off) << off.error().message;
  EXPECT_FALSE(off->sheet);
  EXPECT_EQ(off->width, truth.image.width());
}

/// Light, with what the function says is dark.
template <class IsDark>
Image picture(const IsDark& is_dark) {
  Image image;
  image.luminance = Raster<std::uint16_t>(600, 450, 60000);
  for (int y = 0; y < 450; ++y)
    for (int x = 0; x < 600; ++x)
      if (is_dark(x, y)) image.luminance.at(x, y) = 12000;
  return image;
}

bool in_quadrilateral(double x, double y, double rim) {
  return x > 100 - rim && x < 500 + rim - 0.1 * y && y > 60 - rim && y < 400 + rim - 0.05 * x;
}

TEST(Rectify, WhatIsNoSheetOnDarkerGroundIsLeft) {
  EXPECT_TRUE(find_sheet(picture([](int x, int y) { return !in_quadrilateral(x, y, 0); })))
      << "the same shape where it is one";
  for (const int wide : {2, 6, 12, 25})
    EXPECT_FALSE(find_sheet(picture([&](int x, int y) {
      return in_quadrilateral(x, y, wide) && !in_quadrilateral(x, y, 0);
    }))) << "a frame drawn with a pen "
         << wide << " pixels wide";
  EXPECT_FALSE(find_sheet(picture([](int x, int y) { return in_quadrilateral(x, y, 0); })))
      << "dark on light";
  EXPECT_FALSE(find_sheet(picture([](int x, int y) {
    return x < 300 && y < 250 && !(x > 200 && x < 260 && y > 100 && y < 140);
  }))) << "a hole in something dark";
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    EXPECT_FALSE(find_sheet(testing::make_drawing(seed).image)) << "drawing " << seed;
  const auto photo = testing::make_photo(4, 0.5);
  Image inner;  // the sheet fills the picture
  inner.luminance = Raster<std::uint16_t>(400, 300);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 400; ++x)
      inner.luminance.at(x, y) = photo.image.luminance.at(x + 440, y + 330);
  EXPECT_FALSE(find_sheet(inner));
}

TEST(Rectify, SheetsFromStraightAboveKeepTheirRatio) {
  // opposite sides parallel: nothing tells the focal length, nor is it wanted
  EXPECT_NEAR(aspect_of({{{100, 80}, {700, 80}, {700, 480}, {100, 480}}}, 800, 600), 1.5, 1e-6);
  EXPECT_NEAR(aspect_of({{{300, 100}, {700, 300}, {500, 700}, {100, 500}}}, 800, 800), 1, 1e-6);
}

TEST(Rectify, CornersThatAreNoSheetsAreRefused) {
  const Image image = picture([](int, int) { return false; });
  for (const SheetCorners& bad : {
           SheetCorners{{{0, 0}, {100, 100}, {100, 0}, {0, 100}}},    // crossed
           SheetCorners{{{0, 0}, {0, 100}, {100, 100}, {100, 0}}},    // the other way round
           SheetCorners{{{0, 0}, {1, 0}, {100, 100}, {0, 100}}},      // a side of no length
           SheetCorners{{{0, 0}, {5000, 0}, {5000, 100}, {0, 100}}},  // far outside
           SheetCorners{{{0, 0}, {NAN, 0}, {100, 100}, {0, 100}}},
       }) {
    const auto seen = rectified(image, bad, 0);
    ASSERT_FALSE(seen);
    EXPECT_EQ(seen.error().code, core::ErrorCode::bad_input);
  }
}

}  // namespace
}  // namespace keyline::sketch
