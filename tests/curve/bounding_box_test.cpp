#include "keyline/curve/bounding_box.h"

#include <gtest/gtest.h>

#include "test_curves.h"

namespace keyline::curve {
namespace {

using core::Point2;

template <class C>
Box2 sampled(const C& c) {
  const Point2 start = evaluate(c, 0);
  Box2 box{start, start};
  for (const Point2& p : sample(c, 5001)) box = united(box, p);
  return box;
}

void expect_tight(const Box2& box, const Box2& samples) {
  const double slack = 2e-3;  // what 5001 samples miss at a corner
  EXPECT_LE(box.low.x, samples.low.x + 1e-14);
  EXPECT_LE(box.low.y, samples.low.y + 1e-14);
  EXPECT_GE(box.high.x, samples.high.x - 1e-14);
  EXPECT_GE(box.high.y, samples.high.y - 1e-14);
  EXPECT_NEAR(box.low.x, samples.low.x, slack);
  EXPECT_NEAR(box.low.y, samples.low.y, slack);
  EXPECT_NEAR(box.high.x, samples.high.x, slack);
  EXPECT_NEAR(box.high.y, samples.high.y, slack);
}

TEST(BoundingBox, HoldsAndTouchesRandomCurves) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Bezier2 b = random_bezier(seed, 1 + static_cast<int>(seed) % 11, seed % 2 == 1);
    expect_tight(bounding_box(b), sampled(b));
    expect_tight(bounding_box(PlanarView(b)), sampled(b));
    const BSpline2 s = random_spline(seed, 1 + static_cast<int>(seed) % 5, 9, seed % 2 == 0);
    expect_tight(bounding_box(s), sampled(s));
  }
}

TEST(BoundingBox, ClosedForms) {
  const Bezier2 arch{{{0, 0}, {0, 4}, {4, 4}, {4, 0}}, {}};
  EXPECT_EQ(bounding_box(arch), (Box2{{0, 0}, {4, 3}}));
  const Box2 quarter = bounding_box(quarter_circle());
  EXPECT_NEAR(diagonal(quarter), std::sqrt(2.0), 1e-15);
  EXPECT_EQ(bounding_box(Polyline2{{{1, 2}, {0, 5}}}), (Box2{{0, 2}, {1, 5}}));
}

}  // namespace
}  // namespace keyline::curve
