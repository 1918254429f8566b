#include "keyline/sketch/margins.h"

#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "keyline/sketch/trace.h"

#include "page.h"

namespace keyline::sketch {
namespace {

using testing::blank_page;
using testing::draw_line;

constexpr std::uint16_t kPaper = 60000;

/// Two lines, one of them out of the picture below and one from side to side.
Image drawing() {
  Image page = blank_page(400, 300, kPaper);
  draw_line(page, {120, 60}, {180, 320}, 4);
  draw_line(page, {-20, 180}, {420, 120}, 4);
  return page;
}

/// Makes dark, with a soft border, what lies so far (in pixels) inside of an edge.
void darken(Image& page, const std::function<double(double, double)>& inside) {
  for (int y = 0; y < page.height(); ++y)
    for (int x = 0; x < page.width(); ++x) {
      const double share = 1 / (1 + std::exp(-2 * inside(x + 0.5, y + 0.5)));
      std::uint16_t& v = page.luminance.at(x, y);
      v = static_cast<std::uint16_t>((1 - share) * v + share * 4000);
    }
}

bool tells_margins(const TraceResult& result) {
  for (const std::string& note : result.notes)
    if (note.starts_with("dark margins")) return true;
  return false;
}

struct Case {
  const char* name;
  std::function<double(double, double)> inside;
  std::array<int, 4> deepest;  ///< left, top, right, bottom
};

const Case kMargins[] = {
    {"left", [](double x, double) { return 12 - x; }, {12, 0, 0, 0}},
    {"a wedge below", [](double x, double y) { return y - 300 + 10 - x / 25; }, {0, 0, 0, 8}},
    {"above and right",
     [](double x, double y) { return std::max(9 - y, x - 400 + 30); },
     {0, 9, 30, 0}},
};

TEST(Margins, LeaveTheDrawingAsItIsWithoutThem) {
  const auto plain = trace(drawing());
  ASSERT_TRUE(plain);
  EXPECT_FALSE(tells_margins(*plain));
  ASSERT_EQ(plain->strokes.size(), 2U);
  for (const Case& c : kMargins) {
    SCOPED_TRACE(c.name);
    Image page = drawing();
    darken(page, c.inside);
    const auto result = trace(page);
    ASSERT_TRUE(result);
    EXPECT_TRUE(tells_margins(*result));
    ASSERT_EQ(result->strokes.size(), 2U);
    for (const Stroke& stroke : result->strokes) {
      EXPECT_NEAR(stroke.width, 4, 0.3);
      for (const core::Point2 p : stroke.points) {
        const core::Point2 q{p.x, 300 - p.y};
        const double steep = std::abs((q.x - 120) * 260 - (q.y - 60) * 60) / std::hypot(260, 60);
        const double flat = std::abs((q.x + 20) * 60 + (q.y - 180) * 440) / std::hypot(440, 60);
        EXPECT_LT(std::min(steep, flat), 0.5) << p.x << " " << p.y;
      }
    }
  }
}

TEST(Margins, AreMeasured) {
  for (const Case& c : kMargins) {
    SCOPED_TRACE(c.name);
    Image page = drawing();
    darken(page, c.inside);
    const Margins found = clear_margins(page.luminance, kPaper);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found.deepest[k], c.deepest[k], 1);
    for (const int x : {0, 399})
      for (const int y : {0, 299}) EXPECT_GT(page.luminance.at(x, y), 0.95 * kPaper);
  }
}

// A close cut: a line along the rim that keeps clear of the corners is a line.
TEST(Margins, AreNoLinesAlongTheRim) {
  Image page = blank_page(400, 300, kPaper);
  draw_line(page, {20, 1}, {380, 1}, 4);
  draw_line(page, {397, 299}, {399, 270}, 4);
  const Raster<std::uint16_t> before = page.luminance;
  EXPECT_FALSE(clear_margins(page.luminance, kPaper).any());
  EXPECT_EQ(page.luminance.data, before.data);
}

TEST(Margins, AreNotMostOfThePicture) {
  Image page = drawing();
  darken(page, [](double x, double) { return 210 - x; });
  const Raster<std::uint16_t> before = page.luminance;
  EXPECT_FALSE(clear_margins(page.luminance, kPaper).any());
  EXPECT_EQ(page.luminance.data, before.data);
}

}  // namespace
}  // namespace keyline::sketch
