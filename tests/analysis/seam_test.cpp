#include "keyline/analysis/seam.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/analysis/analyze.h"
#include "keyline/curve/polyline.h"

#include "spirals.h"

namespace keyline::analysis {
namespace {

using std::numbers::pi;

template <curve::PlanarCurve C>
Split events_of(const C& c) {
  AnalyzeOptions options;
  options.one_end = 1e-6;
  const auto found = analyze(c, options);
  EXPECT_TRUE(found);
  return found ? found->split : Split{};
}

/// kappa(s) = 1 + a cos 2 s, once around from s = begin: every half turns by pi, so that it closes.
testing::SpiralCurve waved(double a, double begin) {
  return testing::finish(
      {{},
       2 * pi,
       {0, 1},
       [=](double s) { return 1 + a * std::cos(2 * (s + begin)); },
       [=](double s) { return -2 * a * std::sin(2 * (s + begin)); },
       [=](double s) { return s + a / 2 * (std::sin(2 * (s + begin)) - std::sin(2 * begin)); }});
}

/// Whether an event of that kind lies where the whole curve has it: at s, begun at `begin`.
bool has(const std::vector<CurvatureEvent>& events, CurvatureEvent::Kind kind, double s,
         double begin) {
  return std::ranges::any_of(events, [&](const CurvatureEvent& e) {
    return e.kind == kind && std::abs(std::remainder(e.arc_length + begin - s, 2 * pi)) < 1e-6;
  });
}

TEST(Seam, EventsAreTheSameWhereverACurveBegins) {
  using enum CurvatureEvent::Kind;
  for (const double begin : {0.0, pi / 3, 0.4, pi / 2, 2 * pi / 3, 2.0}) {
    SCOPED_TRACE(begin);
    const Split found = events_of(waved(2, begin));
    EXPECT_EQ(found.extrema.size(), 4U);
    for (const double s : {0.0, pi}) {
      EXPECT_TRUE(has(found.extrema, maximum, s, begin));
      EXPECT_TRUE(has(found.extrema, minimum, s + pi / 2, begin));
    }
    EXPECT_EQ(found.inflections.size(), 4U);
    for (const double s : {1.0, 2.0, 4.0, 5.0})  // cos 2 s = -1/2
      EXPECT_TRUE(has(found.inflections, inflection, s * pi / 3, begin));
    EXPECT_TRUE(found.corners.empty());
    EXPECT_TRUE(std::ranges::is_sorted(found.extrema, {}, &CurvatureEvent::t));
  }
}

// An oval of four arcs, begun in the middle of one and where two meet: each arc is an extremum.
TEST(Seam, AnArcOverItIsOneExtremum) {
  const double q = pi / 4;
  const auto middle =
      events_of(testing::arcs({1, 0.5, 1, 0.5, 1}, {q, 5 * q, 7 * q, 11 * q, 12 * q}));
  ASSERT_EQ(middle.extrema.size(), 4U);
  EXPECT_NEAR(std::remainder(middle.extrema.front().arc_length, 12 * q), 0, 1e-9);
  EXPECT_GT(middle.extrema.front().flat.low, middle.extrema.front().flat.high);
  const auto joint = events_of(testing::arcs({1, 0.5, 1, 0.5}, {2 * q, 6 * q, 8 * q, 12 * q}));
  ASSERT_EQ(joint.extrema.size(), 4U);
  EXPECT_NEAR(joint.extrema.front().arc_length, q, 1e-9);
  EXPECT_TRUE(events_of(testing::arcs({1}, {2 * pi})).extrema.empty());
}

// Curvature that rises on both sides of the start and falls there at once is largest before and
// least after it. (Where the ends lie is not asked.)
TEST(Seam, AJumpOfCurvatureIsAMaximumAndAMinimum) {
  const auto curve = testing::clothoid(0.5, 1.5, 2 * pi);
  Split split = split_monotone(curve);
  ASSERT_TRUE(split.extrema.empty());
  add_events_at_seam(view(curve), ArcLengthTable(view(curve)), {}, split);
  ASSERT_EQ(split.extrema.size(), 2U);
  EXPECT_EQ(split.extrema[0].kind, CurvatureEvent::Kind::maximum);
  EXPECT_NEAR(split.extrema[0].curvature, 1.5, 1e-9);
  EXPECT_NEAR(split.extrema[1].curvature, 0.5, 1e-9);
  EXPECT_EQ(split.pieces.size(), 1U);
}

TEST(Seam, ACornerThereIsOne) {
  const curve::Polyline2 square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
  const Split found = events_of(square);
  ASSERT_EQ(found.corners.size(), 4U);
  EXPECT_EQ(found.corners.front().t, 0);
  EXPECT_EQ(found.corners.front().arc_length, 0);
  EXPECT_EQ(events_of(curve::Polyline2{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}).corners.size(), 2U);
}

}  // namespace
}  // namespace keyline::analysis
