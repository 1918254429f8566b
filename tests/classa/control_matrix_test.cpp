#include "keyline/classa/control_matrix.h"

#include <array>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "keyline/classa/cav.h"
#include "keyline/curve/bezier.h"

namespace keyline::classa {
namespace {

using core::Point2;
using core::Point3;
using core::Vector2;
using core::Vector3;

constexpr double kSmallest = std::numeric_limits<double>::denorm_min();

TEST(LeavingEdge, IsTheFirstThatTheOthersDoNotDwarf) {
  const std::array plain = {Point2{1, 2}, Point2{1, 2 + 1e-9}, Point2{3, 2}};
  EXPECT_EQ(leaving_edge(plain), (Vector2{0, (2 + 1e-9) - 2}));
  const std::array hair = {Point2{0, 0}, Point2{0, kSmallest}, Point2{0, 1e-13}, Point2{3, 4}};
  EXPECT_EQ(leaving_edge(hair), (Vector2{3, 4}));
  // Edges there and back: the point after them, not the edge that leads to it, tells where it goes.
  const std::array back = {Point3{0, 0, 1}, Point3{0, 1e-14, 1}, Point3{0, 0, 1}, Point3{0, 2, 1}};
  EXPECT_EQ(leaving_edge(back), (Vector3{0, 2, 0}));
}

// Such an edge changes nothing: value and minimum are those of the curve whose first points are
// one.
TEST(LeavingEdge, OfHairsLengthIsNoneToTheMinimum) {
  const auto plane = [](double x) {
    return cav(curve::Bezier2{{{0, 0}, {x, 0}, {2, 0.6}, {2.5, 1.6}}, {}});
  };
  const auto space = [](double x) {
    return cav(curve::Bezier3{{{0, 0, 0}, {x, 0, 0}, {2, 0.6, 0.2}, {2.5, 1.6, 0.7}}, {}});
  };
  for (const double x : {kSmallest, -1e-160, 1e-20}) {
    SCOPED_TRACE(x);
    for (const auto& [hair, none] :
         {std::pair{plane(x), plane(0)}, std::pair{space(x), space(0)}}) {
      ASSERT_TRUE(hair && none);
      EXPECT_EQ(hair->type, none->type);
      ASSERT_TRUE(hair->minimum && none->minimum);
      EXPECT_EQ(hair->minimum->s, none->minimum->s);
      EXPECT_EQ(hair->minimum->beta, none->minimum->beta);
      EXPECT_EQ(hair->minimum->energy, none->minimum->energy);
    }
  }
}

}  // namespace
}  // namespace keyline::classa
