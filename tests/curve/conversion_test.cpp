#include "keyline/curve/conversion.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/curve/closest_point.h"
#include "keyline/curve/length.h"

#include "test_curves.h"

namespace keyline::curve {
namespace {

using core::Point2;

/// Unit circle traversed by the angle `turn`, as a curve type of its own.
struct Arc {
  double turn;
};
[[maybe_unused]] Point2 evaluate(const Arc& a, double t) {
  return {std::cos(a.turn * t), std::sin(a.turn * t)};
}
[[maybe_unused]] Jet2 jet(const Arc& a, double t) {
  const double w = a.turn;
  const double c = std::cos(w * t);
  const double s = std::sin(w * t);
  return {{c, s}, {-w * s, w * c}, {-w * w * c, -w * w * s}, {w * w * w * s, -w * w * w * c}};
}
[[maybe_unused]] std::vector<double> breakpoints(const Arc&) { return {0.0, 1.0}; }
static_assert(PlanarCurve<Arc> && PlanarCurve<PiecewiseBezier>);

/// Largest distance found by sampling, both ways.
template <class C>
double sampled_deviation(const C& c, const PiecewiseBezier& b) {
  double largest = 0;
  for (const Point2& p : sample(c, 121)) largest = std::max(largest, closest_point(b, p).distance);
  for (const Point2& p : sample(b, 121)) largest = std::max(largest, closest_point(c, p).distance);
  return largest;
}

void expect_g1(const PiecewiseBezier& b) {
  for (std::size_t i = 0; i + 1 < b.pieces.size(); ++i) {
    const Jet2 end = jet(b.pieces[i], 1);
    const Jet2 start = jet(b.pieces[i + 1], 0);
    EXPECT_EQ(end.point, start.point);
    EXPECT_LT(std::abs(angle_between(end.first, start.first)), 1e-7);
  }
}

TEST(Cubics, CirclesTakeTheFewest) {
  // Smallest deviation of a G1 cubic with exact ends from a quarter circle: 1.96e-4.
  const PiecewiseBezier quarter = approximate_by_cubics(Arc{core::kPi / 2}, 2.1e-4);
  EXPECT_EQ(quarter.pieces.size(), 1u);
  EXPECT_LT(quarter.deviation, 2.1e-4);
  EXPECT_EQ(approximate_by_cubics(Arc{2 * core::kPi}, 2.1e-4).pieces.size(), 4u);
  EXPECT_EQ(approximate_by_cubics(quarter_circle(), 2.1e-4).pieces.size(), 1u);
  EXPECT_EQ(approximate_by_cubics(quarter_circle(), 1.9e-4).pieces.size(), 2u);
  // Sixth order: an eighth of the angle, 2^-18 of the deviation.
  EXPECT_EQ(approximate_by_cubics(quarter_circle(), 2.1e-4 / 262144).pieces.size(), 8u);
}

TEST(Cubics, CubicsComeBackAsTheyAre) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Bezier2 c = random_bezier(seed, 3);
    const PiecewiseBezier same = approximate_by_cubics(c, 1e-9);
    ASSERT_EQ(same.pieces.size(), 1u);
    EXPECT_EQ(same.pieces[0], c);
    EXPECT_LT(same.deviation, 1e-14);
    EXPECT_EQ(approximate_by_cubics(elevate_degree(c, 4), 1e-9).pieces.size(), 1u) << seed;
  }
}

TEST(Cubics, KnotsThatDoNothingCostNothing) {
  int pieces = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Bezier2 c = subcurve(random_bezier(seed, 3), 0.1, 0.5);
    const BSpline2 plain{3, {0, 0, 0, 0, 1, 1, 1, 1}, c.control, {}};
    const BSpline2 refined = refine_knots(plain, {0.2, 0.3, 0.3, 0.7, 0.95});
    pieces += static_cast<int>(approximate_by_cubics(refined, 1e-7).pieces.size());
  }
  EXPECT_EQ(pieces, 20);
}

TEST(Cubics, BoundHoldsAndIsG1) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const BSpline2 c = random_spline(seed, 3 + static_cast<int>(seed) % 3, 9, seed % 2 == 1);
    for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
      const PiecewiseBezier b = approximate_by_cubics(c, tolerance);
      EXPECT_LE(b.deviation, tolerance);
      EXPECT_LE(sampled_deviation(c, b), b.deviation + 1e-13);
    }
  }
  for (unsigned seed = 0; seed < 24; ++seed) {
    const Bezier2 c = random_bezier(seed, 4 + static_cast<int>(seed) % 5, seed % 2 == 1);
    for (const double tolerance : {1e-3, 1e-6}) {
      const PiecewiseBezier exact = approximate_by_cubics(c, tolerance);
      const PiecewiseBezier estimated = approximate_by_cubics(PlanarView(c), tolerance);
      expect_g1(exact);
      EXPECT_LE(exact.deviation, tolerance);
      EXPECT_LE(sampled_deviation(c, exact), exact.deviation + 1e-13);
      EXPECT_LE(sampled_deviation(c, estimated), estimated.deviation + 1e-13);
    }
  }
}

TEST(Cubics, CountFallsWithTheSixthRoot) {
  const Bezier2 c = random_bezier(11, 6);
  const auto coarse = approximate_by_cubics(c, 1e-5).pieces.size();
  const auto fine = approximate_by_cubics(c, 1e-5 / 64).pieces.size();
  EXPECT_LE(fine, 2 * coarse + 2);
}

TEST(Cubics, CornersStayAndLinesMerge) {
  const Polyline2 c{{{0, 0}, {1, 0}, {2, 0}, {2, 0}, {2, 3}}};
  const PiecewiseBezier b = approximate_by_cubics(c, 1e-6);
  EXPECT_EQ(b.pieces.size(), 2u);
  EXPECT_LT(b.deviation, 1e-12);
  const PiecewiseBezier point = approximate_by_cubics(Polyline2{{{1, 1}, {1, 1}}}, 1e-3);
  EXPECT_EQ(point.pieces.size(), 1u);
  EXPECT_THROW(approximate_by_cubics(c, 0), core::InvalidInput);
  EXPECT_THROW(approximate_by_cubics(c, NAN), core::InvalidInput);
}

TEST(Cubics, PoseAndDirectionDoNotMatter) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Bezier2 c = random_bezier(seed, 5);
    const auto count = approximate_by_cubics(c, 1e-5).pieces.size();
    const auto moved = transform(c, core::Similarity2{1e3, 0.8, {50, -70}});
    EXPECT_EQ(approximate_by_cubics(moved, 1e-2).pieces.size(), count);
    EXPECT_EQ(approximate_by_cubics(reverse(c), 1e-5).pieces.size(), count);
  }
}

/// Ends of neighbouring parts of a rational curve agree but for rounding of their coordinates.
TEST(Cubics, RationalCurvesFarFromTheOriginTakeNoMore) {
  const Bezier2 c{{{0, 0}, {1, 0}, {2, 1}, {2, 3}, {1, 4}}, {1, 1, 2, 1, 1}};
  for (const double tolerance : {6e-3, 1e-3, 1e-5})
    for (const double far : {1e3, 1e4, 65536.0}) {
      const auto moved = transform(c, core::Similarity2{1, 0, {far, 0}});
      EXPECT_EQ(approximate_by_cubics(moved, tolerance).pieces.size(),
                approximate_by_cubics(c, tolerance).pieces.size())
          << tolerance << ' ' << far;
    }
}

TEST(Cubics, CuspsEnd) {
  const Bezier2 cusp{{{1, -1}, {-1.0 / 3, 1}, {-1.0 / 3, -1}, {1, 1}}, {}};
  EXPECT_EQ(approximate_by_cubics(cusp, 1e-6).pieces.size(), 1u);
  const PiecewiseBezier b = approximate_by_cubics(elevate_degree(cusp, 2), 1e-6);
  EXPECT_LE(sampled_deviation(cusp, b), 1e-6);
}

TEST(ToBSpline, KeepsThePath) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Bezier2 whole = random_bezier(seed, 4, seed % 2 == 1);
    const auto [a, b] = split(whole, 0.4);
    const auto c = to_bspline(std::vector{a, b, Bezier2{{b.control.back(), {5, 5}}, {}}});
    ASSERT_TRUE(c);
    EXPECT_TRUE(validate(*c));
    const auto pieces = to_beziers(*c);
    ASSERT_EQ(pieces.size(), 3u);
    for (const double t : {0.0, 0.3, 0.8, 1.0}) {
      EXPECT_LT(distance(evaluate(pieces[0], t), evaluate(a, t)), 1e-13);
      EXPECT_LT(distance(evaluate(pieces[1], t), evaluate(b, t)), 1e-13);
    }
    EXPECT_LT(distance(evaluate(*c, 1), {5, 5}), 1e-14);
  }
}

TEST(ToBSpline, SaysWhereItBreaks) {
  const Bezier2 a{{{0, 0}, {1, 0}}, {}};
  const Bezier2 b{{{2, 0}, {3, 0}}, {}};
  EXPECT_EQ(to_bspline(std::vector{a, b}).error().path, "pieces[1]");
  EXPECT_EQ(to_bspline(std::vector<Bezier2>{}).error().path, "pieces");
  EXPECT_EQ(to_bspline(std::vector{a, Bezier2{{{1, 0}}, {}}}).error().path, "pieces[1].control");
  const auto line = to_bspline(Polyline2{{{0, 0}, {1, 0}, {1, 0}, {1, 2}}});
  ASSERT_TRUE(line);
  EXPECT_TRUE(validate(*line));
  EXPECT_EQ(line->control.size(), 3u);
  EXPECT_FALSE(to_bspline(Polyline2{{{1, 0}, {1, 0}}}));
}

TEST(Polyline, OfTwoPointsIsMeasured) {
  const Polyline2 edge{{{1, 0}, {5, 3}}};
  EXPECT_DOUBLE_EQ(parameter_at_length(edge, 1.25), 0.25);
}

TEST(PiecewiseBezier, ParametersBeyondTheEndsAreTheEnds) {
  const PiecewiseBezier two{{{{{1, 2}, {3, 4}}, {}}, {{{3, 4}, {7, 5}}, {}}}, 0};
  for (const double t : {-3.0, -1e-300, std::nan("")})
    EXPECT_EQ(evaluate(two, t), (core::Point2{1, 2})) << t;
  EXPECT_EQ(evaluate(two, 2), (core::Point2{7, 5}));
  EXPECT_EQ(evaluate(two, 0.25), (core::Point2{2, 3}));
}

// What doubles cannot do is told, and done as well as they can: no tolerance asks for more pieces.
TEST(Cubics, ToleranceBelowRoundingIsGivenUp) {
  const Bezier2 c{{{0, 1e30}, {1, 0}, {2, 0.6}, {2.5, 1.6}}, {1, 2, 0.5, 1}};
  const PiecewiseBezier cubics = approximate_by_cubics(c, 1e-3);
  EXPECT_GT(cubics.deviation, 1e-3);
  EXPECT_EQ(approximate_by_cubics(c, 1e-6).pieces.size(), cubics.pieces.size());
}

}  // namespace
}  // namespace keyline::curve
