#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/analysis/split.h"
#include "keyline/curve/bezier.h"

#include "spirals.h"

/// Where events stand and what is told of them, of curves whose curvature is a formula.
namespace keyline::analysis {
namespace {

using Kind = CurvatureEvent::Kind;

/// Curvature `before` up to s = 1 and `after` behind it, with a turn of the tangent there.
testing::SpiralCurve joined(double before, double after, double turn, core::Pose2 start = {}) {
  return testing::finish(
      {start,
       3,
       {0, 1.0 / 3, 1},
       [=](double s) { return s < 1 ? before : after; },
       [](double) { return 0.0; },
       [=](double s) { return s < 1 ? before * s : before + turn + after * (s - 1); }});
}

TEST(SplitEvents, CornersHaveTheirPlaceAndTheCurvatureBeforeThem) {
  const Split split = split_monotone(joined(1, 2, 0.3));
  ASSERT_EQ(split.corners.size(), 1U);
  const CurvatureEvent corner = split.corners[0];
  EXPECT_EQ(corner.kind, Kind::corner);
  EXPECT_NEAR(corner.t, 1.0 / 3, 1e-15);
  EXPECT_NEAR(corner.arc_length, 1, 1e-12);
  EXPECT_NEAR(corner.curvature, 1, 1e-12);
  ASSERT_EQ(split.pieces.size(), 2U);
  EXPECT_NEAR(split.pieces[0].arc_length.high, 1, 1e-12);
  EXPECT_NEAR(split.pieces[1].arc_length.low, 1, 1e-12);
  EXPECT_NEAR(split.pieces[1].arc_length.high, 3, 1e-12);
  EXPECT_NEAR(split.pieces[0].curvature_end, 1, 1e-12);
  EXPECT_NEAR(split.pieces[1].curvature_start, 2, 1e-12);
}

// From a ten-thousandth on; a tangent that passes half a turn does not jump by a whole one.
TEST(SplitEvents, CornersTurnByMoreThanATenThousandth) {
  EXPECT_EQ(split_monotone(joined(1, 2, 1.1e-4)).corners.size(), 1U);
  EXPECT_EQ(split_monotone(joined(1, 2, 0.9e-4)).corners.size(), 0U);
  EXPECT_EQ(split_monotone(joined(1, 2, -1.1e-4)).corners.size(), 1U);
  const core::Pose2 backwards{{}, core::kPi - 1 - 2e-5};
  EXPECT_EQ(split_monotone(joined(1, 2, 5e-5, backwards)).corners.size(), 0U);
}

// An arc between lines is one event, in its middle; of two arcs of one radius likewise.
TEST(SplitEvents, FlatOnesStandInTheMiddle) {
  for (const auto& c :
       {testing::arcs({0, 2, 0}, {1, 2, 4}), testing::arcs({0, 2, 2, 0}, {1, 1.25, 2, 4})}) {
    const Split split = split_monotone(c);
    ASSERT_EQ(split.extrema.size(), 1U);
    EXPECT_EQ(split.extrema[0].kind, Kind::maximum);
    EXPECT_NEAR(split.extrema[0].flat.low, 0.25, 1e-12);
    EXPECT_NEAR(split.extrema[0].flat.high, 0.5, 1e-12);
    EXPECT_NEAR(split.extrema[0].t, 0.375, 1e-12);
    EXPECT_NEAR(split.extrema[0].arc_length, 1.5, 1e-12);
    EXPECT_NEAR(split.extrema[0].curvature, 2, 1e-12);
    EXPECT_EQ(split.pieces.size(), 3U);
  }
  const Split line = split_monotone(testing::arcs({1, 0, -1}, {1, 2, 4}));
  ASSERT_EQ(line.inflections.size(), 1U);
  EXPECT_NEAR(line.inflections[0].flat.low, 0.25, 1e-12);
  EXPECT_NEAR(line.inflections[0].flat.high, 0.5, 1e-12);
  EXPECT_NEAR(line.inflections[0].t, 0.375, 1e-12);
  EXPECT_EQ(line.pieces.size(), 3U);
}

// A line ends where an arc starts, though curvature goes on growing; an arc where it starts to.
TEST(SplitEvents, LinesAndArcsEndWhereCurvatureFlowsOn) {
  const Split rising = split_monotone(testing::arcs({0, 1, 2}, {1, 2, 4}));
  ASSERT_EQ(rising.pieces.size(), 2U);
  EXPECT_NEAR(rising.pieces[0].t.high, 0.25, 1e-12);
  const Split falling = split_monotone(testing::arcs({2, 1, 0}, {1, 2, 4}));
  ASSERT_EQ(falling.pieces.size(), 2U);
  EXPECT_NEAR(falling.pieces[0].t.high, 0.5, 1e-12);
  for (const bool first : {true, false}) {
    const auto grown = [=](double s) { return std::max(0.0, first ? s - 1 : 2 - s); };
    const double sense = first ? 1 : -1;
    const auto area = [=](double s) { return sense * grown(s) * grown(s) / 2; };
    const Split split =
        split_monotone(testing::finish({{},
                                        3,
                                        {0, first ? 1.0 / 3 : 2.0 / 3, 1},
                                        [=](double s) { return 1 + grown(s); },
                                        [=](double s) { return grown(s) > 0 ? sense : 0.0; },
                                        [=](double s) { return s + area(s) - area(0); }}));
    ASSERT_EQ(split.pieces.size(), 2U);
    EXPECT_NEAR(split.pieces[0].t.high, first ? 1.0 / 3 : 2.0 / 3, 1e-12);
    EXPECT_TRUE(split.extrema.empty());
  }
}

TEST(SplitEvents, InflectionsHaveTheirArcLength) {
  const Split split = split_monotone(testing::clothoid(-1, 2.7, 2));
  ASSERT_EQ(split.inflections.size(), 1U);
  EXPECT_NEAR(split.inflections[0].t, 1 / 3.7, 1e-12);
  EXPECT_NEAR(split.inflections[0].arc_length, 2 / 3.7, 1e-12);
  EXPECT_EQ(split.inflections[0].curvature, 0);
}

// k = 2 + cos(2 pi s / 0.7): lowest at 0.35, highest at 0.7.
TEST(SplitEvents, ExtremaHaveTheirPlaceKindAndValue) {
  const Split split = split_monotone(testing::wavy(2, 2, 1, 0.7, 1));
  ASSERT_EQ(split.extrema.size(), 2U);
  for (const int i : {0, 1}) {
    EXPECT_EQ(split.extrema[i].kind, i == 0 ? Kind::minimum : Kind::maximum);
    EXPECT_NEAR(split.extrema[i].t, 0.35 * (i + 1), 1e-9);
    EXPECT_NEAR(split.extrema[i].arc_length, 0.35 * (i + 1), 1e-9);
    EXPECT_NEAR(split.extrema[i].curvature, 1 + 2 * i, 1e-12);
  }
}

// Curvature rises to 2, jumps down to 1.5 and falls, or jumps up to 2 and falls: the kink's height
// is that of the side that is higher.
TEST(SplitEvents, KinksAreAsHighAsTheHigherSide) {
  for (const bool before : {true, false}) {
    const double left = before ? 2 : 1.5, right = before ? 1.5 : 2;
    const auto rise = [=](double s) { return left * s - (s - s * s / 2) / 2; };
    const Split split = split_monotone(testing::finish(
        {{},
         3,
         {0, 1.0 / 3, 1},
         [=](double s) { return s < 1 ? left - (1 - s) / 2 : right - (s - 1) / 2; },
         [=](double s) { return s < 1 ? 0.5 : -0.5; },
         [=](double s) {
           return s < 1 ? rise(s) : rise(1) + right * (s - 1) - (s - 1) * (s - 1) / 4;
         }}));
    ASSERT_EQ(split.extrema.size(), 1U);
    EXPECT_EQ(split.extrema[0].kind, Kind::maximum);
    EXPECT_NEAR(split.extrema[0].t, 1.0 / 3, 1e-12);
    EXPECT_NEAR(split.extrema[0].arc_length, 1, 1e-12);
    EXPECT_NEAR(split.extrema[0].curvature, 2, 1e-12);
  }
}

// The parabola y = -x^2 up to just past its vertex, to which it is (2 sqrt 5 + asinh 2) / 4 long.
TEST(SplitEvents, LowestPlacesJustBeforeAnEndAreFoundToo) {
  const double x = 2e-4;
  const curve::Bezier2 parabola{{{-1, -1}, {(x - 1) / 2, x}, {x, -x * x}}, {}};
  const Split split = split_monotone(parabola);
  ASSERT_EQ(split.extrema.size(), 1U);
  EXPECT_EQ(split.extrema[0].kind, Kind::minimum);
  EXPECT_NEAR(split.extrema[0].t, 1 / (1 + x), 1e-9);
  EXPECT_NEAR(split.extrema[0].curvature, -2, 1e-12);
  EXPECT_NEAR(split.extrema[0].arc_length, (2 * std::sqrt(5.0) + std::asinh(2.0)) / 4, 1e-9);
}

// (t^2, t^3) has curvature 6 / (t (4 + 9 t^2)^1.5), which falls from infinity.
TEST(SplitEvents, CuspsAtAnEndAreNoTurns) {
  curve::Bezier2 cusp{{{0, 0}, {0, 0}, {1.0 / 3, 0}, {1, 1}}, {}};
  for (int way = 0; way < 2; ++way) {
    const Split split = split_monotone(cusp);
    EXPECT_EQ(split.pieces.size(), 1U);
    EXPECT_TRUE(split.extrema.empty());
    std::ranges::reverse(cusp.control);
  }
}

TEST(SplitEvents, StretchesGetSixteenSamples) {
  EXPECT_EQ(split_monotone(testing::wavy(2, 2, 1, 1.0 / 6, 1), {.samples = 4}).extrema.size(), 11U);
}

/// An arc, then curvature that swings about 0 by that height.
testing::SpiralCurve trembling(double arc, double half, double height) {
  return testing::finish(
      {{},
       2 * half,
       {0, 0.5, 1},
       [=](double s) { return s < half ? arc : height * std::cos(50 / half * s); },
       [=](double s) { return s < half ? 0.0 : -50 / half * height * std::sin(50 / half * s); },
       [=](double s) {
         const auto swung = [=](double at) {
           return height * half / 50 * std::sin(50 / half * at);
         };
         return s < half ? arc * s : arc * half + swung(s) - swung(half);
       }});
}

// Rounding is a billionth of the mean of |curvature|, however long the curve is.
TEST(SplitEvents, CurvatureOfRoundingHasNoSign) {
  EXPECT_TRUE(split_monotone(trembling(1000, 1, 1e-7)).inflections.empty());
  EXPECT_FALSE(split_monotone(trembling(1000, 1, 1e-5)).inflections.empty());
  EXPECT_FALSE(split_monotone(trembling(1, 50, 1e-8)).inflections.empty());
  EXPECT_TRUE(split_monotone(trembling(1, 50, 1e-10)).inflections.empty());
}

TEST(SplitEvents, MergedWavesAreInOrder) {
  const Split split = split_monotone(testing::wavy(1, 3, 0.5, 0.1, 1), {.noise = 1.5e-4});
  ASSERT_GE(split.merged.size(), 8U);
  EXPECT_TRUE(
      std::ranges::is_sorted(split.merged, {}, [](const MergedWave& w) { return w.t.low; }));
}

}  // namespace
}  // namespace keyline::analysis
