#include "keyline/sketch/consolidate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/core/polygon.h"
#include "keyline/numeric/random.h"
#include "keyline/sketch/align_strokes.h"
#include "keyline/sketch/hold_line.h"
#include "keyline/sketch/pass_evidence.h"

namespace keyline::sketch {
namespace {

using core::Point2;

using Curve = std::function<Point2(double)>;

/// Part of a curve drawn beside it: off by `offset` along the normal, with a slow wobble.
DrawnStroke drawn(const Curve& curve, double from, double to, double offset, double phase) {
  DrawnStroke stroke;
  const int n = 240;
  for (int i = 0; i <= n; ++i) {
    const double t = from + (to - from) * i / n;
    const core::Vector2 d = curve(t + 1e-4) - curve(t - 1e-4);
    const double off = offset + 0.3 * std::sin(9 * t + phase);
    stroke.points.push_back(curve(t) + (off / core::norm(d)) * core::perpendicular_left(d));
  }
  return stroke;
}

/// Largest distance of the line's points from the curve.
double distance_from(const Curve& curve, const std::vector<Point2>& points, double from,
                     double to) {
  double worst = 0;
  for (const Point2 p : points) {
    double least = INFINITY;
    for (int i = 0; i <= 4000; ++i)
      least = std::min(least, core::distance(p, curve(from + (to - from) * i / 4000)));
    worst = std::max(worst, least);
  }
  return worst;
}

double length_of(const Curve& curve, double from, double to) {
  std::vector<Point2> points;
  for (int i = 0; i <= 4000; ++i) points.push_back(curve(from + (to - from) * i / 4000));
  return core::polygon_length(points);
}

// Windings closer to each other than the strip of strokes is wide.
TEST(Consolidate, SpiralsDrawnInAStripKeepTheirWindings) {
  const Curve spiral = [](double t) {
    const double r = 30 + 1.6 * t;
    return Point2{r * std::cos(t), r * std::sin(t)};
  };
  std::vector<DrawnStroke> strokes;
  for (int k = -3; k <= 3; ++k) {
    strokes.push_back(drawn(spiral, 0, 15, 2.0 * k, k));
    if (k % 2 == 0) std::reverse(strokes.back().points.begin(), strokes.back().points.end());
  }
  const auto lines = consolidate(strokes);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_FALSE(lines[0].closed);
  EXPECT_EQ(lines[0].members.size(), 7U);
  EXPECT_LT(distance_from(spiral, lines[0].points, -0.05, 15.05), 1);
  EXPECT_NEAR(core::polygon_length(lines[0].points), length_of(spiral, 0, 15),
              0.03 * length_of(spiral, 0, 15));
}

TEST(Consolidate, EightsCloseAndCrossThemselves) {
  const Curve eight = [](double t) {
    return Point2{60 * std::cos(t), 40 * std::sin(t) * std::cos(t)};
  };
  const double round = 2 * std::numbers::pi;
  const std::vector<DrawnStroke> strokes = {
      drawn(eight, 0.3, 0.3 + round, 1, 0), drawn(eight, 2, 2 + 1.05 * round, -1, 1),
      drawn(eight, 1, 1 + 0.6 * round, 1.5, 2), drawn(eight, 4, 4 + 0.5 * round, -1.5, 3)};
  const auto lines = consolidate(strokes);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_LT(distance_from(eight, lines[0].points, 0, round), 2);
  EXPECT_NEAR(core::polygon_length(lines[0].points, true), length_of(eight, 0, round),
              0.04 * length_of(eight, 0, round));
}

TEST(Consolidate, ShortStrokesBesideEachOtherAreNoLoop) {
  // hatching: two strokes, twelve pens long and two apart, were closed to a ring of a few pixels
  for (const double turn : {0.0, 0.6, 2.5}) {
    std::vector<DrawnStroke> strokes(2);
    for (int i = 0; i <= 24; ++i) {
      const core::Vector2 along = (2.0 * i) * core::unit_vector(turn);
      const core::Vector2 aside = 8 * core::perpendicular_left(core::unit_vector(turn));
      strokes[0].points.push_back(Point2{} + along);
      strokes[1].points.push_back(Point2{} + aside + along);
    }
    const auto lines = consolidate(strokes, {.width = 4, .measured = true});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_FALSE(lines[0].closed);
    EXPECT_GT(core::polygon_length(lines[0].points), 44);
  }
}

TEST(Consolidate, PiecesMakeOneLineWhateverTheirDirectionAndScale) {
  const Curve wave = [](double t) { return Point2{40 * t, 25 * std::sin(t)}; };
  for (const double scale : {1.0, 4.0, 0.25}) {
    SCOPED_TRACE(scale);
    std::vector<DrawnStroke> strokes = {drawn(wave, 0, 2.5, 1, 0), drawn(wave, 1.8, 4.6, -1, 1),
                                        drawn(wave, 4, 7, 0.5, 2), drawn(wave, 0.4, 3, -0.5, 3),
                                        drawn(wave, 5, 7, -1, 4)};
    std::reverse(strokes[1].points.begin(), strokes[1].points.end());
    for (DrawnStroke& s : strokes)
      for (Point2& p : s.points) p = {scale * p.x, scale * p.y};
    const auto lines = consolidate(strokes);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_FALSE(lines[0].closed);
    std::vector<Point2> back;
    for (const Point2 p : lines[0].points) back.push_back({p.x / scale, p.y / scale});
    EXPECT_LT(distance_from(wave, back, 0, 7), 2);  // strokes lie up to 1.3 off, ends overshoot
    EXPECT_NEAR(core::polygon_length(back), length_of(wave, 0, 7), 8);
  }
}

// Lines that leave a shared stretch are lines of their own, none is lost.
TEST(Consolidate, BranchesStayLines) {
  const Curve main = [](double t) { return Point2{100 * t, 0}; };
  const Curve branch = [](double t) { return Point2{100 * t, t < 1 ? 0 : 60 * (t - 1) * (t - 1)}; };
  std::vector<DrawnStroke> strokes;
  for (int k = 0; k < 4; ++k) {
    strokes.push_back(drawn(main, 0, 4, 0.6 * k - 1, k));
    strokes.push_back(drawn(branch, 0.6, 3, 0.6 * k - 1, k + 0.5));
  }
  const auto lines = consolidate(strokes);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].members, (std::vector<std::size_t>{0, 2, 4, 6}));
  EXPECT_EQ(lines[1].members, (std::vector<std::size_t>{1, 3, 5, 7}));
}

/// What speaks for two strokes being passes of one line, of a pen 2 wide.
double evidence_between(const std::vector<Point2>& one, const std::vector<Point2>& other) {
  const PassModel model{.width = 2};
  const std::vector<SampledStroke> strokes{sample_stroke(one, false, 2),
                                           sample_stroke(other, false, 2)};
  const PassEvidence evidence = pass_evidence(strokes, {model, model, {INFINITY, INFINITY}});
  const auto found = evidence[0].find(1);
  return found == evidence[0].end() ? 0 : found->second;
}

// A bottle's band nestles against its side and leaves it at right angles: while both go on, that
// speaks for nothing. A pass that hooks off at its end is one of the line, and where the side ends
// the band goes on with it.
TEST(Consolidate, WhatNestlesAgainstALineIsNoPassOfIt) {
  const auto side = [](double length) {
    std::vector<Point2> points;
    for (int x = 0; x <= length; ++x) points.push_back({1.0 * x, 0});
    return points;
  };
  const auto band = [](double beside, double across) {  // from x = 200 - beside on, off at x = 200
    std::vector<Point2> points;
    for (int x = 0; x <= beside; ++x) points.push_back({200 - beside + x, 1});
    for (int y = 1; y <= across; ++y) points.push_back({200, 1.0 + y});
    return points;
  };
  EXPECT_LE(evidence_between(side(400), band(30, 150)), 0);
  EXPECT_GT(evidence_between(side(400), band(150, 30)), 5);
  EXPECT_GT(evidence_between(side(202), band(30, 150)), 0);
  EXPECT_GT(evidence_between(side(400), band(30, 0)), 0);
}

// Two passes far apart make one line, which goes with one of them and not between.
TEST(Consolidate, LinesOfWidePassesLieOnAStroke) {
  const Curve arc = [](double t) { return Point2{150 * std::cos(t), 150 * std::sin(t)}; };
  std::vector<DrawnStroke> strokes;
  for (const double off : {-5.0, 5.0}) strokes.push_back(drawn(arc, 0, 2.5, off, off));
  const auto lines = consolidate(strokes);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].explained, 2 * 150 * 2.5, 30);
  std::vector<SampledStroke> sampled;
  for (const DrawnStroke& s : strokes) sampled.push_back(sample_stroke(s.points, false, 0.5));
  EXPECT_EQ(share_off(lines[0].points, false, sampled, 1.5), 0);
}

// Two rims run beside each other for a little more than half of the way, then one goes elsewhere:
// what is drawn there is not lost, and the other one's line is not drawn towards it.
TEST(Consolidate, ARimThatGoesElsewhereIsNotLost) {
  const Curve one = [](double t) { return Point2{t, 0}; };
  const Curve other = [](double t) {
    const double turn = std::max(0.0, t - 110) / 60;
    return Point2{std::min(t, 110.0) + 60 * std::sin(turn), 2.5 + 60 * (1 - std::cos(turn))};
  };
  const std::vector<DrawnStroke> rims{drawn(one, 0, 200, 0, 0), drawn(other, 0, 200, 0, 1)};
  const auto lines = consolidate(rims, {.width = 1, .measured = true, .apart = 3.5, .hand = 0});
  std::vector<SampledStroke> found;
  for (const MeantLine& line : lines) found.push_back(sample_stroke(line.points, line.closed, 0.5));
  for (const DrawnStroke& rim : rims) EXPECT_EQ(share_off(rim.points, false, found, 1), 0);
}

// A second stroke runs beside the first half of a wavy one: the waves of its second half stay.
TEST(Consolidate, WhatOneStrokeDrewAloneStaysAsItIs) {
  const Curve wavy = [](double t) {
    return Point2{t, t < 100 ? 0 : 3 * std::sin((t - 100) / 1.5)};
  };
  const Curve beside = [](double t) { return Point2{t, 1}; };
  const DrawnStroke whole = drawn(wavy, 0, 200, 0, 0);
  const auto lines = consolidate({whole, drawn(beside, 0, 90, 0, 1)},
                                 {.width = 1, .measured = true, .apart = 3.5, .hand = 0});
  ASSERT_EQ(lines.size(), 1U);
  const SampledStroke line = sample_stroke(lines[0].points, lines[0].closed, 0.5);
  const std::vector<Point2> alone(whole.points.begin() + 130, whole.points.end());
  EXPECT_EQ(share_off(alone, false, {line}, 0.5), 0);
  EXPECT_EQ(share_off(line.points, false, {sample_stroke(whole.points, false, 0.5)}, 1.5), 0);
}

// Two rails closer than the pen of a rough drawing would allow are two lines; so are a stem and
// the line it ends at, and lines that cross.
TEST(Consolidate, NeighboursStemsAndCrossingsStayApart) {
  const Curve rail = [](double t) { return Point2{100 * t, 0}; };
  const Curve other = [](double t) { return Point2{100 * t, 9}; };
  const Curve stem = [](double t) { return Point2{50, -60 * t}; };
  const Curve steep = [](double t) { return Point2{100 * t, 70 * t - 30}; };
  std::vector<DrawnStroke> strokes;
  for (int k = 0; k < 3; ++k)
    for (const Curve& curve : {rail, other, stem, steep})
      strokes.push_back(drawn(curve, 0, 1, 0.8 * k - 0.8, k));
  const auto lines = consolidate(strokes);
  ASSERT_EQ(lines.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(lines[i].members, (std::vector<std::size_t>{i, i + 4, i + 8}));
}

/// Largest turn between neighbouring edges of a line, its ends left out.
double sharpest(const MeantLine& line) {
  double most = 0;
  const std::vector<Point2>& p = line.points;
  for (std::size_t i = 2; i + 2 < p.size(); ++i)
    most = std::max(most, std::abs(core::angle_between(p[i] - p[i - 1], p[i + 1] - p[i])));
  return most;
}

// One stroke ends beside the next, too far off to keep to both: a step turned by a right angle.
TEST(Consolidate, ALineGoesOverGentlyFromStrokeToStroke) {
  const Curve arc = [](double t) { return Point2{200 * std::cos(t), 200 * std::sin(t)}; };
  const auto lines =
      consolidate({drawn(arc, 0, 1.2, 1.8, 0), drawn(arc, 1, 2.4, -1.8, 1)},
                  {.width = 1, .measured = true, .apart = 4, .wishes = {{}, {{0, 1}}, {}}});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_LT(sharpest(lines[0]), 0.2);
}

TEST(ShareOff, CountsWhatLiesOnPaper) {
  const SampledStroke stroke = sample_stroke({{0, 0}, {60, 0}}, false, 1);
  std::vector<Point2> line;
  for (int i = 0; i <= 100; ++i) line.push_back({static_cast<double>(i), i < 50 ? 1.4 : 1.6});
  EXPECT_NEAR(share_off(line, false, {stroke}, 1.5), 0.5, 0.011);
  EXPECT_EQ(share_off({{10, 1}, {20, -1}}, false, {stroke}, 1.5), 0);
}

TEST(Align, FollowsTheOrderOfAStroke) {
  const Curve loop = [](double t) {
    return Point2{50 * t - 60 * std::sin(t), -60 * std::cos(t)};  // crosses itself
  };
  const DrawnStroke whole = drawn(loop, 0, 12, 0, 0);
  const SampledStroke line = sample_stroke(whole.points, false, 2);
  DrawnStroke part = drawn(loop, 3, 10, 3, 1);
  std::reverse(part.points.begin(), part.points.end());
  const SampledStroke stroke = sample_stroke(part.points, false, 2);
  const Alignment a = align(stroke, line, 8);
  EXPECT_TRUE(a.reversed);
  ASSERT_EQ(a.at.size(), stroke.points.size());
  for (std::size_t i = 0; i < a.at.size(); ++i) {
    ASSERT_GE(a.at[i], 0);
    EXPECT_GE(a.at[i], a.at[i == 0 ? 0 : i - 1]);
    EXPECT_LT(core::distance(stroke.points[a.at.size() - 1 - i],
                             line.points[static_cast<std::size_t>(a.at[i])]),
              6);
  }
}

// A pass that leaves its line sideways lies beside it until then; laid the other way round, its
// start would go on from the line's start, and the line there and back.
TEST(Align, LaysAStrokeThatLeavesTheLineAlongIt) {
  DrawnStroke line{{}, false};
  DrawnStroke leaves{{}, false};
  for (int x = 0; x <= 200; ++x) line.points.push_back({1.0 * x, 0});
  for (int x = 0; x <= 140; ++x) leaves.points.push_back({1.0 * x, 3});
  for (int y = 1; y <= 60; ++y) leaves.points.push_back({140, 3.0 + y});
  const Alignment a =
      align(sample_stroke(leaves.points, false, 2), sample_stroke(line.points, false, 2), 5);
  EXPECT_FALSE(a.reversed);
  for (std::size_t i = 0; i < 65; ++i) ASSERT_NEAR(a.at[i], static_cast<double>(i), 3) << i;
  DrawnStroke again = line;
  for (Point2& p : again.points) p.y = 1;
  const auto lines = consolidate({line, again, leaves}, {.width = 2, .measured = true, .hand = 0});
  ASSERT_EQ(lines.size(), 1U);
  const std::vector<Point2>& p = lines[0].points;
  for (std::size_t i = 2; i < p.size(); ++i)  // there and not back
    ASSERT_GT(dot(p[i] - p[i - 1], p[1] - p[0]), 0) << i;
}

}  // namespace
}  // namespace keyline::sketch
