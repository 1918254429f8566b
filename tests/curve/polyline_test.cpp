#include "keyline/curve/polyline.h"

#include <cmath>

#include <gtest/gtest.h>

#include "test_curves.h"

namespace keyline::curve {
namespace {

static_assert(PlanarCurve<Polyline2> && PlanarCurve<Bezier2> && PlanarCurve<BSpline2>);
static_assert(SpaceCurve<Polyline3> && SpaceCurve<Bezier3> && SpaceCurve<BSpline3>);

TEST(Polyline, VertexBelongsToTheEdgeItStarts) {
  for (int n = 2; n < 200; ++n) {
    Polyline2 c;
    for (int i = 0; i < n; ++i)
      c.points.push_back({static_cast<double>(i), i % 2 == 0 ? 0.0 : 1.0});
    const auto b = breakpoints(c);
    for (int i = 0; i + 1 < n; ++i) {
      EXPECT_GT(jet(c, b[i]).first.y * (i % 2 == 0 ? 1 : -1), 0);
      EXPECT_LT(distance(evaluate(c, b[i]), c.points[i]), 1e-12);
      if (i > 0) {
        EXPECT_LT(jet(c, std::nextafter(b[i], 0)).first.y * (i % 2 == 0 ? 1 : -1), 0);
      }
    }
    EXPECT_EQ(evaluate(c, 1), c.points.back());
  }
}

TEST(Polyline, SplitMeetsAtThePoint) {
  const Polyline2 c{{{0, 0}, {1, 0}, {1, 1}, {3, 1}}};
  const auto [a, b] = split(c, 0.5);
  EXPECT_EQ(a.points.size(), 3u);
  EXPECT_LT(distance(a.points.back(), {1, 0.5}), 1e-15);
  EXPECT_EQ(a.points.back(), b.points.front());
  EXPECT_EQ(b.points.back(), c.points.back());
  EXPECT_EQ(reverse(reverse(c)), c);
}

TEST(Polyline, Validation) {
  EXPECT_TRUE(validate(Polyline2{{{0, 0}, {0, 0}}}));
  EXPECT_EQ(validate(Polyline2{{{0, 0}}}).error().path, "points");
  EXPECT_EQ(validate(Polyline2{{{0, 0}, {0, 1}, {NAN, 1}}}).error().path, "points[2]");
  EXPECT_THROW(evaluate(Polyline2{}, 0), core::InvalidInput);
}

}  // namespace
}  // namespace keyline::curve
