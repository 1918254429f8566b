#include "keyline/fairing/turns.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

/// Turns of curvature.
namespace keyline::fairing::detail {
namespace {

DenseCurve of(const std::vector<double>& curvatures, bool closed = false) {
  DenseCurve curve;
  curve.closed = closed;
  for (std::size_t i = 0; i < curvatures.size(); ++i) {
    curve.at.push_back(double(i) / double(curvatures.size() - 1));
    curve.joints.push_back({{}, 0, curvatures[i]});
  }
  return curve;
}

using Nodes = std::vector<int>;

TEST(Extrema, AreWhereCurvatureTurnsByEnough) {
  const DenseCurve wave = of({0, 1, 3, 2, 2.5, 0, 1});
  EXPECT_EQ(extrema_of(wave, 0.6), (Nodes{2, 5}));
  EXPECT_EQ(extrema_of(wave, 0.4), (Nodes{2, 3, 4, 5}));
  EXPECT_EQ(extrema_of(wave, 2.9), Nodes{2});
  EXPECT_EQ(extrema_of(wave, 3.1), Nodes{});
}

// A swing of exactly the least is none; the last way is to be gone as far as all others.
TEST(Extrema, SwingsAreLargerThanTheLeast) {
  EXPECT_EQ(extrema_of(of({0, 1, 0}), 1), Nodes{});
  EXPECT_EQ(extrema_of(of({0, 1, 0}), 0.99), Nodes{1});
  EXPECT_EQ(extrema_of(of({1, 0, 1}), 0.99), Nodes{1});
  EXPECT_EQ(extrema_of(of({1, 0, 0.5}), 0.6), Nodes{});
  EXPECT_EQ(extrema_of(of({0, 2, 1}), 1), Nodes{});
  EXPECT_EQ(extrema_of(of({2, 0, 1}), 1), Nodes{});
}

// However slowly curvature comes to them: each step is less than what counts.
TEST(Extrema, AreSeenFromGentleSlopesToo) {
  EXPECT_EQ(extrema_of(of({3, 2.5, 2, 1.5, 1, 1.5, 2, 2.5}), 1), Nodes{4});
  EXPECT_EQ(extrema_of(of({0, 0.5, 1, 1.5, 2, 1.5, 1, 0.5}), 1), Nodes{4});
}

TEST(Extrema, OfMonotoneCurvatureAreNone) {
  EXPECT_EQ(extrema_of(of({0, 1, 2, 3}), 0.1), Nodes{});
  EXPECT_EQ(extrema_of(of({3, 2, 1, 0}), 0.1), Nodes{});
  EXPECT_EQ(extrema_of(of({1, 1, 1}), 0.1), Nodes{});
}

// Of equal ones the first.
TEST(Extrema, StandAtTheFirstOfEquals) {
  EXPECT_EQ(extrema_of(of({0, 2, 2, 0}), 0.5), Nodes{1});
  EXPECT_EQ(extrema_of(of({2, 0, 0, 2}), 0.5), Nodes{1});
}

// Of a closed curve the highest node is one, and they come in pairs.
TEST(Extrema, OfClosedCurvesGoRound) {
  EXPECT_EQ(extrema_of(of({1, 3, 1, -1, 1}, true), 0.5), (Nodes{1, 3}));
  EXPECT_EQ(extrema_of(of({3, 1, 2, 0, 3}, true), 0.5), (Nodes{0, 1, 2, 3}));
  EXPECT_EQ(extrema_of(of({1, 2, 0, 3, 1}, true), 0.5), (Nodes{0, 1, 2, 3}));
  EXPECT_EQ(extrema_of(of({1, 1, 1, 1}, true), 0.5), Nodes{});
}

TEST(Turns, CountFromAThousandthOfTheRange) {
  EXPECT_EQ(turns_of(of({0, 10, 9.989, 10, 0})).size(), 3U);
  EXPECT_EQ(turns_of(of({0, 10, 9.991, 10, 0})).size(), 1U);
}

TEST(MovedOn, ExtremaStandAtTheFarEndOfWhatIsLevel) {
  const DenseCurve hill = of({0, 5, 10, 10, 10, 5, 0, 0, 0, 0, 0});
  EXPECT_EQ(moved_on(hill, {2}), Nodes{4});
  EXPECT_EQ(moved_on(hill, {4}), Nodes{2});
  EXPECT_EQ(moved_on(hill, {3}), Nodes{3});          // level on both sides
  EXPECT_EQ(moved_on(hill, {5}), Nodes{5});          // on neither
  EXPECT_EQ(moved_on(hill, {2, 6}), (Nodes{4, 9}));  // short of the end
  EXPECT_EQ(moved_on(hill, {2, 3}), (Nodes{2, 4}));  // and of each other
  EXPECT_EQ(moved_on(hill, {2, 9}), (Nodes{4, 6}));
  EXPECT_EQ(moved_on(hill, {}), Nodes{});
}

// A range of 10 over the length: of a tenth of it a hundredth is 0.01.
TEST(MovedOn, LevelIsAHundredthOfTheRange) {
  const auto moved = [](double next) {
    return moved_on(of({0, 5, 10, next, 5, 0, 1, 2, 3, 4, 5}), {2});
  };
  EXPECT_EQ(moved(9.9901), Nodes{3});
  EXPECT_EQ(moved(9.9899), Nodes{2});
  EXPECT_EQ(moved_on(of({0, -5, -10, -9.9901, -5, 0, 1, 2, 3, 4, 0}, true), {2}), Nodes{3});
}

TEST(Turns, AreSeenFromAFiftiethOfTheRange) {
  EXPECT_EQ(seen_turns_of(of({0, 10, 9.79, 10, 0})).size(), 3U);
  EXPECT_EQ(seen_turns_of(of({0, 10, 9.81, 10, 0})).size(), 1U);
}

/// How far a curve of this curvature, from 0 to `width`, departs from the line between its ends:
/// curvature integrated twice.
double departure(const std::function<double(double)>& curvature, double width) {
  constexpr int kSteps = 20000;
  const double h = width / kSteps;
  std::vector<double> sideways{0};
  double slope = 0, off = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double bend = curvature((i + 0.5) * h);
    off += h * (slope + 0.5 * h * bend);
    slope += h * bend;
    sideways.push_back(off);
  }
  double most = 0;
  for (int i = 0; i <= kSteps; ++i) most = std::max(most, std::abs(sideways[i] - off * i / kSteps));
  return most;
}

// A curve of a length of 3, whose curvature is a hill and a valley: from an end up to the hill,
// from there down, and up to the other end. Each is as wide as a half wave of a sine with that
// swing, and departs as far from its middle.
TEST(Removals, DepartAsFarAsAWaveOfTheirSwingAndWidth) {
  DenseCurve curve = of({1, 6, 4, 2, 3});
  curve.at = {0, 0.1, 0.2, 0.5, 1};
  curve.length = 3;
  const std::vector<Removal> all = removals(curve, {1, 3});
  ASSERT_EQ(all.size(), 3U);
  struct Expected {
    double swing;
    double share;
    std::size_t first, count;
  };
  // Least first: 5 over a tenth of the length (1), 1 over a half (5), 4 over four tenths (12.8).
  const std::vector<Expected> expected{{5, 0.1, 0, 1}, {1, 0.5, 1, 1}, {4, 0.4, 0, 2}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [swing, share, first, count] = expected[i];
    const double width = 3 * share, amplitude = swing / 3 / 2;  // curvature is times the length
    const double away =
        departure([&](double s) { return amplitude * std::sin(core::kPi * s / width); }, width);
    EXPECT_NEAR(all[i].sideways, away, 1e-6 * away) << i;
    EXPECT_NEAR(all[i].share, share, 1e-12) << i;
    EXPECT_EQ(all[i].first, first) << i;
    EXPECT_EQ(all[i].count, count) << i;
  }
}

// Of a closed curve the last swing goes on over the seam; two extrema alone are not to go, for a
// closed curve has two.
TEST(Removals, KnowThePointsTheyStandOn) {
  DenseCurve curve = of({1, 6, 4, 2, 3});
  curve.at = {0, 0.1, 0.2, 0.5, 1};
  for (const int cell : {0, 0, 1, 2, 3, 3, 3}) curve.feet.push_back({cell, 0.5});
  std::vector<std::size_t> points(3);
  for (const Removal& r : removals(curve, {1, 3}))
    points[r.count == 2 ? 1 : 2 * r.first] = r.points;
  EXPECT_EQ(points, (std::vector<std::size_t>{2, 2, 3}));
  DenseCurve closed = of({3, 1, 2, 0.5, 2.5, 3}, true);
  for (const int cell : {0, 1, 2, 2, 3, 4, 4}) closed.feet.push_back({cell, 0.5});
  for (const Removal& r : removals(closed, {0, 1, 2, 3}))
    EXPECT_EQ(r.points, (std::vector<std::size_t>{1, 1, 2, 3})[r.first]);
}

TEST(Removals, OfClosedCurvesGoOnOverTheSeam) {
  const DenseCurve curve = of({3, 1, 2, 0.5, 2.5, 3}, true);  // nodes a fifth of the length apart
  const std::vector<Removal> all = removals(curve, {0, 1, 2, 3});
  ASSERT_EQ(all.size(), 4U);
  // Swings of 1, 1.5, 2 and 2.5 over 1, 1, 1 and 2 fifths.
  EXPECT_EQ(all[0].first, 1U);
  EXPECT_EQ(all[1].first, 2U);
  EXPECT_EQ(all[2].first, 0U);
  EXPECT_EQ(all[3].first, 3U);
  for (const Removal& r : all) EXPECT_EQ(r.count, 2U);
  EXPECT_NEAR(all[3].share, 0.4, 1e-12);
  EXPECT_NEAR(all[3].sideways / all[0].sideways, 2.5 * 4, 1e-12);
  EXPECT_EQ(removals(curve, {0, 3}).size(), 1U);
  EXPECT_TRUE(removals(curve, {}).empty());
}

TEST(Removals, OfAnOpenCurveWithoutTurnsAreNone) {
  EXPECT_TRUE(removals(of({0, 1, 2}), {}).empty());
  EXPECT_EQ(removals(of({0, 2, 1}), {1}).size(), 2U);
}

TEST(Without, TakesTheExtremaThatBoundTheSwing) {
  const Nodes extrema{2, 5, 7, 9};
  EXPECT_EQ(without(extrema, {{.first = 0, .count = 1}}), (Nodes{5, 7, 9}));
  EXPECT_EQ(without(extrema, {{.first = 1, .count = 2}}), (Nodes{2, 9}));
  EXPECT_EQ(without(extrema, {{.first = 3, .count = 2}}), (Nodes{5, 7}));  // over the seam
  EXPECT_EQ(without(extrema, {{.first = 3, .count = 1}, {.first = 0, .count = 2}}), Nodes{7});
  EXPECT_EQ(without(extrema, {}), extrema);
}

std::vector<int> senses(DenseCurve curve, const std::vector<int>& extrema) {
  set_senses(curve, extrema);
  return {curve.sense.begin(), curve.sense.end()};
}

// Up to a hill, down behind it; what is asked to have no turn runs from one end to the other.
TEST(Senses, AreThoseBetweenTheExtrema) {
  const DenseCurve wave = of({2, 4, 5, 3, 1, 2, 3});
  EXPECT_EQ(senses(wave, {2, 4}), (Nodes{1, 1, -1, -1, 1, 1}));
  EXPECT_EQ(senses(wave, {}), (Nodes{1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(senses(of({3, 4, 5, 3, 1, 2, 2}), {}), (Nodes{-1, -1, -1, -1, -1, -1}));
  EXPECT_EQ(senses(of({5, 1, 4, 2}), {1, 2}), (Nodes{-1, 1, -1}));
  EXPECT_EQ(senses(of({5, 1, 4, 2}), {0, 2}), (Nodes{-1, -1, 1}));  // down to it, so up behind it
  EXPECT_EQ(senses(of({0, 2, 4, 1, 3, 5, 0}), {2, 3, 5}), (Nodes{1, 1, -1, 1, 1, -1}));
}

// One turn is a hill where it is above the ends' mean, though one end may be as high, else a
// valley.
TEST(Senses, OfOneTurnAreToldByTheEndsMean) {
  EXPECT_EQ(senses(of({0, 3, 2}), {1}), (Nodes{1, -1}));
  EXPECT_EQ(senses(of({0, 1.5, 2}), {1}), (Nodes{1, -1}));
  EXPECT_EQ(senses(of({0, 0.5, 2}), {1}), (Nodes{-1, 1}));
  EXPECT_EQ(senses(of({2, 1.5, 0, 0}), {1}), (Nodes{1, -1, -1}));
  EXPECT_EQ(senses(of({2, 0.5, 0, 0}), {1}), (Nodes{-1, 1, 1}));
}

// Round a closed curve cells before the first and behind the last extremum run alike; none keeps
// either way open.
TEST(Senses, OfClosedCurvesGoRound) {
  EXPECT_EQ(senses(of({2, 3, 2, 1, 2}, true), {1, 3}), (Nodes{1, -1, -1, 1}));
  EXPECT_EQ(senses(of({2, 1, 2, 3, 2}, true), {1, 3}), (Nodes{-1, 1, 1, -1}));
  EXPECT_EQ(senses(of({2, 1, 2, 3, 2}, true), {}), (Nodes{0, 0, 0, 0}));
}

}  // namespace
}  // namespace keyline::fairing::detail
