#include "keyline/curve/polyline.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/arriving.h"

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

// A vertex twice in one place turns by nothing: its edge has the direction of the next one, at the
// end that of the last.
TEST(Polyline, AnEdgeOfNoLengthHasTheDirectionOfTheNext) {
  const double up = core::kPi / 2;
  const Polyline2 line{{{0, 0}, {0, 0}, {0, 1}, {0, 1}, {2, 1}, {2, 1}, {2, 1}}};
  const double wanted[] = {up, up, 0, 0, 0, 0};
  for (int edge = 0; edge < 6; ++edge)
    for (const double of_it : {0.0, 0.4}) {
      const Jet2 j = jet(line, (edge + of_it) / 6);
      EXPECT_NEAR(tangent_angle(j), wanted[edge], 1e-15) << edge;
      EXPECT_NEAR(arriving_angle(j), wanted[edge], 1e-15) << edge;
      EXPECT_EQ(norm(j.first) > 0, edge == 1 || edge == 3) << edge;  // no length is added
      EXPECT_EQ(curvature(j), 0);
    }
  EXPECT_NEAR(arriving_angle(jet(line, 1)), 0, 1e-15);
  EXPECT_EQ(jet(Polyline2{{{1, 1}, {1, 1}}}, 0.5), (Jet2{{1, 1}, {}, {}, {}}));
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
