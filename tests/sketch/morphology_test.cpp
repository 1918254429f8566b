#include "keyline/sketch/morphology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include <gtest/gtest.h>

#include "keyline/numeric/random.h"

namespace keyline::sketch {
namespace {

/// A house: right angles, slopes and a thin line, the kind of shape [Sketch] Fig. 6 shows.
Binary house() {
  Binary shape(160, 140);
  for (int y = 0; y < 140; ++y)
    for (int x = 0; x < 160; ++x) {
      const bool walls = x >= 30 && x < 130 && y >= 60 && y < 120;
      const bool roof = y >= 20 && y < 60 && std::abs(x - 80) <= (y - 20) * 5 / 4;
      const bool door = x >= 70 && x < 90 && y >= 90;
      const bool post = x >= 145 && x < 147 && y >= 40 && y < 120;
      shape.at(x, y) = ((walls || roof) && !door) || post ? 1 : 0;
    }
  return shape;
}

Binary noisy(Binary shape, double share) {
  numeric::Random random(6);
  for (std::uint8_t& v : shape.data)
    if (random.chance(share)) v = static_cast<std::uint8_t>(1 - v);
  return shape;
}

int differences(const Binary& a, const Binary& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) count += a.data[i] != b.data[i] ? 1 : 0;
  return count;
}

/// Distance from a corner to the ink pixel of the shape that lies farthest in the corner's
/// direction.
double corner_shift(const Binary& shape, double x, double y, double dx, double dy) {
  double best = -1e9;
  std::array<double, 2> at{};
  for (int v = std::max(0, static_cast<int>(y) - 15);
       v < std::min(shape.height, static_cast<int>(y) + 16); ++v)
    for (int u = std::max(0, static_cast<int>(x) - 15);
         u < std::min(shape.width, static_cast<int>(x) + 16); ++u) {
      if (!shape.at(u, v)) continue;
      const double along = (u - x) * dx + (v - y) * dy;
      const double nearer = std::hypot(u - x, v - y) - std::hypot(at[0] - x, at[1] - y);
      if (along > best + 1e-9 || (along > best - 1e-9 && nearer < 0)) {
        best = along;
        at = {static_cast<double>(u), static_cast<double>(v)};
      }
    }
  return best < -1e8 ? 99 : std::hypot(at[0] - x, at[1] - y);
}

// [Sketch] Fig. 6: ten times plain erosion and dilation against ten times the feature-based kind.
TEST(Morphology, FeatureBasedSmoothingKeepsCornersWherePlainDoesNot) {
  const Binary truth = house();
  const Binary sample = noisy(truth, 0.02);
  Binary plain = sample;
  smooth_pixels(plain, 10);
  Binary ours = sample;
  smooth_edges(ours, 10);
  remove_specks(ours, 6, 6);
  const int noise = differences(sample, truth);
  EXPECT_LT(differences(ours, truth), noise / 4);
  EXPECT_GT(differences(plain, truth), 2 * noise);
  struct Corner {
    double x, y, dx, dy;
  };
  for (const Corner& c : {Corner{30, 119, -1, 1},
                          {129, 119, 1, 1},
                          {80, 20, 0, -1},
                          {69, 119, 1, 1},
                          {90, 119, -1, 1}}) {
    SCOPED_TRACE(std::to_string(c.x) + ", " + std::to_string(c.y));
    EXPECT_LE(corner_shift(ours, c.x, c.y, c.dx, c.dy), 1.0);
  }
  EXPECT_GT(corner_shift(plain, 80, 20, 0, -1), 3.0);
  int post = 0;
  for (int y = 40; y < 120; ++y) post += ours.at(145, y) || ours.at(146, y) ? 1 : 0;
  EXPECT_EQ(post, 80) << "a line two pixels wide stays whole";
}

TEST(Morphology, CleanShapesStayAsTheyAre) {
  Binary shape = house();
  smooth_edges(shape, 10);
  EXPECT_LE(differences(shape, house()), 4);
}

TEST(Morphology, SpecksAndPinholesGoBySize) {
  Binary picture(20, 20);
  for (int y = 2; y < 12; ++y)
    for (int x = 2; x < 12; ++x) picture.at(x, y) = 1;
  picture.at(6, 6) = 0;
  picture.at(15, 15) = picture.at(16, 16) = 1;
  const Removed removed = remove_specks(picture, 3, 2);
  EXPECT_EQ(removed.specks.size(), 1U);
  EXPECT_EQ(removed.pinholes, 1);
  EXPECT_EQ(std::count(picture.data.begin(), picture.data.end(), 1), 100);
}

TEST(Morphology, SmallPiecesStayWhereTheyAreTheDrawing) {
  Binary dashes(60, 20);
  for (int x = 0; x < 56; ++x) dashes.at(x, 5) = x % 8 < 6 ? 1 : 0;
  dashes.at(20, 12) = 1;  // dirt
  const auto drawn = std::count(dashes.data.begin(), dashes.data.end(), 1) - 1;
  EXPECT_EQ(remove_specks(dashes, 10, 1).specks.size(), 1U);
  EXPECT_EQ(std::count(dashes.data.begin(), dashes.data.end(), 1), drawn);
}

// Beside broad lines the dashes of a fine one are as small as dirt: a row of three and more with
// even gaps is none, however it runs.
TEST(Morphology, DashesInARowAreNoDirt) {
  const auto kept = [](const std::vector<std::array<int, 2>>& starts, int down, int breadth) {
    Binary picture(80, 60);
    for (int y = 40; y < 60; ++y)
      for (int x = 0; x < 80; ++x) picture.at(x, y) = 1;
    for (const auto& [x, y] : starts)
      for (int i = 0; i < 6; ++i)
        for (int k = 0; k < breadth; ++k) picture.at(x + i, y + k + i * down / 6) = 1;
    remove_specks(picture, 20, 1);
    return std::count(picture.data.begin(), picture.data.begin() + 80 * 40, 1);
  };
  EXPECT_EQ(kept({{5, 5}, {15, 5}, {25, 5}, {35, 5}}, 0, 1), 24);
  EXPECT_EQ(kept({{5, 5}, {15, 9}, {25, 13}}, 3, 1), 18);
  EXPECT_EQ(kept({{5, 5}, {15, 5}}, 0, 1), 0) << "two are no row";
  EXPECT_EQ(kept({{5, 5}, {15, 5}, {25, 5}, {50, 9}, {61, 20}}, 0, 1), 18) << "and some dirt";
  EXPECT_EQ(kept({{5, 5}, {15, 5}, {25, 5}, {50, 9}, {61, 20}, {20, 26}}, 0, 1), 0)
      << "a row by chance in much dirt";
  EXPECT_EQ(kept({{5, 5}, {14, 5}, {35, 5}}, 0, 1), 0) << "uneven gaps";
  EXPECT_EQ(kept({{5, 5}, {15, 11}, {25, 5}}, 0, 1), 0) << "not in each other's direction";
  EXPECT_EQ(kept({{5, 5}, {15, 5}, {25, 5}}, 0, 3), 0) << "not slender";
}

TEST(Thinning, KeepsConnectionsAndHoles) {
  numeric::Random random(3);
  for (int round = 0; round < 20; ++round) {
    Binary blobs(60, 60);
    for (int k = 0; k < 12; ++k) {
      const double cx = random.uniform(5, 55);
      const double cy = random.uniform(5, 55);
      const double r = random.uniform(2, 12);
      for (int y = 1; y < 59; ++y)
        for (int x = 1; x < 59; ++x)
          if (std::abs(std::hypot(x - cx, y - cy) - r) < 2) blobs.at(x, y) = 1;
    }
    // Euler numbers by quads (Gray): ink pieces less holes
    const auto euler = [](const Binary& b) {
      int q1 = 0, q3 = 0, qd = 0;
      for (int y = 0; y + 1 < b.height; ++y)
        for (int x = 0; x + 1 < b.width; ++x) {
          const int n = b.at(x, y) + b.at(x + 1, y) + b.at(x, y + 1) + b.at(x + 1, y + 1);
          q1 += n == 1 ? 1 : 0;
          q3 += n == 3 ? 1 : 0;
          qd += n == 2 && b.at(x, y) == b.at(x + 1, y + 1) ? 1 : 0;
        }
      return (q1 - q3 - 2 * qd) / 4;
    };
    const Binary lines = thin(blobs);
    EXPECT_EQ(euler(lines), euler(blobs));
    for (std::size_t i = 0; i < lines.data.size(); ++i) EXPECT_LE(lines.data[i], blobs.data[i]);
  }
}

// What thin() promises: no pixel of a staircase is left that could go. By the definition: ink
// beside and ink above or below, and the connections stay without it.
TEST(Thin, LeavesNoCornersOfStaircases) {
  Binary ring(120, 120);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      const double r = std::hypot(x - 60.0, 0.7 * (y - 60.0));
      ring.at(x, y) = r > 34 && r < 39 ? 1 : 0;
    }
  Binary stairs(60, 60);  // a line of one pixel that goes beside and down in turns
  for (int i = 5; i < 50; ++i) stairs.at(i, i) = stairs.at(i + 1, i) = 1;
  for (const Binary& shape :
       {ring, stairs, house(), noisy(house(), 0.02), noisy(house(), 0.1), noisy(ring, 0.05)}) {
    const Binary lines = thin(shape);
    std::ptrdiff_t corners = 0;
    for (int y = 0; y < lines.height; ++y)
      for (int x = 0; x < lines.width; ++x) {
        const unsigned n = neighbours_of(lines, x, y);
        const bool beside = (n & 0b01000100U) != 0;
        const bool above_or_below = (n & 0b00010001U) != 0;
        corners += lines.at(x, y) && beside && above_or_below && is_simple(n) ? 1 : 0;
      }
    const auto pixels = std::count(lines.data.begin(), lines.data.end(), 1);
    std::printf("%td corners of %td pixels\n", corners, pixels);
    EXPECT_LE(corners, pixels / 50);  // what two branches hold between them in noise
  }
  const Binary line = thin(stairs);  // 46 pixels reach from one end to the other corner by corner
  EXPECT_LE(std::count(line.data.begin(), line.data.end(), 1), 47);
}

}  // namespace
}  // namespace keyline::sketch
