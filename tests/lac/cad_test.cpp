#include "keyline/lac/cad/cad.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "keyline/core/angle.h"
#include "keyline/curve/closest_point.h"
#include "keyline/curve/monotone.h"
#include "keyline/curve/piecewise_bezier.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;

template <class C>
double sampled_deviation(const C& c, const CadBeziers& b, int n = 60) {
  const curve::PiecewiseBezier path{b.pieces, 0};
  double largest = 0;
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    largest = std::max(largest, curve::closest_point(path, evaluate(c, t)).distance);
    largest = std::max(largest, curve::closest_point(c, evaluate(path, t)).distance);
  }
  return largest;
}

void expect_tangent_joints(const CadBeziers& b) {
  for (std::size_t i = 1; i < b.pieces.size(); ++i) {
    EXPECT_EQ(b.pieces[i - 1].control.back(), b.pieces[i].control.front());
    const double before = curve::tangent_angle(jet(b.pieces[i - 1], 1));
    const double after = curve::tangent_angle(jet(b.pieces[i], 0));
    EXPECT_NEAR(core::wrap_angle(after - before), 0, 1e-9);
  }
}

struct CadCase {
  const char* name;
  Segment segment;
  double tolerance;
  std::size_t most;  ///< pieces
};
const CadCase kCases[] = {
    {"involute", {{{1, 2}, 0.5}, 2, 1.5, 1, 0.5}, 1e-4, 1},
    {"involute, fine", {{{1, 2}, 0.5}, 2, 1.5, 1, 0.5}, 1e-6, 2},
    {"long involute", {{}, 2, 4, 2, 0.2}, 1e-4, 2},
    {"long involute, fine", {{}, 2, 4, 2, 0.2}, 1e-6, 5},
    {"clothoid", {{}, -1, 1, 0, 2}, 1e-4, 2},
    {"clothoid, fine", {{}, -1, 1, 0, 2}, 1e-6, 3},
    {"S", {{}, -1, 3, -1, 2}, 1e-4, 4},
    {"S of slope -0.6", {{}, -0.6, 3, -1, 1}, 1e-4, 6},
    {"Nielsen", {{}, 0, 2, -1, -0.4}, 1e-6, 2},
    {"cusp", {{}, 2, 1, std::numeric_limits<double>::infinity(), 1}, 1e-5, 12},
    {"half circle", {{}, -1, core::kPi, 1, 1}, 1e-4, 3},
    {"straight", {{{5, 5}, 1}, -1, 3, 0, 0}, 1e-6, 1},
};

TEST(Cad, CubicsAreFewAndWithinTheTolerance) {
  for (const CadCase& c : kCases) {
    SCOPED_TRACE(c.name);
    const auto b = to_beziers(c.segment, {3, c.tolerance, true});
    ASSERT_TRUE(b);
    EXPECT_LE(b->pieces.size(), c.most);
    EXPECT_LE(b->deviation, c.tolerance);
    EXPECT_LE(sampled_deviation(c.segment, *b), b->deviation * (1 + 1e-9) + 4e-15);
    expect_tangent_joints(*b);
    const bool arc = c.segment.curvature_start == c.segment.curvature_end;
    EXPECT_TRUE(arc || b->not_monotone == 0);
  }
}

// At these tolerances a cubic ends just short of the inflection: what is left is straight to 1e-8.
TEST(Cad, WhatIsLeftBeforeAnInflectionIsOneCubic) {
  const Segment s{{}, -1, 1, -1.6279995131375222, 1.302751163377154};
  for (const double tolerance : {2.67e-5, 2.6974134431317047e-5, 2.72e-5}) {
    const auto b = to_beziers(s, {3, tolerance});
    ASSERT_TRUE(b);
    EXPECT_LE(b->pieces.size(), 3u);
    EXPECT_LE(sampled_deviation(s, *b), tolerance);
  }
}

TEST(Cad, QuinticsNeedFewerPieces) {
  for (const CadCase& c : kCases) {
    SCOPED_TRACE(c.name);
    const auto b = to_beziers(c.segment, {5, 1e-8, true});
    ASSERT_TRUE(b);
    EXPECT_LE(b->deviation, 1e-8);
    EXPECT_LE(sampled_deviation(c.segment, *b, 20), b->deviation * (1 + 1e-9) + 4e-15);
    expect_tangent_joints(*b);
    const auto cubics = to_beziers(c.segment, {3, 1e-8, true});
    ASSERT_TRUE(cubics);
    EXPECT_LE(b->pieces.size(), cubics->pieces.size());
  }
}

// A cubic's error falls with the sixth power of its width, a quintic's with the tenth: no cubics
// under another name.
TEST(Cad, QuinticsOfGentleSegmentsAreFewer) {
  for (const double alpha : {-1.0, 0.0, 1.0, 2.0}) {
    const Segment s{{{1, 1}, 2}, alpha, 1, 0.7, 1.2};
    const auto quintics = to_beziers(s, {5, 1e-10, false});
    const auto cubics = to_beziers(s, {3, 1e-10, false});
    ASSERT_TRUE(quintics && cubics);
    EXPECT_LT(quintics->pieces.size(), cubics->pieces.size()) << alpha;
  }
}

TEST(Cad, BoundHoldsOnRandomSegments) {
  EXPECT_TRUE(rc::check([] {
    const double alpha = *rc::gen::inRange(-500, 501) / 100.0;
    const double q = *rc::gen::inRange(-200, 201) / 100.0;
    const double bend = *rc::gen::inRange(-200, 201) / 100.0;
    RC_PRE(bend != 0);
    const double tolerance = std::pow(10.0, -*rc::gen::inRange(2, 10));
    const Segment s{{{1, 1}, 2}, alpha, 1, bend, bend * std::exp(q)};
    const auto b = to_beziers(s, {3, tolerance, true});
    RC_ASSERT(b.has_value());
    RC_ASSERT(b->deviation <= tolerance);
    RC_ASSERT(sampled_deviation(s, *b, 12) <= b->deviation + 4e-15);
  }));
}

TEST(Cad, ScaleChangesNothing) {
  const Segment s{{}, -1, 1, 0.3, 2};
  const auto one = to_beziers(s, {3, 1e-6, true});
  const auto big = to_beziers(transform(s, {1e100, 0, {}}), {3, 1e94, true});
  ASSERT_TRUE(one && big);
  EXPECT_EQ(one->pieces.size(), big->pieces.size());
  EXPECT_NEAR(big->deviation / 1e100, one->deviation, 1e-3 * one->deviation);
}

TEST(Cad, ChainBecomesOneSpline) {
  const Chain chain{{{1, 1}, 0.2}, {{-1, 1, 0, 0.8}, {0, 0.8, 0.8, 1.2}, {-2, 2, 1.2, -1}}};
  const auto spline = to_bspline(chain, {3, 1e-5, true});
  ASSERT_TRUE(spline);
  EXPECT_EQ(spline->curve.degree, 3);
  EXPECT_LE(spline->deviation, 1e-5);
  for (int i = 0; i <= 50; ++i)
    EXPECT_LE(curve::closest_point(spline->curve, evaluate(chain, i / 50.0)).distance, 1e-5);
}

TEST(Cad, ArcsAndLinesAreExact) {
  const Chain chain{{{1, 1}, 0.2}, {{-1, 2, 0, 0}, {-1, 5, 0.9, 0.9}, {1, 1, -2, -2}}};
  const auto nurbs = exact_nurbs(chain);
  ASSERT_TRUE(nurbs);
  EXPECT_EQ(nurbs->degree, 2);
  for (int i = 0; i <= 60; ++i) {
    EXPECT_LT(curve::closest_point(*nurbs, evaluate(chain, i / 60.0)).distance, 1e-13);
    EXPECT_LT(curve::closest_point(chain, evaluate(*nurbs, i / 60.0)).distance, 1e-13);
  }
  const auto line = exact_nurbs(Segment{{}, -1, 2, 0, 0});
  ASSERT_TRUE(line);
  EXPECT_EQ(line->degree, 1);
  const auto refused = exact_nurbs(Segment{{}, -1, 2, 0, 1});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  EXPECT_EQ(refused.error().path, "pieces[0]");
}

TEST(Cad, RefusesBadRequests) {
  const Segment s{{}, -1, 1, 0, 1};
  const auto code = [&](const CadOptions& o) { return to_beziers(s, o).error().code; };
  EXPECT_EQ(code({4, 1e-3, true}), ErrorCode::bad_input);
  EXPECT_EQ(code({3, 0, true}), ErrorCode::bad_input);
  EXPECT_EQ(code({3, -1, true}), ErrorCode::bad_input);
  EXPECT_EQ(code({3, NAN, true}), ErrorCode::bad_input);
  EXPECT_EQ(code({3, 1e-15, true}), ErrorCode::not_converged);
  EXPECT_FALSE(to_beziers(Segment{{}, 1, 1, 0, 1}, {}));
}

// Next to a cusp no quintic of a usual handle meets the end curvature: cubics, raised, take over
// there. 57 of 1,200 random segments ended the process.
TEST(ToBeziers, QuinticsNextToACusp) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 12; ++n) {
    const double ratio = std::pow(10.0, 8 * unit(random));
    const double alpha = 1 + 2 * unit(random);
    Segment s{{}, alpha, 1, 1, 1 / ratio};
    const double turning = total_turning(s);
    const double wanted = 0.2 + 2.5 * unit(random);
    s.curvature_start *= wanted / turning;
    s.curvature_end *= wanted / turning;
    SCOPED_TRACE(testing::Message() << alpha << ' ' << s.curvature_start << ' ' << s.curvature_end);
    const CadOptions options{5, 1e-3, true};
    const auto beziers = to_beziers(s, options);
    ASSERT_TRUE(beziers) << beziers.error().message;
    for (const auto& b : beziers->pieces) EXPECT_EQ(b.control.size(), 6U);
    EXPECT_LE(beziers->deviation, 1e-3);
    EXPECT_LE(sampled_deviation(s, *beziers, 20), beziers->deviation);
  }
}

}  // namespace
}  // namespace keyline::lac
