#include "keyline/core/extent.h"

#include <vector>

#include <gtest/gtest.h>

namespace keyline::core {
namespace {

// 3, 4, 12 have the diagonal 13; a point of the plane has z = 0.
TEST(Extent, OfABox) {
  Box3 box = box_of(std::vector<Point3>{{2, 5, 12}, {-1, 9, 1}});
  box.take(Point2{0, 6});
  EXPECT_EQ(box.low, (Point3{-1, 5, 0}));
  EXPECT_EQ(box.high, (Point3{2, 9, 12}));
  EXPECT_EQ(diagonal(box), 13);
  EXPECT_EQ(longest_side(box), 12);
}

TEST(Extent, OfNothingIsNone) {
  EXPECT_TRUE(is_empty(Box3{}));
  EXPECT_EQ(diagonal(Box3{}), 0);
  EXPECT_EQ(longest_side(Box3{}), 0);
  EXPECT_FALSE(is_empty(box_of(std::vector{Point3{}})));
}

TEST(Extent, ReachIsFromTheFirst) {
  EXPECT_EQ(reach(std::vector<Point2>{{1, 1}, {4, 5}, {-2, 1}}), 5);
  EXPECT_EQ(reach(std::vector<Point3>{{1, 1, 1}, {1, 1, 3}}), 2);
  EXPECT_EQ(reach(std::vector<Point2>{}), 0);
}

}  // namespace
}  // namespace keyline::core
