#include "keyline/sketch/double_edges.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::sketch {
namespace {

using Height = std::function<double(double)>;

/// Pairs told of strokes of a pen of 1, a hundred long, at these heights.
std::vector<TwoLines> told(const std::vector<Height>& heights, double to = 100) {
  std::vector<SampledStroke> strokes;
  std::vector<std::size_t> all;
  for (const Height& y : heights) {
    std::vector<core::Point2> points;
    for (double x = 0; x <= to; x += 0.5) points.push_back({x, 10 * std::sin(x / 40) + y(x)});
    all.push_back(strokes.size());
    strokes.push_back(sample_stroke(points, false, 1));
  }
  return double_edges(strokes, {all}, {.width = 1, .apart = 3.5, .hand = 0});
}

Height at(double y) {
  return [y](double) { return y; };
}

/// Keeps its distance but for one place, ten long, where it touches what lies at 0.
double pinched(double x) { return 2.5 - 1.5 * std::exp(-std::pow((x - 60) / 5, 2)); }

TEST(DoubleEdges, ArePartedThoughTheyTouchInOnePlace) {
  for (const auto& heights : {std::vector<Height>{at(0), at(2.5)}, {at(0), pinched}}) {
    const auto lines = told(heights);
    ASSERT_FALSE(lines.empty());
    EXPECT_EQ(lines[0].one, (std::vector<std::size_t>{0}));
    EXPECT_EQ(lines[0].other, (std::vector<std::size_t>{1}));
  }
}

// A loose hand's second pass comes and goes; of a fan's the distance grows all along.
TEST(DoubleEdges, AreNoPassesThatWanderOrFanOut) {
  EXPECT_TRUE(told({at(0), [](double x) { return 2 + std::cos(x / 8); }}).empty());
  EXPECT_TRUE(told({at(0), [](double x) { return 0.5 + x / 40; }}).empty());
}

// By chance a short stroke keeps its distance, and so do strokes whose ink nearly touches; with
// another stroke between, two are not next to each other.
TEST(DoubleEdges, AreLongWithPaperBetween) {
  EXPECT_TRUE(told({at(0), at(2.5)}, 28).empty());
  EXPECT_TRUE(told({at(0), at(1.4)}).empty());
  EXPECT_TRUE(told({at(0), at(1.3), at(2.6)}).empty());
}

}  // namespace
}  // namespace keyline::sketch
