#include "keyline/analysis/split.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "keyline/analysis/fairness.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"
#include "keyline/curve/polyline.h"

#include "spirals.h"

namespace keyline::analysis {
namespace {

TEST(Split, SpiralIsOnePiece) {
  const Split split = split_monotone(testing::clothoid(0, 5, 1));
  ASSERT_EQ(split.pieces.size(), 1u);
  EXPECT_TRUE(split.extrema.empty() && split.inflections.empty() && split.merged.empty());
  EXPECT_NEAR(split.pieces[0].curvature_end, 5, 1e-9);
}

TEST(Split, ClothoidThroughItsInflection) {
  const Split split = split_monotone(testing::clothoid(-1, 3, 2));
  ASSERT_EQ(split.inflections.size(), 1u);
  EXPECT_NEAR(split.inflections[0].t, 0.25, 1e-12);
  EXPECT_EQ(split.pieces.size(), 2u);
  EXPECT_TRUE(split.extrema.empty());
}

TEST(Split, EllipseArcHasItsVertices) {
  // Quarters of an ellipse joined at its vertices would hide them at breakpoints: use a rotated
  // conic arc instead, whose vertex lies inside.
  const curve::Bezier2 parabola{{{-1, 1}, {0.5, -2}, {2, 4}}, {}};  // y = x^2 from -1 to 2
  const Split split = split_monotone(parabola);
  ASSERT_EQ(split.extrema.size(), 1u);
  EXPECT_EQ(split.extrema[0].kind, CurvatureEvent::Kind::maximum);
  EXPECT_NEAR(split.extrema[0].t, 1.0 / 3, 1e-9);
  EXPECT_NEAR(split.extrema[0].curvature, 2, 1e-12);
  EXPECT_EQ(split.pieces.size(), 2u);
}

/// A spline of degree 3 whose curvature turns inside a span and again at the kink of the knot next
/// to it: both places, and the same ones from the other end.
TEST(Split, TurnsNextToAKinkAreFoundFromEitherEnd) {
  curve::BSpline2 there{
      3,
      {0, 0, 0, 0, 0.5962453055163222, 1.356460181612206, 1.7729157962788988, 2.1850463566712754,
       2.688982523382092, 2.688982523382092, 2.688982523382092, 2.688982523382092},
      {{-1.4137639309245351, 26.54177824127498},
       {1.7820890299213659, 24.909341585091184},
       {1.284101282103654, 20.593115645893544},
       {5.6039322038391735, 21.887117488545854},
       {8.811642450916008, 18.163252968102572},
       {10.091800689149784, 14.596045024769348},
       {12.677649317217773, 14.816814987247424},
       {14.365168024118022, 14.340248607694898}},
      {}};
  curve::BSpline2 back = there;
  std::reverse(back.control.begin(), back.control.end());
  std::reverse(back.knots.begin(), back.knots.end());
  for (double& k : back.knots) k = there.knots.back() - k;
  const Split a = split_monotone(there), b = split_monotone(back);
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  for (std::size_t i = 0; i < a.pieces.size(); ++i)
    EXPECT_NEAR(a.pieces[i].t.low, 1 - b.pieces[b.pieces.size() - 1 - i].t.high, 1e-7);
}

/// Curvature of a spline of degree 5 turns a thousandth before a knot, between the knot and the
/// sample before it; place and value from its formula at steps of 5e-6.
TEST(Split, ATurnJustBeforeAKnotIsNotTakenForTheKnot) {
  const curve::BSpline2 spline{
      5,
      {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.29413349272321077, 0.4612177450961429, 0.5701197697922369,
       0.8948712708313568, 0.8948712708313568, 0.8948712708313568, 0.8948712708313568,
       0.8948712708313568, 0.8948712708313568},
      {{-1788.7944662098403, -1526.135230551938},
       {-1579.100089330436, -1579.054134233186},
       {-1326.825128423616, -1450.9185620468966},
       {-1359.7060577277064, -1113.5612515812613},
       {-1647.9519906763528, -1273.7029057629466},
       {-1705.2508640249062, -1772.542176605155},
       {-2235.522398011581, -1821.6402106403639},
       {-2697.9187193416815, -1898.3359223506448},
       {-2700.209991364338, -2221.8834810509697}},
      {}};
  const Split split = split_monotone(spline);
  ASSERT_EQ(split.extrema.size(), 3u);
  EXPECT_NEAR(split.extrema[0].t, 0.328235, 5e-6);
  EXPECT_NEAR(split.extrema[0].curvature, 0.0220218195, 1e-9);
}

/// The parabola y = x^2 up to just past its vertex, nearer to the end than any other sample.
TEST(Split, ATurnJustBeforeAnEndIsFound) {
  const double x = 2e-4;
  const curve::Bezier2 parabola{{{-1, 1}, {(x - 1) / 2, -x}, {x, x * x}}, {}};
  const Split split = split_monotone(parabola);
  ASSERT_EQ(split.extrema.size(), 1u);
  EXPECT_NEAR(split.extrema[0].t, 1 / (1 + x), 1e-9);
  EXPECT_NEAR(split.extrema[0].curvature, 2, 1e-12);
}

TEST(Split, SmallWavesAreMergedAndReported) {
  // Amplitude 0.5 at wavelength 0.1: the curve moves by 2 * 0.5 * 0.01 / (8 pi^2) = 1.27e-4.
  const auto c = testing::wavy(1, 3, 0.5, 0.1, 1);
  EXPECT_GT(split_monotone(c).pieces.size(), 15u);
  EXPECT_GT(split_monotone(c, {.noise = 1e-4}).pieces.size(), 10u);
  const Split split = split_monotone(c, {.noise = 1.5e-4});
  EXPECT_EQ(split.pieces.size(), 1u);
  ASSERT_GE(split.merged.size(), 8u);
  EXPECT_EQ(split.threshold, 1.5e-4);
  for (const MergedWave& w : split.merged) EXPECT_LE(w.displacement, 1.5e-4);
}

TEST(Split, ShortLobesOfTheOtherSignAreNoise) {
  // Curvature dips below zero for a short stretch in the middle only by the wave.
  const auto c = testing::wavy(-1, 1, 0.4, 0.2, 1);
  EXPECT_GT(split_monotone(c).inflections.size(), 1u);
  const Split split = split_monotone(c, {.noise = 1e-3});
  ASSERT_EQ(split.inflections.size(), 1u);
  EXPECT_NEAR(split.inflections[0].t, 0.5, 0.06);
}

TEST(Split, LineArcLineComesApart) {
  const Split split = split_monotone(testing::arcs({0, 2, 0}, {1, 2, 4}));
  ASSERT_EQ(split.pieces.size(), 3u);
  EXPECT_NEAR(split.pieces[1].t.low, 0.25, 1e-12);
  EXPECT_NEAR(split.pieces[1].t.high, 0.5, 1e-12);
  ASSERT_EQ(split.extrema.size(), 1u);
  EXPECT_NEAR(split.extrema[0].flat.low, 0.25, 1e-12);
}

TEST(Split, GrowingArcsStayTogether) {
  EXPECT_EQ(split_monotone(testing::arcs({1, 2, 3, 4}, {1, 2, 3, 4})).pieces.size(), 1u);
}

TEST(Split, ReversalMirrorsTheEvents) {
  const curve::Bezier2 c{{{0, 0}, {1, 3}, {2, -3}, {3, 1}}, {}};
  curve::Bezier2 back = c;
  std::ranges::reverse(back.control);
  const Split a = split_monotone(c);
  const Split b = split_monotone(back);
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  for (std::size_t i = 0; i < a.pieces.size(); ++i)
    EXPECT_NEAR(a.pieces[i].t.low, 1 - b.pieces[a.pieces.size() - 1 - i].t.high, 1e-9);
}

TEST(Split, CornersOfAPolyline) {
  const curve::Polyline2 zigzag{{{0, 0}, {1, 0}, {1, 1}}};
  const Split split = split_monotone(zigzag);
  EXPECT_EQ(split.corners.size(), 1u);
  EXPECT_EQ(split.pieces.size(), 2u);
}

TEST(Split, DegenerateCurvesAreOnePiece) {
  const curve::Bezier2 point{{{1, 1}, {1, 1}, {1, 1}, {1, 1}}, {}};
  EXPECT_EQ(split_monotone(point).pieces.size(), 1u);
  const curve::Bezier2 line{{{0, 0}, {1, 1}, {2, 2}, {3, 3}}, {}};
  EXPECT_EQ(split_monotone(line).pieces.size(), 1u);
}

// A curve that goes there and back on a line has no curvature anywhere, and corners stand at
// breakpoints alone: one piece.
TEST(Split, TurningRoundOnALineIsOnePiece) {
  const curve::Bezier2 there_and_back{{{0, 0}, {2, 0}, {-1, 0}, {1, 0}}, {}};
  const Split split = split_monotone(there_and_back);
  EXPECT_TRUE(split.corners.empty());
  EXPECT_EQ(split.pieces.size(), 1u);
}

TEST(Fairness, ClothoidEnergies) {
  const Fairness f = fairness(testing::clothoid(-1, 3, 2));
  EXPECT_NEAR(f.length, 2, 1e-12);
  EXPECT_NEAR(f.total_turning, 2, 1e-12);
  EXPECT_NEAR(f.absolute_turning, 2.5, 1e-4);
  EXPECT_NEAR(f.bending_energy, 2 * (9.0 - 3.0 + 1.0) / 3, 1e-12);
  EXPECT_NEAR(f.variation_energy, 8, 1e-12);
  EXPECT_EQ(f.inflections, 1);
  EXPECT_EQ(f.extrema, 0);
  EXPECT_NEAR(f.curvature_max, 3, 1e-9);
}

}  // namespace
}  // namespace keyline::analysis
