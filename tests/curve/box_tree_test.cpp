#include "keyline/curve/box_tree.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::curve {
namespace {

/// Unit boxes end to end along the x axis.
BoxTree row_of(int count) {
  std::vector<Box2> boxes;
  for (int i = 0; i < count; ++i) boxes.push_back({{1.0 * i, 0}, {i + 1.0, 1}});
  return BoxTree(boxes);
}

TEST(BoxTree, LooksAtTheNearestAndHardlyAnyOther) {
  const BoxTree tree = row_of(100000);
  int looks = 0;
  std::size_t at = 0;
  double nearest = INFINITY;
  tree.visit({70000.25, 9}, nearest, [&](std::size_t i) {
    ++looks;
    // Each box holds the point at the middle of its lower side.
    const double away = std::hypot(70000.25 - (static_cast<double>(i) + 0.5), 9.0);
    if (away < nearest) {
      nearest = away;
      at = i;
    }
  });
  EXPECT_EQ(at, 70000U);
  // All whose box is within hypot(0.25, 9): 4.1 to either side of the one.
  EXPECT_LE(looks, 9);
  EXPECT_GE(looks, 1);
}

TEST(BoxTree, LeavesNothingOutThatIsAsNear) {
  for (const int count : {1, 2, 3, 5, 8, 13}) {
    std::vector<bool> seen(static_cast<std::size_t>(count));
    const double nearest = 100;  // which nothing lowers
    row_of(count).visit({0.5, 0.5}, nearest, [&](std::size_t i) { seen.at(i) = true; });
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), count);
  }
  BoxTree({}).visit({0, 0}, INFINITY, [](std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace keyline::curve
