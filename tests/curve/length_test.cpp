#include "keyline/curve/length.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"

#include "test_curves.h"

namespace keyline::curve {
namespace {

/// y = x^2 from x = 0 to x = 1.
const Bezier2 kParabola{{{0, 0}, {0.5, 0}, {1, 1}}, {}};
const double kParabolaLength = std::sqrt(5.0) / 2 + std::asinh(2.0) / 4;

TEST(ArcLength, ParabolaMeetsEveryTolerance) {
  for (double tolerance = 1e-2; tolerance > 1e-14; tolerance *= 0.1)
    EXPECT_NEAR(arc_length(kParabola, 0, 1, tolerance), kParabolaLength,
                std::max(tolerance, 4e-16) * kParabolaLength);
}

TEST(ArcLength, CircleCuspAndDegenerate) {
  EXPECT_NEAR(arc_length(quarter_circle()), core::kPi / 2, 1e-15 * 4);
  EXPECT_NEAR(arc_length(quarter_circle(), 1, 0), -core::kPi / 2, 1e-15 * 4);
  // (t^2, t^3) over [-1, 1]: a cusp inside, length 2 (13 sqrt(13) - 8) / 27.
  const Bezier2 cusp{{{1, -1}, {-1.0 / 3, 1}, {-1.0 / 3, -1}, {1, 1}}, {}};
  EXPECT_NEAR(arc_length(cusp), 2 * (13 * std::sqrt(13.0) - 8) / 27, 1e-11);
  EXPECT_EQ(arc_length(Bezier2{{{2, 3}, {2, 3}}, {}}), 0);
}

TEST(ArcLength, IsAdditiveOverAnyCut) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const BSpline2 c = random_spline(seed, 3, 8, seed % 2 == 1);
    const double whole = arc_length(c);
    EXPECT_NEAR(arc_length(c, 0, 0.37) + arc_length(c, 0.37, 1), whole, 1e-11 * whole);
    EXPECT_NEAR(arc_length(reverse(c)), whole, 1e-11 * whole);
    const core::Similarity2 map{1e6, 1.1, {-4, 1e5}};
    EXPECT_NEAR(arc_length(transform(c, map)), 1e6 * whole, 1e-10 * 1e6 * whole);
  }
}

TEST(ArcLength, InverseGoesBack) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const BSpline2 c = random_spline(seed, 4, 9, seed % 2 == 1);
    const ArcLengthMap map = arc_length_map(c);
    for (const double f : {0.0, 0.1, 0.33, 0.5, 0.9, 0.999, 1.0}) {
      const double t = parameter_at_length(c, map, f * total_length(map));
      EXPECT_NEAR(arc_length(c, 0, t), f * total_length(map), 1e-14 * total_length(map));
      EXPECT_NEAR(length_at_parameter(c, map, t), f * total_length(map), 1e-14 * total_length(map));
    }
  }
}

// Along a line x(t) = t + e t (1 - t) the length up to t is x(t): nearly even, and no more than
// that.
TEST(ArcLength, ASpeedThatHardlyChangesCounts) {
  for (const double e : {1e-2, 1e-5, 1e-8, 1e-11}) {
    const Bezier2 c{{{0, 0}, {(1 + e) / 2, 0}, {1, 0}}, {}};
    const ArcLengthMap map = arc_length_map(c);
    for (const double t : {0.1, 0.3, 0.77}) {
      EXPECT_NEAR(length_at_parameter(c, map, t), t + e * t * (1 - t), 1e-15) << e;
      EXPECT_NEAR(parameter_at_length(c, map, t + e * t * (1 - t)), t, 1e-15) << e;
    }
  }
}

// A power of two changes no digit of any number that is measured: what differs has a size of its
// own.
TEST(ArcLength, HasNoSizeOfItsOwn) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const BSpline2 c = random_spline(seed, 3 + static_cast<int>(seed % 3), 9, seed % 2 == 1);
    const ArcLengthMap map = arc_length_map(c);
    for (const double scale : {0x1p-40, 0x1p-12, 0x1p30}) {
      const BSpline2 scaled = transform(c, {scale, 0, {0, 0}});
      for (const double tolerance : {1e-6, 1e-12, 1e-15})
        EXPECT_EQ(arc_length(scaled, 0.1, 0.9, tolerance),
                  scale * arc_length(c, 0.1, 0.9, tolerance));
      const ArcLengthMap its = arc_length_map(scaled);
      EXPECT_EQ(total_length(its), scale * total_length(map));
      for (const double f : {0.01, 0.3, 0.5, 0.97}) {
        const double t = parameter_at_length(c, map, f * total_length(map));
        EXPECT_EQ(parameter_at_length(scaled, its, f * total_length(its)), t);
        EXPECT_EQ(length_at_parameter(scaled, its, t), scale * length_at_parameter(c, map, t));
      }
    }
  }
}

// Coordinates are sixteenths, so that both are the same curve. Its speed is rounded to 1e-10 of
// itself there: the beginning must not be looked at so closely that no time is left for the end.
TEST(ArcLength, IsTheSameFarFromTheOrigin) {
  const Bezier2 near{{{0, 0}, {3.5, 0.5}, {-2, 0.25}, {3, 1.75}, {0.0625, -1}, {1, 2}}, {}};
  Bezier2 far = near;
  for (core::Point2& p : far.control) p = p + core::Vector2{1e6, -1e6};
  EXPECT_NEAR(arc_length(far), arc_length(near), 1e-9);
  EXPECT_NEAR(arc_length(far, 0.5, 1), arc_length(near, 0.5, 1), 1e-9);
}

TEST(ArcLength, EqualLengthParametersOfACircle) {
  const auto t = equal_length_parameters(quarter_circle(), 5);
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(core::direction_of(evaluate(quarter_circle(), t[i]) - core::Point2{}),
                i * core::kPi / 8, 1e-14);
}

TEST(ArcLength, PolylineIsExact) {
  const Polyline2 c{{{0, 0}, {3, 4}, {3, 4}, {3, 10}}};
  EXPECT_EQ(arc_length(c), 11);
  EXPECT_DOUBLE_EQ(arc_length(c, 1.0 / 6, 1), 8.5);
  EXPECT_DOUBLE_EQ(parameter_at_length(c, 8), 2.5 / 3);
  EXPECT_EQ(parameter_at_length(c, -1), 0);
  EXPECT_EQ(parameter_at_length(c, 12), 1);
}

TEST(ArcLength, SpaceCurve) {
  const Bezier3 line{{{0, 0, 0}, {1, 2, 2}}, {}};
  EXPECT_NEAR(arc_length(line), 3, 1e-15 * 4);
}

}  // namespace
}  // namespace keyline::curve
