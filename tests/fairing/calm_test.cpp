#include "keyline/fairing/calm.h"

#include <cmath>

#include <gtest/gtest.h>

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

/// A wave along points of a line, as high as given, in the middle of the length.
struct Given {
  DenseCurve curve;
  std::vector<FitPoint> points;
};
Given wavy(double height, int n = 120) {
  Given g;
  for (int i = 0; i <= n; ++i) {
    const double x = double(i) / n;
    const double s = (x - 0.5) / 0.12;
    g.points.push_back({.position = {x, 0.3 * x * x + height * std::exp(-s * s)}});
  }
  g.curve = dense_curve(g.points, false, 200);
  return g;
}

// A bump within the tolerance goes, one beyond it stays.
TEST(Calm, TakesOutWavesThatTheToleranceHolds) {
  Given low = wavy(2e-4);
  CalmOptions options;
  options.band.tolerance = 1e-3;
  options.worth = 1.5;
  const Calmed calmed = calm(low.curve, low.points, options);
  EXPECT_TRUE(calmed.band.within);
  EXPECT_LE(calmed.waves.turns, 1);
  EXPECT_FALSE(calmed.waves.untried);
  EXPECT_LE(calmed.band.max_offset, 1e-3);
  Given high = wavy(2e-2);
  const Calmed kept = calm(high.curve, high.points, options);
  EXPECT_TRUE(kept.band.within);
  EXPECT_GE(kept.waves.turns, 3);
}

// A bump that the tolerance would let go stays where the mean square would not; asked for no more
// turns than one it goes all the same.
TEST(Calm, StopsAtTheMeanSquare) {
  Given g = wavy(2e-3);
  CalmOptions options;
  options.band.tolerance = 5e-3;
  options.band.rms = options.most_rms = 2e-4;
  const Calmed calmed = calm(g.curve, g.points, options);
  EXPECT_LE(calmed.band.rms, 2e-4 * 1.01);
  EXPECT_GE(calmed.waves.turns, 2);
  options.most_turns = 1;
  Given asked = wavy(2e-3);
  EXPECT_LE(calm(asked.curve, asked.points, options).waves.turns, 1);
}

// Errors of points make waves that are tried one by one: on three threads the first that is worth
// it is the one that goes, as on one.
TEST(Calm, DoesNotDependOnTheNumberOfThreads) {
  const auto calmed = [](int threads) {
    Given g = wavy(1e-3);
    for (std::size_t j = 0; j < g.points.size(); ++j)
      g.points[j].position.y += 2e-4 * std::sin(1.7 * static_cast<double>(j * j));
    g.curve = dense_curve(g.points, false, 200);
    CalmOptions options;
    options.band.tolerance = 3e-4;
    options.most_rms = 2e-4;
    options.threads = threads;
    calm(g.curve, g.points, options);
    return g.curve.value;
  };
  const std::vector<double> one = calmed(1);
  EXPECT_EQ(calmed(3), one);
}

/// Root of the mean square of the last eight offsets.
double beside_end(const Given& g) {
  DenseCurve curve = g.curve;
  const std::vector<CellShape> shapes = shapes_of(curve);
  double sum = 0;
  for (std::size_t j = g.points.size() - 8; j < g.points.size(); ++j)
    sum += std::pow(offset_of(g.points[j], place_of(curve, shapes, curve.feet[j])), 2);
  return std::sqrt(sum / 8);
}

// Points of an end that pull harder draw it near; the bump that went does not come back.
TEST(Calm, StaysCalmForPointsThatPullHarder) {
  Given g = wavy(2e-3);
  CalmOptions options;
  options.band.tolerance = 5e-3;
  options.band.rms = 2e-4;  // springs that follow the bump, were it let be
  const Calmed calmed = calm(g.curve, g.points, options);
  const double before = beside_end(g);
  for (std::size_t j = g.points.size() - 8; j < g.points.size(); ++j) g.points[j].pull = 64;
  const BandReport again = calm_again(g.curve, g.points, calmed.band.spring, options);
  EXPECT_TRUE(again.within);
  EXPECT_LE(turns_of(g.curve).size(), static_cast<std::size_t>(calmed.waves.turns));
  EXPECT_LT(beside_end(g), 0.5 * before);
}

}  // namespace
}  // namespace keyline::fairing::detail
