#include "keyline/curve/bezier.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "test_curves.h"

namespace keyline::curve {
namespace {

using core::Point2;

TEST(Bezier, QuarterCircleIsExact) {
  const Bezier2 arc = quarter_circle();
  for (const double t : {0.0, 0.1, 0.5, 0.77, 1.0}) {
    const Jet2 j = jet(arc, t);
    EXPECT_NEAR(std::hypot(j.point.x, j.point.y), 1, 1e-15);
    EXPECT_NEAR(curvature(j), 1, 4e-15);
    EXPECT_NEAR(curvature_rate(j), 0, 3e-14);
    EXPECT_LT(distance(centre_of_curvature(j), {0, 0}), 1e-14);
  }
}

TEST(Bezier, JetMatchesFiniteDifferences) {
  for (int seed = 0; seed < 40; ++seed) {
    const Bezier2 c = random_bezier(seed, 1 + seed % 9, seed % 2 == 1);
    expect_jets_match_differences(c, 0.37);
  }
}

TEST(Bezier, CurvatureAtCuspIsALimit) {
  const Bezier2 left{{{0, 0}, {0, 0}, {1, 0}, {2, 1}}, {}};
  EXPECT_EQ(curvature(left, 0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(tangent_angle(left, 0), 0);
  const Bezier2 line{{{0, 0}, {0, 0}, {1, 0}, {2, 0}}, {}};
  EXPECT_EQ(curvature(line, 0), 0);
  const Bezier2 point{{{3, 4}, {3, 4}}, {}};
  EXPECT_EQ(curvature(point, 0.5), 0);
  EXPECT_EQ(curvature_rate(point, 0.5), 0);
}

TEST(Bezier, CurvatureSurvivesHugeAndTinyCoordinates) {
  for (const double scale : {1e-150, 1e150}) {
    Bezier2 arc = quarter_circle();
    for (Point2& p : arc.control) p = {scale * p.x, scale * p.y};
    EXPECT_NEAR(curvature(arc, 0.3) * scale, 1, 1e-13);
  }
}

TEST(Bezier, SplitAndElevationKeepTheCurve) {
  for (int seed = 0; seed < 30; ++seed) {
    const Bezier2 c = random_bezier(seed, 1 + seed % 8, seed % 3 == 0);
    const auto [a, b] = split(c, 0.3);
    const Bezier2 raised = elevate_degree(c, 3);
    const Bezier2 part = subcurve(c, 0.2, 0.7);
    EXPECT_EQ(degree(raised), degree(c) + 3);
    for (const double t : {0.0, 0.2, 0.6, 1.0}) {
      EXPECT_LT(distance(evaluate(a, t), evaluate(c, 0.3 * t)), 1e-14);
      EXPECT_LT(distance(evaluate(b, t), evaluate(c, 0.3 + 0.7 * t)), 1e-14);
      EXPECT_LT(distance(evaluate(raised, t), evaluate(c, t)), 1e-14);
      EXPECT_LT(distance(evaluate(part, t), evaluate(c, 0.2 + 0.5 * t)), 1e-14);
      EXPECT_LT(distance(evaluate(reverse(c), t), evaluate(c, 1 - t)), 1e-14);
    }
  }
}

TEST(Bezier, SpaceCurveHasCurvatureAndTorsion) {
  // Twisted cubic (t, t^2, t^3) at t = 0: curvature 2, torsion 3.
  const Bezier3 c{{{0, 0, 0}, {1.0 / 3, 0, 0}, {2.0 / 3, 1.0 / 3, 0}, {1, 1, 1}}, {}};
  EXPECT_NEAR(curvature(c, 0), 2, 1e-14);
  EXPECT_NEAR(torsion(jet(c, 0)), 3, 1e-14);
}

TEST(Bezier, ValidationNamesTheCulprit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto path = [](const Bezier2& c) {
    const auto r = validate(c);
    return r ? std::string() : r.error().path;
  };
  EXPECT_EQ(path(quarter_circle()), "");
  EXPECT_EQ(path({{}, {}}), "control");
  EXPECT_EQ(path({{{0, 0}}, {}}), "control");
  EXPECT_EQ(path({std::vector<Point2>(32), {}}), "control");
  EXPECT_EQ(path({{{0, 0}, {0, nan}}, {}}), "control[1]");
  EXPECT_EQ(path({{{0, 0}, {0, 1}}, {1}}), "weights");
  EXPECT_EQ(path({{{0, 0}, {0, 1}}, {1, 0}}), "weights[1]");
  EXPECT_THROW(evaluate(Bezier2{}, 0.5), core::InvalidInput);
}

}  // namespace
}  // namespace keyline::curve
