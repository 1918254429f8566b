#include "keyline/sketch/explained.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/sketch/trace.h"

namespace keyline::sketch {
namespace {

using core::Point2;

// One quintic may go nearly once round: its ends say nothing of its length.
TEST(Explained, InkAllAlongAPieceWhoseEndsAreNear) {
  const curve::Bezier2 round{{{98, 60}, {10, 40}, {-10, 260}, {210, 260}, {190, 40}, {102, 60}},
                             {}};
  Stroke stroke;
  stroke.curve = {round};
  stroke.width = 2;
  Binary ink(200, 220);
  for (int i = 0; i <= 4000; ++i) {
    const Point2 p = evaluate(round, i / 4000.0);
    ink.at(static_cast<int>(p.x), static_cast<int>(p.y)) = 1;
    stroke.points.push_back(p);
    stroke.widths.push_back(2);
  }
  EXPECT_EQ(explained_ink(ink, std::vector<Stroke>{stroke}), 1);
}

// Two eyes over a mouth are no lines, and no lines of the answer: that is told.
TEST(Explained, PlacesWithoutALineAreTold) {
  Image image;
  image.luminance = Raster<std::uint16_t>(200, 120);
  std::ranges::fill(image.luminance.data, 65535);
  const auto disc = [&](double cx, double cy, double r) {
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 200; ++x)
        if (std::hypot(x + 0.5 - cx, y + 0.5 - cy) < r) image.luminance.at(x, y) = 0;
  };
  for (int i = 0; i <= 400; ++i) disc(40 + 0.3 * i, 90 - 10 * std::pow((i - 200) / 200.0, 2), 2);
  disc(70, 40, 5);
  disc(130, 40, 5);
  const auto result = trace(image, {});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->strokes.size(), 1U);
  EXPECT_TRUE(std::ranges::any_of(result->notes, [](const std::string& note) {
    return note.find("2 places as large as a dot of the pen have no line") != std::string::npos;
  }));
}

}  // namespace
}  // namespace keyline::sketch
