#include "keyline/exchange/dxf/dxf_color.h"

#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "keyline/document/color.h"

namespace keyline::exchange::detail {
namespace {

struct PaletteCase {
  int index;
  int rgb;
};
/// Of AutoCAD's printed palette.
constexpr PaletteCase kPalette[] = {
    {1, 0xff0000},   {2, 0xffff00},   {3, 0x00ff00},   {4, 0x00ffff},   {5, 0x0000ff},
    {6, 0xff00ff},   {8, 0x808080},   {9, 0xc0c0c0},   {10, 0xff0000},  {11, 0xff7f7f},
    {12, 0xa50000},  {13, 0xa55252},  {14, 0x7f0000},  {15, 0x7f3f3f},  {16, 0x4c0000},
    {17, 0x4c2626},  {18, 0x260000},  {19, 0x261313},  {20, 0xff3f00},  {30, 0xff7f00},
    {40, 0xffbf00},  {50, 0xffff00},  {70, 0x7fff00},  {90, 0x00ff00},  {110, 0x00ff7f},
    {130, 0x00ffff}, {150, 0x007fff}, {170, 0x0000ff}, {190, 0x7f00ff}, {210, 0xff00ff},
    {230, 0xff007f}, {240, 0xff003f}, {250, 0x333333}, {252, 0x848484}, {255, 0xffffff},
};

int largest_difference(int a, int b) {
  int most = 0;
  for (const int shift : {0, 8, 16})
    most = std::max(most, std::abs((a >> shift & 255) - (b >> shift & 255)));
  return most;
}

TEST(AciColor, IsThatOfThePalette) {
  for (const PaletteCase& c : kPalette)
    EXPECT_LE(largest_difference(document::color_value(aci_color(c.index)), c.rgb), 2)
        << c.index << " " << aci_color(c.index);
  EXPECT_EQ(aci_color(7), "#000000");
  for (const int none : {-1, 0, 256}) EXPECT_EQ(aci_color(none), "");
}

TEST(TrueColor, IsWrittenInSixDigits) {
  EXPECT_EQ(true_color(0x0a1b2c), "#0a1b2c");
  EXPECT_EQ(true_color(0), "#000000");
  EXPECT_EQ(true_color(0xffffff), "#ffffff");
}

TEST(NearestAci, NoOtherIsNearer) {
  std::mt19937 random(1);
  const auto square = [](int a, int b) {
    int sum = 0;
    for (const int shift : {0, 8, 16}) {
      const int off = (a >> shift & 255) - (b >> shift & 255);
      sum += off * off;
    }
    return sum;
  };
  for (int n = 0; n < 50; ++n) {
    const int rgb = static_cast<int>(random() & 0xffffff);
    const int found = nearest_aci(rgb);
    const int own = square(rgb, document::color_value(aci_color(found)));
    for (int index = 1; index <= 255; ++index) {
      const int other = square(rgb, document::color_value(aci_color(index)));
      EXPECT_TRUE(index < found ? other > own : other >= own) << found << " " << index;
    }
  }
  for (const int index : {1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 33, 101, 255})
    EXPECT_EQ(nearest_aci(document::color_value(aci_color(index))), index);
}

}  // namespace
}  // namespace keyline::exchange::detail
