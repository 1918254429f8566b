#include "keyline/curve/bspline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "test_curves.h"

namespace keyline::curve {
namespace {

using core::Point2;

void expect_same_curve(const BSpline2& a, const BSpline2& b, double tolerance) {
  for (int i = 0; i <= 50; ++i) {
    const double t = i / 50.0;
    EXPECT_LT(distance(evaluate(a, t), evaluate(b, t)), tolerance) << "t = " << t;
  }
}

BSpline2 case_of(unsigned seed) {
  const int degree = 1 + static_cast<int>(seed) % 6;
  return random_spline(seed, degree, degree + 1 + static_cast<int>(seed) % 7, seed % 2 == 1);
}

TEST(BSpline, RandomCasesAreValid) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const auto r = validate(case_of(seed));
    EXPECT_TRUE(r) << seed << ' ' << (r ? "" : r.error().message + r.error().path);
  }
}

TEST(BSpline, JetMatchesFiniteDifferences) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const BSpline2 c = case_of(seed);
    const auto b = breakpoints(c);
    for (std::size_t i = 0; i + 1 < b.size(); ++i) {
      if (b[i + 1] - b[i] > 1e-3) expect_jets_match_differences(c, 0.4 * b[i] + 0.6 * b[i + 1]);
    }
  }
}

TEST(BSpline, BreakpointBelongsToTheSpanItStarts) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const BSpline2 c = case_of(seed);
    const auto pieces = to_beziers(c);
    const auto b = breakpoints(c);
    ASSERT_EQ(pieces.size() + 1, b.size());
    for (std::size_t i = 0; i + 1 < b.size(); ++i) {
      const double width = b[i + 1] - b[i];
      const auto start = rescaled(jet(c, b[i]), width);
      const auto end =
          rescaled(jet(c, i + 2 < b.size() ? std::nextafter(b[i + 1], 0) : 1.0), width);
      EXPECT_LT(norm(start.third - jet(pieces[i], 0).third), 1e-9);
      EXPECT_LT(norm(end.third - jet(pieces[i], 1).third), 1e-9);
    }
  }
}

TEST(BSpline, PiecesAreTheCurve) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const BSpline2 c = case_of(seed);
    const auto pieces = to_beziers(c);
    const auto b = breakpoints(c);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (const double u : {0.0, 0.3, 0.9}) {
        const Point2 p = evaluate(c, (1 - u) * b[i] + u * b[i + 1]);
        EXPECT_LT(distance(evaluate(pieces[i], u), p), 1e-12);
      }
    }
  }
}

TEST(BSpline, RefiningKeepsTheCurve) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const BSpline2 c = case_of(seed);
    expect_same_curve(insert_knot(c, knot_at(c, 0.31), c.degree), c, 1e-12);
    expect_same_curve(clamp_ends(c), c, 1e-12);
    const BSpline2 raised = elevate_degree(c, 2);
    EXPECT_TRUE(validate(raised));
    expect_same_curve(raised, c, 1e-11);
  }
}

TEST(BSpline, SubcurveAndReverse) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const BSpline2 c = case_of(seed);
    const auto [a, b] = split(c, 0.42);
    const BSpline2 back = reverse(c);
    EXPECT_TRUE(validate(a));
    EXPECT_TRUE(validate(b));
    for (const double t : {0.0, 0.25, 0.7, 1.0}) {
      EXPECT_LT(distance(evaluate(a, t), evaluate(c, 0.42 * t)), 1e-12);
      EXPECT_LT(distance(evaluate(b, t), evaluate(c, 0.42 + 0.58 * t)), 1e-12);
      EXPECT_LT(distance(evaluate(back, t), evaluate(c, 1 - t)), 1e-12);
    }
  }
}

// 2 - 1e-160 is 2: six knots at the end would be one too many.
TEST(BSpline, ReversingKeepsKnotsApart) {
  const BSpline2 c{
      3, {0, 0, 0, 0, 1e-160, 2, 2, 2, 2}, {{0, 0}, {1, 0}, {2, 0.2}, {3, 0.7}, {3.8, 1.5}}, {}};
  const BSpline2 back = reverse(c);
  EXPECT_TRUE(validate(back));
  EXPECT_EQ(back.knots, (std::vector<double>{-2, -2, -2, -2, -1e-160, 0, 0, 0, 0}));
  EXPECT_EQ(reverse(back).knots, c.knots);
  EXPECT_LT(distance(evaluate(back, 0.25), evaluate(c, 0.75)), 1e-12);
}

TEST(BSpline, JumpsAreKept) {
  const BSpline2 c{1, {0, 0, 1, 1, 2, 2}, {{0, 0}, {1, 0}, {1, 5}, {2, 5}}, {}};
  ASSERT_TRUE(validate(c));
  EXPECT_LT(distance(evaluate(c, 0.5), {1, 5}), 1e-15);
  EXPECT_LT(distance(evaluate(c, std::nextafter(0.5, 0)), {1, 0}), 1e-12);
  EXPECT_EQ(to_beziers(c).size(), 2u);
}

TEST(BSpline, ValidationNamesTheCulprit) {
  const auto path = [](BSpline2 c, auto&& change) {
    change(c);
    const auto r = validate(c);
    return r ? std::string() : r.error().path;
  };
  const BSpline2 good{2, {0, 0, 0, 1, 2, 2, 2}, {{0, 0}, {1, 0}, {1, 1}, {2, 1}}, {1, 1, 1, 1}};
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(path(good, [](auto&) {}), "");
  EXPECT_EQ(path(good, [](auto& c) { c.degree = 0; }), "degree");
  EXPECT_EQ(path(good, [](auto& c) { c.degree = 31; }), "degree");
  EXPECT_EQ(path(good, [](auto& c) { c.degree = 4; }), "control");
  EXPECT_EQ(path(good, [](auto& c) { c.knots.pop_back(); }), "knots");
  EXPECT_EQ(path(good, [](auto& c) { c.knots[3] = 3; }), "knots[4]");
  EXPECT_EQ(path(good, [](auto& c) { c.knots[3] = 0; }), "knots[3]");
  EXPECT_EQ(path(good, [=](auto& c) { c.knots[6] = inf; }), "knots[6]");
  EXPECT_EQ(path(good, [=](auto& c) { c.control[2].x = inf; }), "control[2]");
  EXPECT_EQ(path(good, [](auto& c) { c.weights[1] = -1; }), "weights[1]");
  EXPECT_EQ(path(good, [](auto& c) { c.weights.pop_back(); }), "weights");
  EXPECT_THROW(evaluate(BSpline2{}, 0.5), core::InvalidInput);
}

}  // namespace
}  // namespace keyline::curve
