#include "keyline/fairing/stretches.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/fairing/fair.h"

#include "truth.h"

namespace keyline::fairing {
namespace {

constexpr double kExact = 2e-7;

/// Places along arcs (curvature, length) that follow each other with one tangent.
std::vector<core::Point2> along_arcs(const std::vector<std::pair<double, double>>& arcs,
                                     int count) {
  double whole = 0;
  for (const auto& [curvature, length] : arcs) whole += length;
  std::vector<core::Point2> places;
  for (int i = 0; i < count; ++i) {
    double left = whole * i / (count - 1);
    core::Pose2 at{{0, 0}, 0.3};
    for (const auto& [curvature, length] : arcs) {
      const double s = std::min(left, length);
      const double turn = curvature * s;
      const double chord = curvature == 0 ? s : 2 * std::sin(turn / 2) / curvature;
      at.position = at.position + chord * core::unit_vector(at.direction + turn / 2);
      at.direction += turn;
      left -= s;
    }
    places.push_back(at.position);
  }
  return places;
}

std::vector<FitPoint> as_fit_points(const std::vector<core::Point2>& places) {
  double length = 0;
  for (std::size_t i = 1; i < places.size(); ++i)
    length += core::distance(places[i - 1], places[i]);
  std::vector<FitPoint> points;
  for (const core::Point2 p : places) points.push_back({.position = {p.x / length, p.y / length}});
  return points;
}

acquire::KeyLine drawn_line(const std::vector<core::Point2>& places) {
  acquire::KeyLine line;
  line.points = places;
  for (std::size_t i = 1; i < places.size(); ++i)
    line.length += core::distance(places[i - 1], places[i]);
  return line;
}

TEST(Stretches, OfArcsThatStepInCurvatureAreNoExactChain) {
  for (const auto& arcs : {std::vector<std::pair<double, double>>{{1, 1.4}, {2.5, 0.8}},
                           {{0, 1}, {-1.5, 1}, {0, 0.7}},
                           {{1, 1}, {1.1, 1}}})
    EXPECT_FALSE(detail::may_be_exact(as_fit_points(along_arcs(arcs, 400)), false, kExact));
}

TEST(Stretches, OfChainsWithoutStepsMayBeExact) {
  for (const int seed : {1, 2, 4, 7, 9}) {
    SCOPED_TRACE(seed);
    const auto places = testing::measure(testing::random_chain(seed), 400, 0, 1);
    EXPECT_TRUE(detail::may_be_exact(as_fit_points(places), false, kExact));
  }
  EXPECT_TRUE(detail::may_be_exact(as_fit_points(along_arcs({{1, 2}}, 400)), false, kExact));
}

TEST(Stretches, OnePieceIsFoundHoweverFarItTurns) {
  for (const double turn : {0.5, 3.0, 5.5}) {
    const auto points = as_fit_points(along_arcs({{turn, 1}}, 300));
    const auto chain = detail::one_exact_piece(points, false, kExact);
    ASSERT_TRUE(chain) << turn;
    EXPECT_NEAR(chain->pieces[0].length, 1, 2e-5);  // chords are shorter
    EXPECT_NEAR(chain->joints[0].curvature, turn, 1e-4);
    EXPECT_NEAR(chain->joints[1].curvature, turn, 1e-4);
  }
  auto circle = as_fit_points(along_arcs({{2 * core::kPi, 1}}, 301));
  circle.pop_back();
  const auto closed = detail::one_exact_piece(circle, true, kExact);
  ASSERT_TRUE(closed);
  EXPECT_TRUE(closed->closed);
  EXPECT_EQ(closed->feet.size(), circle.size());
  EXPECT_NEAR(closed->turning, 2 * core::kPi, 1e-15);
  EXPECT_FALSE(
      detail::one_exact_piece(as_fit_points(along_arcs({{1, 1}, {1.1, 1}}, 300)), false, kExact));
}

// What bridges a step of curvature within rounding is a needle of the comb, a few spacings long.
TEST(Stretches, ArcsThatStepInCurvatureAreFairedWithoutNeedles) {
  const auto result = fair(drawn_line(along_arcs({{1, 1.4}, {2.5, 0.8}}, 801)));
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_TRUE(result->within_tolerance);
  EXPECT_EQ(result->fairness.answer.waves, 0);  // curvature rises once, from 1 to 2.5
  EXPECT_LT(result->fairness.answer.jolt, 2 * result->fairness.smoothing_spline->jolt);
  for (const FairPiece& piece : result->pieces) EXPECT_GT(piece.length, 0.01 * 2.2);
}

// In the points' own unit, however large.
TEST(Stretches, OnePieceIsFoundInAnyUnit) {
  auto points = as_fit_points(along_arcs({{2, 1}}, 200));
  for (FitPoint& p : points) p.position = {30 * p.position.x, 30 * p.position.y};
  const auto chain = detail::one_exact_piece(points, false, 30 * kExact);
  ASSERT_TRUE(chain);
  EXPECT_NEAR(chain->pieces[0].length, 30, 1e-3);
  EXPECT_NEAR(chain->joints[0].curvature, 2 / 30.0, 1e-6);
  EXPECT_NEAR(core::distance(chain->joints[0].position, points.front().position), 0, 1e-4);
  EXPECT_NEAR(core::distance(chain->joints[1].position, points.back().position), 0, 1e-4);
}

// A step of a twentieth of the larger curvature may be the fit's error; ovals of four arcs have
// steps, here at points, circles none.
TEST(Stretches, SmallStepsMayBeErrorsAndOvalsHaveSteps) {
  EXPECT_TRUE(
      detail::may_be_exact(as_fit_points(along_arcs({{1, 1}, {1.03, 1}}, 400)), false, kExact));
  const double pi = core::kPi;
  auto oval = as_fit_points(
      along_arcs({{1, pi / 4}, {2, pi / 4}, {1, pi / 2}, {2, pi / 4}, {1, pi / 4}}, 409));
  oval.pop_back();
  EXPECT_FALSE(detail::may_be_exact(oval, true, kExact));
  auto circle = as_fit_points(along_arcs({{2 * pi, 1}}, 401));
  circle.pop_back();
  EXPECT_TRUE(detail::may_be_exact(circle, true, kExact));
}

/// Places along curvature that runs evenly from each (curvature, length) to the next, by Simpson's
/// rule at small steps.
std::vector<core::Point2> along_graph(const std::vector<std::pair<double, double>>& graph,
                                      int count) {
  double whole = 0;
  for (std::size_t i = 0; i + 1 < graph.size(); ++i) whole += graph[i].second;
  const auto turn_to = [&](double s) {
    double turn = 0;
    for (std::size_t i = 0; i + 1 < graph.size() && s > 0; s -= graph[i].second, ++i) {
      const double part = std::min(s, graph[i].second);
      const double rate = (graph[i + 1].first - graph[i].first) / graph[i].second;
      turn += part * (graph[i].first + rate * part / 2);
    }
    return core::unit_vector(turn);
  };
  constexpr int kSteps = 4;
  const double h = whole / (kSteps * (count - 1));
  std::vector<core::Point2> places{{0, 0}};
  for (int i = 0; i + 1 < count; ++i) {
    core::Vector2 by{0, 0};
    for (int k = kSteps * i; k < kSteps * (i + 1); ++k)
      by = by + h / 6 * (turn_to(h * k) + 4 * turn_to(h * (k + 0.5)) + turn_to(h * (k + 1)));
    places.push_back(places.back() + by);
  }
  return places;
}

// A piece between two others that is shorter than the stretches that are tried.
TEST(Stretches, CurvatureMayChangeAlongAShortPiece) {
  const auto places = along_graph({{1, 1}, {1, 0.05}, {2, 1}, {2, 0}}, 400);
  EXPECT_TRUE(detail::may_be_exact(as_fit_points(places), false, kExact));
}

}  // namespace
}  // namespace keyline::fairing
