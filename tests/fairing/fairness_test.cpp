#include "keyline/fairing/fairness.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/fair.h"

namespace keyline::fairing {
namespace {

/// The loop of Descartes' folium, by the angle from 0 to a right one; both ends are its node, where
/// they meet at a right angle.
core::Point2 on_folium(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double radius = 3 * s * c / (s * s * s + c * c * c);
  return {radius * c, radius * s};
}

constexpr double kRight = std::numbers::pi / 2;

acquire::KeyLine folium(int count, int corner) {
  acquire::KeyLine line;
  line.closed = true;
  line.corners = {static_cast<std::size_t>(corner)};
  for (int i = 0; i < count; ++i)
    line.points.push_back(on_folium(kRight * ((i - corner + count) % count) / count));
  for (int i = 0; i < count; ++i)
    line.length += core::distance(line.points[i], line.points[(i + 1) % count]);
  return line;
}

/// L^3 times the integral of (d curvature / ds)^2 of the loop, by differences of its closed form.
double variation_of_folium() {
  constexpr int n = 4000;
  const double h = kRight / n;
  std::vector<double> curvature;
  std::vector<double> at{0};
  for (int i = 1; i < n; ++i) {
    const core::Point2 a = on_folium(h * (i - 1));
    const core::Point2 b = on_folium(h * i);
    const core::Point2 c = on_folium(h * (i + 1));
    const double sides = core::distance(a, b) * core::distance(b, c) * core::distance(a, c);
    curvature.push_back(2 * core::cross(b - a, c - a) / sides);  // of the circle through three
    at.push_back(at.back() + core::distance(b, c));
  }
  double sum = 0;
  for (int i = 1; i + 1 < n; ++i)
    sum += std::pow(curvature[i] - curvature[i - 1], 2) / (at[i + 1] - at[i]);
  return sum * std::pow(at.back(), 3);
}

// A spline that is closed through the corner has to round it within the tolerance, with a spike of
// curvature that no answer with a corner would be worse than.
TEST(FairFigures, TheSplineToCompareWithStaysOpenAtACorner) {
  for (const int corner : {0, 37}) {
    SCOPED_TRACE(corner);
    const acquire::KeyLine line = folium(120, corner);
    FairResult answer;  // any open chain: only that it is open counts
    answer.curves.emplace_back(lac::Chain{.start = {}, .pieces = {{-1, line.length, 0.1, 0.2}}});
    answer.closed = true;
    answer.tolerance = 1e-4 * line.length;
    const FairFigures figures = fair_figures(line, answer);
    ASSERT_TRUE(figures.smoothing_spline);
    EXPECT_LE(figures.smoothing_spline->energy, 1.2 * variation_of_folium());
    EXPECT_GE(figures.smoothing_spline->energy, 0.5 * variation_of_folium());
  }
}

/// An outline of three bulges in whole three-hundredths.
acquire::KeyLine bulges(int count) {
  acquire::KeyLine line;
  line.closed = true;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    const double radius = 1 + 0.3 * std::cos(3 * angle);
    line.points.push_back({std::round(300 * 1.5 * radius * std::cos(angle)) / 300,
                           std::round(300 * radius * std::sin(angle)) / 300});
  }
  for (int i = 0; i < count; ++i)
    line.length += core::distance(line.points[i], line.points[(i + 1) % count]);
  return line;
}

// With two even knots to a point it had 17 waves. FITPACK's (scipy's splprep, k = 5, the largest
// smoothing within the tolerance, and the comb as bench/fairness/comb.py reads it) has 5.
TEST(FairFigures, TheSplineToCompareWithIsAsCalmAsFitpacks) {
  const acquire::KeyLine line = bulges(100);
  FairResult answer;
  answer.curves.emplace_back(
      lac::Chain{.start = {}, .pieces = {{-1, line.length, 0.1, 0.2}}, .closed = true});
  answer.closed = true;
  answer.tolerance = 1.0 / 300;
  const FairFigures figures = fair_figures(line, answer);
  ASSERT_TRUE(figures.smoothing_spline);
  EXPECT_EQ(figures.smoothing_spline->waves, 5);
  EXPECT_NEAR(figures.smoothing_spline->energy, 3.255e5, 0.1 * 3.255e5);
  EXPECT_NEAR(figures.smoothing_spline->jolt, 0.179, 0.15 * 0.179);
}

/// The loop and, from its node on, a parabola y = x^2 / 2 from 0 to 1, whose curvature is
/// (1 + x^2)^(-3/2): along it |d curvature / ds| = 3 x / (1 + x^2)^3.
acquire::KeyLine folium_and_parabola() {
  acquire::KeyLine line = folium(120, 0);
  line.closed = false;
  line.corners = {120};
  for (int i = 0; i <= 60; ++i) line.points.push_back({i / 60.0, i * i / 7200.0});
  return line;
}

double variation_of_parabola() {
  constexpr int n = 4000;
  double sum = 0, length = 0;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n;
    const double slope = 1 + x * x;
    sum += std::pow(3 * x / std::pow(slope, 3), 2) * std::sqrt(slope) / n;
    length += std::sqrt(slope) / n;
  }
  return sum * std::pow(length, 3);
}

// Held together, what the parabola's chain has too much would be nothing beside the loop.
TEST(FairFigures, EveryMemberIsHeldAgainstItsOwnRival) {
  const acquire::KeyLine line = folium_and_parabola();
  const auto beside = [&](double rise) {
    FairResult answer;
    answer.tolerance = 1e-5;
    answer.curves.emplace_back(lac::Chain{.start = {}, .pieces = {{-1, 4, 0.1, 0.2}}});
    answer.curves.emplace_back(lac::Chain{.start = {}, .pieces = {{-1, 1, 0.1, 0.1 + rise}}});
    return fair_figures(line, answer);
  };
  const FairFigures calm = beside(0.5);
  ASSERT_EQ(calm.rivals.size(), 2U);
  EXPECT_NEAR(calm.rivals[1].energy, variation_of_parabola(), 0.2 * variation_of_parabola());
  ASSERT_TRUE(calm.smoothing_spline);
  EXPECT_GT(calm.smoothing_spline->energy, 10 * variation_of_parabola());
  EXPECT_TRUE(calm.fair);
  const FairFigures wild = beside(std::sqrt(3 * variation_of_parabola()));
  EXPECT_LT(wild.answer.energy, wild.smoothing_spline->energy);
  EXPECT_EQ(wild.unfair, 1U);
  EXPECT_NEAR(wild.times, 3, 0.5);
  EXPECT_FALSE(wild.fair);
}

/// y = height x^2 from 0 to 1.
curve::BSpline2 parabola(double height) {
  curve::BSpline2 spline;
  spline.degree = 2;
  spline.knots = {0, 0, 0, 1, 1, 1};
  spline.control = {{0, 0}, {0.5, 0}, {1, height}};
  return spline;
}

// Only a region was faired, in place of the parabola that folium_and_parabola has: the bend outside
// it, with far more variation, is nobody's doing.
TEST(FairFigures, PartsKeptAsGivenAreNotJudged) {
  const auto beside = [&](double rise) {
    FairResult answer;
    answer.tolerance = 1e-5;
    answer.splines = {parabola(0.5)};
    answer.curves.emplace_back(parabola(10));
    answer.curves.emplace_back(lac::Chain{.start = {}, .pieces = {{-1, 1, 0.1, 0.1 + rise}}});
    answer.curves.emplace_back(parabola(10));
    return fair_figures({}, answer);
  };
  const FairFigures calm = beside(0.5);
  EXPECT_NEAR(calm.answer.energy, 0.25, 1e-3);
  EXPECT_NEAR(calm.rival().energy, variation_of_parabola(), 0.01 * variation_of_parabola());
  EXPECT_TRUE(calm.fair);
  const FairFigures wild = beside(std::sqrt(3 * variation_of_parabola()));
  EXPECT_EQ(wild.unfair, 1U);
  EXPECT_NEAR(wild.times, 3, 0.5);
  // Too little variation to be seen, which the rival has none of.
  FairResult arc;
  arc.tolerance = 0.01;
  arc.splines = {parabola(0)};
  arc.curves.emplace_back(parabola(10));
  arc.curves.emplace_back(lac::Chain{.start = {}, .pieces = {{-1, 2, 0.1, 0.1 + 0.9 * 0.008}}});
  EXPECT_TRUE(fair_figures({}, arc).fair);
}

// A chain of length 2 departs from an arc by a tenth of a tolerance of 0.01 where its curvature
// changes by 32 * 0.001 / 2^2.
TEST(FairFigures, WhatIsAnArcToTheEyeIsCalm) {
  FairFigures before;
  before.rivals = {analysis::CombFigures{0, 1e-9, 0.005}};
  const auto beside = [&](double rise) {
    FairResult answer;
    answer.tolerance = 0.01;
    answer.curves.emplace_back(lac::Chain{.start = {}, .pieces = {{-1, 2, 0.1, 0.1 + rise}}});
    return fair_figures({}, answer, &before).fair;
  };
  EXPECT_TRUE(beside(0.99 * 0.008));
  EXPECT_FALSE(beside(1.01 * 0.008));
}

/// A clothoid from 0.1 to 0.5 along 2: its energy is 0.4^2 * 2^2, its comb a straight line.
FairResult one_clothoid() {
  FairResult answer;
  answer.curves.emplace_back(lac::Chain{.start = {}, .pieces = {{-1, 2, 0.1, 0.5}}});
  return answer;
}

// No more waves than the other's, at most half as much energy and jolt again.
TEST(FairFigures, FairIsNearlyAsCalmAsWhatItIsHeldAgainst) {
  FairFigures any;
  any.smoothing_spline = analysis::CombFigures{};
  const double energy = 0.64, jolt = fair_figures({}, one_clothoid(), &any).answer.jolt;
  EXPECT_GT(jolt, 0);
  const auto fair_beside = [&](int waves, double rival_energy, double rival_jolt) {
    FairFigures before;
    before.smoothing_spline = analysis::CombFigures{waves, rival_energy, rival_jolt};
    const FairFigures found = fair_figures({}, one_clothoid(), &before);
    EXPECT_NEAR(found.answer.energy, energy, 1e-3);
    EXPECT_EQ(found.answer.waves, 0);
    return found.fair;
  };
  EXPECT_TRUE(fair_beside(0, energy, jolt));
  EXPECT_TRUE(fair_beside(0, energy / 1.49, jolt));
  EXPECT_FALSE(fair_beside(0, energy / 1.51, jolt));
  EXPECT_TRUE(fair_beside(0, energy, jolt / 1.49));
  EXPECT_FALSE(fair_beside(0, energy, jolt / 1.51));
  EXPECT_FALSE(fair_beside(-1, energy, jolt));
  EXPECT_TRUE(fair_beside(5, energy, jolt));
  // Without variation nothing is calmer.
  FairResult arc;
  arc.curves.emplace_back(lac::Chain{.start = {}, .pieces = {{-1, 2, 0.1, 0.1}}});
  const FairFigures none;
  EXPECT_TRUE(fair_figures({}, arc, &none).fair);
  EXPECT_FALSE(fair_figures({}, one_clothoid(), &none).fair);
}

// Of several members waves add up; of energy and jolt the worst counts.
TEST(FairFigures, AreOfAllMembers) {
  FairResult answer = one_clothoid();
  const lac::Chain wave{.start = {}, .pieces = {{-1, 1, 0.1, 0.3}, {-1, 1, 0.3, 0.1}}};
  answer.curves.emplace_back(wave);
  answer.curves.emplace_back(wave);
  const FairFigures any;
  const FairFigures found = fair_figures({}, answer, &any);
  EXPECT_EQ(found.answer.waves, 2);
  EXPECT_NEAR(found.answer.energy, 0.64, 1e-3);
  FairResult other;
  other.curves = {answer.curves[1], answer.curves[0]};
  EXPECT_NEAR(fair_figures({}, other, &any).answer.energy, 0.64, 1e-3);
}

// A step of curvature within 0.02 of a length of 10: it is marked where it is, behind what lies
// before its chain.
TEST(CombMarks, AreByTheLengthOfTheWhole) {
  const lac::Chain step{.start = {},
                        .pieces = {{-1, 4, 0.1, 0.1}, {-1, 0.02, 0.1, 0.5}, {-1, 5.98, 0.5, 0.5}}};
  curve::BSpline2 spline;  // along x, 3 long
  spline.knots = {0, 0, 0, 0, 1, 1, 1, 1};
  spline.control = {{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  FairResult result;
  result.curves = {FairCurve{step}, FairCurve{spline}, FairCurve{step}};
  const auto marks = comb_marks(result);
  ASSERT_EQ(marks.size(), 2U);
  EXPECT_NEAR(marks[0].at, 4.01, 0.02);
  EXPECT_NEAR(marks[1].at, 10 + 3 + 4.01, 0.02);
  EXPECT_FALSE(marks[0].needle);
}

}  // namespace
}  // namespace keyline::fairing
