#include "keyline/sketch/never_touching.h"

#include <vector>

#include <gtest/gtest.h>

namespace keyline::sketch {
namespace {

using core::Point2;

SampledStroke from_to(Point2 from, Point2 to) { return sample_stroke({from, to}, false, 1); }

std::vector<TwoLines> told(const std::vector<SampledStroke>& strokes) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < strokes.size(); ++i) all.push_back(i);
  return never_touching(strokes, {all}, 2, 0.45);
}

// The third keeps 2.5 from the second all along; the first two come within 1.8 at one end.
TEST(NeverTouching, PartsWhatKeepsItsGap) {
  const auto lines =
      told({from_to({0, 0}, {100, 0}), from_to({0, 3.5}, {100, 1.8}), from_to({0, 6}, {100, 4.3})});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].one, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(lines[0].other, (std::vector<std::size_t>{2}));
}

TEST(NeverTouching, KeepsWhatTouchesByOthers) {
  EXPECT_TRUE(
      told({from_to({0, 0}, {100, 0}), from_to({0, 1.5}, {100, 1.5}), from_to({0, 3}, {100, 3})})
          .empty());
}

// A line that ends on another one at a right angle is no pass that wanders into it.
TEST(NeverTouching, DoesNotTakeLinesThatMeetAcrossForTouching) {
  EXPECT_EQ(told({from_to({0, 0}, {100, 0}), from_to({50, 0}, {50, 40})}).size(), 1U);
}

}  // namespace
}  // namespace keyline::sketch
