#include "keyline/fairing/calm.h"

#include <cmath>
#include <functional>
#include <utility>
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

/// Curve and points of curvature k(t) times the length 1, laid out by many small steps.
Given of_curvature(const std::function<double(double)>& k, int n, bool closed = false) {
  Given g;
  constexpr int kFine = 400;
  double direction = 0.2;
  core::Point2 at{0, 0};
  g.curve.closed = closed;
  for (int i = 0; i <= n; ++i) {
    const double t = double(i) / n;
    g.curve.at.push_back(t);
    g.curve.joints.push_back({at, direction, k(t)});
    if (!closed || i < n) {
      g.points.push_back({.position = at});
      g.curve.feet.push_back(i < n ? Foot{i, 0} : Foot{n - 1, 1});
    }
    for (int f = 0; f < kFine && i < n; ++f) {
      const double h = 1.0 / n / kFine, middle = t + (f + 0.5) * h;
      direction += 0.5 * h * k(middle);
      at = at + h * core::unit_vector(direction);
      direction += 0.5 * h * k(middle);
    }
  }
  if (closed) {
    g.curve.turning = direction - 0.2;
    g.curve.joints.back() = g.curve.joints.front();
    g.curve.joints.back().direction += g.curve.turning;
  }
  set_free(g.curve);
  return g;
}

// Solved again with the turns it has, curvature is told to run in every cell the way it runs: up to
// a turn, down behind it, whichever comes first.
TEST(Calm, SensesAreThoseOfTheCurve) {
  const std::vector<std::pair<const char*, std::function<double(double)>>> shapes{
      {"up", [](double t) { return 1 + 2 * t; }},
      {"down", [](double t) { return 3 - 2 * t; }},
      {"hill", [](double t) { return 3 - 8 * (t - 0.3) * (t - 0.3); }},
      {"valley", [](double t) { return 1 + 8 * (t - 0.7) * (t - 0.7); }},
      {"low hill", [](double t) { return 2 + 0.5 * t - 8 * std::pow(t - 0.05, 2); }},
      {"two", [](double t) { return 2 + std::sin(2 * M_PI * t); }},
      {"two down", [](double t) { return 2 - std::sin(2 * M_PI * t); }},
      {"three", [](double t) { return 2 + std::sin(3 * M_PI * t); }}};
  for (const auto& [name, k] : shapes) {
    SCOPED_TRACE(name);
    Given g = of_curvature(k, 40);
    const std::vector<int> turns = turns_of(g.curve);
    CalmOptions options;
    options.band.tolerance = 1e-4;
    const BandReport found = calm_again(g.curve, g.points, 0, options);
    EXPECT_TRUE(found.within);
    EXPECT_EQ(turns_of(g.curve).size(), turns.size());
    ASSERT_EQ(g.curve.sense.size(), 40U);
    int changes = 0;
    for (std::size_t c = 0; c < 40; ++c) {
      const double middle = (static_cast<double>(c) + 0.5) / 40, h = 0.5 / 40;
      const double rise = k(middle + h) - k(middle - h);
      // Turns may move on by a few cells.
      if (std::abs(rise) > 0.02) {
        EXPECT_EQ(g.curve.sense[c], rise > 0 ? 1 : -1) << c;
      }
      EXPECT_GT(g.curve.sense[c] * (g.curve.value[c + 1] - g.curve.value[c]), 0) << c;
      changes += c > 0 && g.curve.sense[c] != g.curve.sense[c - 1];
    }
    EXPECT_EQ(changes, static_cast<int>(turns.size()));
  }
}

TEST(Calm, SensesOfClosedCurvesGoRound) {
  const auto k = [](double t) { return 2 * M_PI * (1 + 0.3 * std::sin(4 * M_PI * t + 1)); };
  Given g = of_curvature(k, 60, true);
  CalmOptions options;
  options.band.tolerance = 1e-3;
  EXPECT_TRUE(calm_again(g.curve, g.points, 0, options).within);
  for (std::size_t c = 0; c < 60; ++c) {
    const double rise = k((static_cast<double>(c) + 1) / 60) - k(static_cast<double>(c) / 60);
    if (std::abs(rise) > 0.03) {
      EXPECT_EQ(g.curve.sense[c], rise > 0 ? 1 : -1) << c;
    }
  }
  // A circle has no turns, and either way is open.
  Given circle = of_curvature([](double) { return 2 * M_PI; }, 60, true);
  calm_again(circle.curve, circle.points, 0, options);
  for (const signed char sense : circle.curve.sense) EXPECT_EQ(sense, 0);
}

// The lower of two bumps goes, the higher stays, whichever comes first along the curve and though
// the higher is narrower: none of those behind one that cannot go would be asked.
TEST(Calm, TheLowerWaveGoesFirst) {
  for (const bool first : {false, true}) {
    SCOPED_TRACE(first);
    Given g;
    for (int i = 0; i <= 100; ++i) {
      const double x = i / 100.0;
      const auto bump = [&](double at, double height, double width) {
        return height * std::exp(-std::pow((x - at) / width, 2));
      };
      const double low = bump(first ? 0.25 : 0.75, 6e-4, 0.1);
      const double high = bump(first ? 0.75 : 0.25, 1.6e-2, 0.04);
      g.points.push_back({.position = {x, 0.3 * x * x + low + high}});
    }
    g.curve = dense_curve(g.points, false, 100);
    CalmOptions options;
    options.band.tolerance = 5e-4;
    options.worth = 2;
    const Calmed calmed = calm(g.curve, g.points, options);
    EXPECT_TRUE(calmed.band.within);
    EXPECT_GE(calmed.waves.turns, 2);
    for (const int node : turns_of(g.curve)) {
      const double at = g.curve.at[static_cast<std::size_t>(node)];
      EXPECT_GT(std::abs(at - (first ? 0.25 : 0.75)), 0.1) << at;
    }
  }
}

// A circle with a low bump and a high one opposite: wherever its points begin, the low one goes and
// the circle's own two waves stay, four turns.
TEST(Calm, WhereAClosedCurveBeginsTellsNothing) {
  for (const int start : {0, 20, 30, 60}) {
    Given g;
    for (int i = 0; i < 120; ++i) {
      const double angle = 2 * core::kPi * ((i + start) % 120) / 120;
      const auto bump = [angle](double at, double height) {
        return height * std::exp(-std::pow((angle - at) / 0.5, 2));
      };
      const double r = 0.159 + bump(0.5 * core::kPi, 3e-4) + bump(1.5 * core::kPi, 1e-2);
      g.points.push_back({.position = {r * std::cos(angle), r * std::sin(angle)}});
    }
    g.curve = dense_curve(g.points, true, 120);
    CalmOptions options;
    options.band.tolerance = 1e-3;
    options.worth = 2;
    const Calmed calmed = calm(g.curve, g.points, options);
    EXPECT_TRUE(calmed.band.within);
    EXPECT_EQ(calmed.waves.turns, 4) << start;
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
