#include "keyline/lac/g2/spline.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/length.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point2;

std::vector<Point2> on_circle(int n, double step) {
  std::vector<Point2> points;
  for (int i = 0; i < n; ++i) points.push_back({2 * std::cos(i * step), 2 * std::sin(i * step)});
  return points;
}

SplineOptions with_slope(double alpha) {
  SplineOptions options;
  options.alpha = {alpha};
  return options;
}

/// Largest distance of the span ends from the points, by the chain's own functions.
double misses(const SplineSolution& s, const std::vector<Point2>& points) {
  const auto poses = joints(s.chain);
  double worst = distance(poses[0].position, points[0]);
  for (std::size_t k = 1; k < poses.size(); ++k) {
    if (k < s.span.size() && s.span[k] == s.span[k - 1]) continue;
    worst =
        std::max(worst, distance(poses[k].position, points[(s.span[k - 1] + 1) % points.size()]));
  }
  return worst;
}

std::vector<Point2> wavy(int n, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Point2> points;
  for (int i = 0; i < n; ++i) points.push_back({double(i), noise * any(random)});
  return points;
}

TEST(Spline, PointsOnACircleGiveTheCircle) {
  for (const double alpha : {-5.0, -1.0, 0.0, 0.5, 1.0, 2.0, 30.0}) {
    for (const bool closed : {false, true}) {
      SplineOptions options = with_slope(alpha);
      options.closed = closed;
      const auto points = closed ? on_circle(5, 2 * core::kPi / 5) : on_circle(6, 0.8);
      const auto s = solve_spline(points, options);
      ASSERT_TRUE(s) << alpha << s.error().message;
      for (const Piece& p : s->chain.pieces) {
        EXPECT_NEAR(p.curvature_start, 0.5, 1e-12);
        EXPECT_EQ(p.alpha, alpha);
      }
      EXPECT_LT(misses(*s, points), 1e-13);
      EXPECT_TRUE(s->overridden.empty());
    }
  }
}

TEST(Spline, PointsOfASegmentGiveTheSegment) {
  for (const double alpha : {-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.5}) {
    const Segment segment{{{1, 2}, 0.7}, alpha, 3, 0.2, 0.9};
    std::vector<Point2> points;
    for (const double t : {0.0, 0.15, 0.4, 0.6, 1.0}) points.push_back(evaluate(segment, t));
    SplineOptions options = with_slope(alpha);
    options.start.direction = 0.7;
    options.end.direction = end_pose(segment).direction;
    const auto s = solve_spline(points, options);
    ASSERT_TRUE(s) << alpha;
    ASSERT_EQ(s->chain.pieces.size(), 4u);
    EXPECT_NEAR(s->chain.pieces[0].curvature_start, 0.2, 1e-11);
    EXPECT_NEAR(s->chain.pieces[3].curvature_end, 0.9, 1e-11);
    EXPECT_NEAR(arc_length(s->chain), 3, 1e-12);
    EXPECT_LT(misses(*s, points), 1e-13);
    options.start.curvature = 0.2;
    options.end.curvature = 0.9;
    const auto both = solve_spline(points, options);
    ASSERT_TRUE(both);
    EXPECT_EQ(both->chain.pieces.size(), 6u);
    EXPECT_NEAR(arc_length(both->chain), 3, 1e-12);
  }
}

TEST(Spline, ALongOneIsG2AndMeetsItsPoints) {
  for (const double alpha : {-1.0, -2.0, -0.5, 0.5}) {
    const auto points = wavy(1000, 0.5, 3);
    const auto s = solve_spline(points, with_slope(alpha));
    ASSERT_TRUE(s) << alpha << s.error().message;
    EXPECT_FALSE(s->span_by_span);
    EXPECT_EQ(s->chain.pieces.size(), 999u);
    EXPECT_EQ(largest_joint_gap(s->chain).curvature, 0);
    EXPECT_LT(misses(*s, points), 1e-10);
    for (std::size_t i = 0; i < s->chain.pieces.size(); ++i) {
      const Piece& p = s->chain.pieces[i];
      ASSERT_TRUE(validate(p));
      const bool given_way = std::binary_search(s->overridden.begin(), s->overridden.end(), i);
      EXPECT_EQ(p.alpha, given_way ? -1 : alpha);
    }
  }
}

TEST(Spline, ASymmetricRequestHasASymmetricAnswer) {
  const std::vector<Point2> points{{0, 0}, {1, 0.6}, {2, -0.4}, {3, 0.6}, {4, 0}};
  for (const double alpha : {-1.0, -3.0, -0.4, 1.0}) {
    const auto s = solve_spline(points, with_slope(alpha));
    ASSERT_TRUE(s);
    for (std::size_t i = 0; i < 4; ++i) {
      const Piece& a = s->chain.pieces[i];
      const Piece& b = s->chain.pieces[3 - i];
      EXPECT_NEAR(a.curvature_start, b.curvature_end, 1e-10);
      EXPECT_NEAR(a.length, b.length, 1e-10);
    }
  }
}

TEST(Spline, DoesNotDependOnPlaceScaleOrSense) {
  const std::vector<Point2> points{{0, 0}, {1, 0.6}, {2, -0.2}, {3.5, 0.6}, {4, 1.5}};
  const core::Similarity2 map{250, 2.3, {-40, 7}};
  for (const double alpha : {-1.0, -2.0, 0.5}) {
    const auto s = solve_spline(points, with_slope(alpha));
    ASSERT_TRUE(s);
    std::vector<Point2> moved;
    for (const Point2& p : points) moved.push_back(apply(map, p));
    const auto m = solve_spline(moved, with_slope(alpha));
    std::vector<Point2> back(points.rbegin(), points.rend());
    const auto r = solve_spline(back, with_slope(alpha));
    ASSERT_TRUE(m && r);
    EXPECT_EQ(m->overridden, s->overridden);
    for (const double t : {0.1, 0.35, 0.8}) {
      const Point2 p = evaluate(s->chain, t);
      EXPECT_LT(distance(apply(map, p), evaluate(m->chain, t)), 1e-9 * map.scale);
      EXPECT_LT(distance(p, evaluate(r->chain, 1 - t)), 1e-9);
    }
  }
}

/// With another point named first, and travelled the other way: the same pieces and the same spans
/// overridden, and each span between its points.
void expect_same_from_any_point(std::vector<Point2> points, std::vector<double> alpha) {
  SplineOptions options;
  options.closed = true;
  options.alpha = alpha;
  const auto first = solve_spline(points, options);
  ASSERT_TRUE(first) << first.error().message;
  for (std::size_t turned = 1; turned < points.size(); ++turned) {
    std::rotate(points.begin(), points.begin() + 1, points.end());
    std::rotate(options.alpha.begin(), options.alpha.begin() + 1, options.alpha.end());
    auto round = points;
    auto back = options;
    for (const bool reversed : {false, true}) {
      if (reversed) {
        std::reverse(round.begin() + 1, round.end());
        std::reverse(back.alpha.begin(), back.alpha.end());
      }
      const auto s = solve_spline(round, back);
      ASSERT_TRUE(s) << s.error().message;
      EXPECT_NEAR(arc_length(s->chain), arc_length(first->chain), 1e-9);
      EXPECT_EQ(s->overridden.size(), first->overridden.size());
      EXPECT_LT(misses(*s, round), 1e-10);
      ASSERT_EQ(s->span.size(), s->chain.pieces.size());
      for (std::size_t k = 0; k < s->span.size(); ++k) {
        const bool kept = std::ranges::find(s->overridden, s->span[k]) == s->overridden.end();
        EXPECT_EQ(s->chain.pieces[k].alpha, kept ? back.alpha[s->span[k]] : -1);
      }
    }
  }
}

// Several splines pass these points; laid out straight from either end, one or another was reached.
TEST(Spline, OfSeveralEitherEndNamesOne) {
  const std::vector<Point2> open{
      {5.510600057421676, 1.3087834590404364},  {4.288529893010087, 2.170228384325094},
      {3.2476803842756525, 1.8210215552225417}, {2.3061577716638757, 0.7540578701955261},
      {1.0866157758472164, 1.0487812495460835}, {0.3809930199221187, 0.9916019437834389}};
  const std::vector<Point2> round{{0, 0.00016},  {6, -0.00203}, {5, 0.13542}, {4, 0.03097},
                                  {3, -0.03831}, {2, 0.01844},  {1, -0.00019}};
  SplineOptions closed;
  closed.closed = true;
  closed.alpha = {-1.78, 0.5, 1.0, -0.01, -1.0, 1.0, -3.98};
  for (auto [points, options] : {std::pair{open, with_slope(-1e-4)}, std::pair{round, closed}}) {
    const auto there = solve_spline(points, options);
    std::reverse(points.begin(), points.end());
    if (options.closed) std::rotate(points.begin(), points.end() - 1, points.end());
    std::reverse(options.alpha.begin(), options.alpha.end());
    const auto back = solve_spline(points, options);
    ASSERT_TRUE(there && back);
    EXPECT_NEAR(arc_length(there->chain), arc_length(back->chain), 1e-9);
  }
}

// Several splines pass these points too: which of them was found turned on the point named first.
TEST(Spline, OfSeveralClosedOnesAnyPointNamesOne) {
  const std::vector<Point2> six{
      {0.41442451883910536, 0.0015847499555259326}, {0.5401095570883858, 0.7864443854425286},
      {0.33113745196273026, 0.5998551847634835},    {0.8045694845140354, 0.6353710903019552},
      {0.5507562651072507, 0.18078399346030394},    {0.09160140751629275, 0.5510291367552992}};
  const std::vector<Point2> seven{
      {0.2875376255881232, 0.008798105242628085}, {1.3113301132878434, 1.0646736802591503},
      {2.324201657390655, 2.153113272443876},     {3.467542421665706, 1.8345769811329196},
      {4.718327337309688, 1.8719336589378437},    {5.394161641524038, 1.8644208507171156},
      {6.512284320396211, 1.621863586658351}};
  for (const auto& [points, alpha] : {std::pair{six, -3.7403269504460797}, std::pair{seven, -2.0}})
    expect_same_from_any_point(points, std::vector<double>(points.size(), alpha));
  expect_same_from_any_point(seven, {2, 2, -1, 0, 1, 0.5, -3});
}

// Chords and turns are the same from either end; only the end condition tells them apart.
TEST(Spline, OfSeveralTheConditionNamesOne) {
  std::vector<Point2> points{{0, 0}, {1, 0.2}, {2, 0}, {3, 0.2}, {4, 0}};
  SplineOptions options = with_slope(-1.5e-7);
  options.start.direction = -0.8962114658662337;
  const auto there = solve_spline(points, options);
  std::reverse(points.begin(), points.end());
  options.end.direction = *options.start.direction + core::kPi;
  options.start.direction.reset();
  const auto back = solve_spline(points, options);
  ASSERT_TRUE(there && back);
  EXPECT_NEAR(arc_length(there->chain), arc_length(back->chain), 1e-9);
}

TEST(Spline, SpansThatMustInflectGiveWay) {
  const std::vector<Point2> points{{0, 0}, {1, 0.5}, {2, 0.5}, {3, 0}, {4, 0}, {5, 0.8}};
  const auto s = solve_spline(points, with_slope(1));
  ASSERT_TRUE(s) << s.error().message;
  EXPECT_FALSE(s->overridden.empty());
  EXPECT_LT(s->overridden.size(), 5u);
  for (const std::size_t i : s->overridden) EXPECT_EQ(s->chain.pieces[i].alpha, -1);
  SplineOptions mixed;
  mixed.alpha = {0.5, 1, -2, -0.5, -1};
  const auto m = solve_spline(points, mixed);
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_LT(misses(*m, points), 1e-12);
}

// Curvature starts to the left and ends to the right: no slope from 0 on has that.
TEST(Spline, OneSpanThatMustInflectGivesWay) {
  const std::vector<Point2> points{{0, 0}, {1, 0}};
  for (const double alpha : {0.0, 1.0, 2.0}) {
    SplineOptions options = with_slope(alpha);
    options.start = {-0.4, 1.5};
    options.end = {-0.3, -0.8};
    const auto s = solve_spline(points, options);
    ASSERT_TRUE(s) << s.error().message;
    EXPECT_EQ(s->overridden, std::vector<std::size_t>{0});
    EXPECT_TRUE(validate(s->chain));
    EXPECT_LT(misses(*s, points), 1e-12);
    EXPECT_NEAR(end_pose(s->chain).direction, -0.3, 1e-12);
    EXPECT_EQ(s->chain.pieces.front().curvature_start, 1.5);
    EXPECT_EQ(s->chain.pieces.back().curvature_end, -0.8);
    for (const Piece& p : s->chain.pieces) EXPECT_EQ(p.alpha, -1);
  }
}

// Slope 2 does not reach all the way through these points: the one span gives way whose curvatures
// in the clothoid spline are most unlike each other.
TEST(Spline, TheSpanNearestToVanishingGivesWay) {
  struct Case {
    std::vector<Point2> points;
    bool closed;
  };
  for (const Case& c : {
           Case{{{1.07, 0}, {0.79, 0.54}, {0.39, 1.01}, {-0.23, 0.99}, {-0.8, 0.73}}, false},
           Case{{{1.04, 0}, {0.78, 0.53}, {0.38, 0.97}, {-0.21, 0.89}, {-0.74, 0.68}}, false},
           Case{{{1.04, 0},
                 {0.63, 0.79},
                 {-0.24, 1.06},
                 {-0.86, 0.41},
                 {-0.97, -0.47},
                 {-0.2, -0.86},
                 {0.64, -0.81}},
                true},
       }) {
    SplineOptions options;
    options.closed = c.closed;
    const auto clothoids = solve_spline(c.points, options);
    ASSERT_TRUE(clothoids);
    std::vector<double> unlike;
    for (const Piece& p : clothoids->chain.pieces) {
      ASSERT_GT(p.curvature_start * p.curvature_end, 0);
      unlike.push_back(std::abs(std::log(p.curvature_end / p.curvature_start)));
    }
    const auto most = std::max_element(unlike.begin(), unlike.end()) - unlike.begin();
    options.alpha = {2};
    const auto s = solve_spline(c.points, options);
    ASSERT_TRUE(s);
    EXPECT_EQ(s->overridden, std::vector{static_cast<std::size_t>(most)});
  }
}

TEST(Spline, EndConditionsHold) {
  const std::vector<Point2> points{{0, 0}, {1, 0.6}, {2, 0.7}, {3, 0}};
  SplineOptions options;
  options.start.direction = 1.2;
  options.end.curvature = -0.25;
  auto s = solve_spline(points, options);
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->chain.start.direction, 1.2, 1e-13);
  EXPECT_NEAR(s->chain.pieces.back().curvature_end, -0.25, 1e-13);
  options.start.curvature = 0.3;
  s = solve_spline(points, options);
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->chain.start.direction, 1.2, 1e-12);
  EXPECT_NEAR(s->chain.pieces.front().curvature_start, 0.3, 1e-13);
  EXPECT_EQ(largest_joint_gap(s->chain).curvature, 0);
}

TEST(Spline, IsNeverWild) {
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  int by_span = 0;
  for (int i = 0; i < 60; ++i) {
    std::vector<Point2> points;
    for (int k = 0; k < 8; ++k) points.push_back({4 * normal(random), 4 * normal(random)});
    SplineOptions options = with_slope(i % 3 == 0 ? 0.5 : -1.0);
    options.closed = i % 2 == 0;
    const auto s = solve_spline(points, options);
    if (!s) {
      EXPECT_EQ(s.error().code, ErrorCode::not_converged);
      ADD_FAILURE() << i << " " << s.error().message;
      continue;
    }
    by_span += s->span_by_span ? 1 : 0;
    EXPECT_LT(misses(*s, points), 1e-10);
    EXPECT_LT(largest_joint_gap(s->chain).curvature, 1e-12);
    for (const Piece& p : s->chain.pieces) EXPECT_LT(std::abs(total_turning(p)), 1.5 * core::kPi);
  }
  EXPECT_GT(by_span, 0);
}

// Next to slope 0 curvature changes its sign only in a needle, whose radius here would be 1e-7.
TEST(Spline, SpansWithANeedleGetAnotherSlope) {
  const std::vector<Point2> points{{0.33, 0.4}, {1.41, 0.56}, {2.58, 0.9}, {3.11, 0.23}};
  SplineOptions options;
  options.closed = true;
  for (const double slope : {-1e-5, -1e-6, -1e-8}) {
    options.alpha = {0, slope, -2.2, 0};
    const auto s = solve_spline(points, options);
    ASSERT_TRUE(s) << slope;
    double sharpest = 0;
    for (const Piece& p : s->chain.pieces)
      sharpest = std::max(sharpest, std::abs(p.curvature_start));
    EXPECT_LT(sharpest, 30) << slope << ": the points are a ring of two to three across";
    EXPECT_EQ(std::ranges::count(s->overridden, 1u), 1) << slope;
    EXPECT_LT(misses(*s, points), 1e-12) << slope;
  }
}

TEST(Spline, StraightDataGiveAStraightLine) {
  const std::vector<Point2> points{{0, 0}, {1, 1}, {3, 3}};
  const auto s = solve_spline(points, with_slope(2));
  ASSERT_TRUE(s);
  for (const Piece& p : s->chain.pieces) EXPECT_EQ(p.curvature_start, 0);
  EXPECT_EQ(solve_spline(std::vector<Point2>{{0, 0}, {2, 0}})->chain.pieces.size(), 1u);
}

TEST(Spline, RefusesBadInput) {
  const auto code = [](const std::vector<Point2>& points, const SplineOptions& options = {}) {
    return solve_spline(points, options).error().code;
  };
  EXPECT_EQ(code({}), ErrorCode::bad_input);
  EXPECT_EQ(code({{0, 0}}), ErrorCode::bad_input);
  EXPECT_EQ(solve_spline(std::vector<Point2>{{0, 0}, {1, 0}, {1, 0}}).error().path, "points[2]");
  EXPECT_EQ(code({{0, 0}, {std::nan(""), 0}}), ErrorCode::bad_input);
  SplineOptions options;
  options.alpha = {1, 2};
  EXPECT_EQ(code({{0, 0}, {1, 0}}, options), ErrorCode::bad_input);
  options.alpha = {std::nan("")};
  EXPECT_EQ(code({{0, 0}, {1, 0}}, options), ErrorCode::bad_input);
  options.alpha = {};
  options.closed = true;
  EXPECT_EQ(code({{0, 0}, {1, 0}}, options), ErrorCode::bad_input);
  options.start.direction = 1;
  EXPECT_EQ(code({{0, 0}, {1, 0}, {1, 1}}, options), ErrorCode::bad_input);
}

TEST(Spline, WorksAtExtremeScales) {
  for (const double scale : {1e-150, 1e150}) {
    std::vector<Point2> points{{0, 0}, {1, 0.6}, {2, -0.2}, {3.5, 0.6}};
    for (Point2& p : points) p = {p.x * scale, p.y * scale};
    const auto s = solve_spline(points);
    ASSERT_TRUE(s);
    EXPECT_LT(s->deviation, 1e-12 * scale);
  }
}

}  // namespace
}  // namespace keyline::lac
