#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/numeric/random.h"
#include "keyline/sketch/dark_rows.h"
#include "keyline/sketch/ink_measure.h"
#include "keyline/sketch/ink_radius.h"
#include "keyline/sketch/pixel_words.h"
#include "keyline/sketch/rows.h"

namespace keyline::sketch {
namespace {

/// Paper with noise and dark blots, some of them at the rim.
Tone blotted(int width, int height) {
  numeric::Random random(11);
  Tone tone;
  tone.gain = 0.18;
  tone.level = Raster<std::uint16_t>(width, height, 59000);
  for (std::uint16_t& v : tone.level.data)
    v = static_cast<std::uint16_t>(v + random.uniform(700, 1300));
  for (int blot = 0; blot < 12; ++blot) {
    const double x = random.uniform(0, width);
    const double y = blot < 3 ? 0 : random.uniform(30, height);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u)
        if (std::hypot(u - x, v - y) < 4)
          tone.level.at(u, v) = static_cast<std::uint16_t>(random.uniform(15000, 58000));
  }
  // blurred, it is seen beside blocks of sixteen in which nothing is
  for (int y = 10; y < 20; ++y)
    for (const int x : {15, 48})
      if (x < width) tone.level.at(x, y) = 9000;
  return tone;
}

/// A neighbour's weight where the middle has what is left of 1.
double side_weight(double sigma) {
  const double beside = std::exp(-0.5 / (sigma * sigma));
  return beside / (1 + 2 * beside);
}

/// Darkness under Gauss's bell of 3 × 3 pixels, mirrored at the rim.
double blurred(const Tone& tone, double sigma, int x, int y) {
  const double side = side_weight(sigma);
  const auto mirrored = [](int i, int n) { return i < 0 ? -i : i >= n ? 2 * n - 2 - i : i; };
  double sum = 0;
  for (int v = -1; v <= 1; ++v)
    for (int u = -1; u <= 1; ++u) {
      const double weight = (u ? side : 1 - 2 * side) * (v ? side : 1 - 2 * side);
      const double level =
          tone.level.at(mirrored(x + u, tone.level.width), mirrored(y + v, tone.level.height));
      sum += weight * kBlack * (1 - std::exp((std::min(level / 60000, 1.0) - 1) / tone.gain));
    }
  return sum;
}

TEST(DarkRows, AreGaussBlurredWhereDarkAndNothingElsewhere) {
  const int least = 5000;
  for (const double sigma : {0.5, 0.85})
    for (const int width : {67, 64, 9}) {
      const Tone tone = blotted(width, 50);
      const DarknessTable table(tone);
      DarkRows rows(tone.level, table, sigma, least);
      int dark = 0;
      for (int first = 0; first < 50; first += 20) {
        const int last = std::min(first + 20, 50);
        rows.read(first, last);
        for (int y = first - DarkRows::kMargin; y < last + DarkRows::kMargin; ++y)
          for (int x = -DarkRows::kMargin; x < width + DarkRows::kMargin; ++x) {
            const int got = rows.row(y)[x];
            if (!tone.level.contains(x, y)) {
              ASSERT_EQ(got, 0) << x << ", " << y;
              continue;
            }
            const double wanted = blurred(tone, sigma, x, y);
            if (wanted >= least + 2) ++dark;
            if (wanted >= least + 2 || got > 0) {
              ASSERT_NEAR(got, wanted, 1.5) << x << ", " << y << " of " << width;
            }
          }
      }
      EXPECT_GT(dark, 100);
    }
}

/// A wedge cut by the rim, with a hole; every pixel is asked for.
void expect_distances(double slope) {
  Binary ink(200, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 10; x < 200; ++x)
      ink.at(x, y) = std::abs(y - 45) < slope * (x - 10) && std::hypot(x - 180, y - 45) > 6 ? 1 : 0;
  const InkRadius radius(ink, ink);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 200; ++x) {
      if (!ink.at(x, y)) continue;
      double least = 1e9;
      for (int v = -1; v <= 100; ++v)
        for (int u = -1; u <= 200; ++u)
          if (!ink.contains(u, v) || !ink.at(u, v))
            least = std::min(least, std::hypot(u - x, v - y));
      // steps of a knight's and shorter ones err by 2 % at most [Borgefors 1986]
      ASSERT_NEAR(radius.at(x, y), std::max(0.5, least - 0.5), 0.021 * least) << x << ", " << y;
    }
}

TEST(InkRadius, IsTheDistanceToPaper) { expect_distances(0.12); }

TEST(InkRadius, IsSoHoweverBroadTheInk) { expect_distances(0.3); }

TEST(PixelWords, CountAndVisitWhatALoopDoes) {
  numeric::Random random(3);
  for (const int width : {1, 7, 8, 9, 31, 40}) {
    Binary ink(width, 23);
    for (std::uint8_t& v : ink.data) v = random.chance(0.7) ? 1 : 0;
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < ink.data.size(); ++i)
      if (ink.data[i]) wanted.push_back(i);
    std::vector<std::size_t> seen;
    visit_set(ink.data.data(), ink.data.size(), [&](std::size_t i) { seen.push_back(i); });
    EXPECT_EQ(seen, wanted);
    EXPECT_EQ(count_ink(ink.data.data(), ink.data.size()), std::ssize(wanted));
    const auto paper = [&](int x, int y) { return !ink.contains(x, y) || !ink.at(x, y); };
    int border = 0;
    for (int y = 0; y < ink.height; ++y)
      for (int x = 0; x < width; ++x)
        border += !paper(x, y) &&
                  (paper(x - 1, y) || paper(x + 1, y) || paper(x, y - 1) || paper(x, y + 1));
    EXPECT_EQ(measure_ink(ink).border, border);
  }
}

TEST(PixelWords, LooksUpEveryValueOfARow) {
  numeric::Random random(4);
  std::vector<std::uint16_t> table(65536);
  for (std::uint16_t& v : table) v = static_cast<std::uint16_t>(random.uniform(0, 65535));
  for (const std::size_t size : {std::size_t{1}, std::size_t{6}, std::size_t{61}}) {
    std::vector<std::uint16_t> row(size);
    for (std::uint16_t& v : row) v = random.chance(0.8) ? 0 : 60000;
    std::vector<std::uint16_t> found(size);
    look_up_row(row.data(), size, table, found.data());
    for (std::size_t i = 0; i < size; ++i) EXPECT_EQ(found[i], table[row[i]]);
  }
}

}  // namespace
}  // namespace keyline::sketch
