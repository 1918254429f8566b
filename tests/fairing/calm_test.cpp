#include "keyline/fairing/calm.h"

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/fairing/turns.h"

/// Waves of curvature taken out.
namespace keyline::fairing::detail {
namespace {

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

/// Points of a curve whose curvature swings to and fro with so many turns, ever more.
Given swinging(int turns, double by = 40) {
  const int n = 4 * (turns + 1);
  return of_curvature(
      [turns, by](double t) {
        return 1 - by * (1 + 0.5 * t) * std::cos(core::kPi * (turns + 1) * t);
      },
      n);
}

// None may go, for the mean square is kept as it is, and no two are alike: 24 in a row are tried,
// the swings beside 23 turns. One more is told, on any number of threads.
TEST(Calm, TwentyFourWavesThatStayAreTriedInARow) {
  for (const auto& [threads, turns] : {std::pair{1, 23}, {3, 24}}) {
    Given g = swinging(turns);
    CalmOptions options;
    options.band.tolerance = 2e-2;
    options.band.rms = 1e-6;
    options.most_rms = 2e-6;
    options.threads = threads;
    const Calmed calmed = calm(g.curve, g.points, options);
    EXPECT_EQ(calmed.waves.turns, turns);
    EXPECT_EQ(calmed.waves.untried, turns > 23);
  }
}

// A swing that is wider than four tolerances cannot go, so that it need not be tried; what is left
// untried is told only of those that might.
TEST(Calm, WavesWiderThanTheBandAreNotMissed) {
  Given g = swinging(30);
  CalmOptions options;
  options.band.tolerance = 1e-4;
  const Calmed calmed = calm(g.curve, g.points, options);
  EXPECT_EQ(calmed.waves.turns, 30);
  EXPECT_FALSE(calmed.waves.untried);
}

// As few turns as asked for, and no fewer than one more wave taken makes them, two.
TEST(Calm, KeepsToTheTurnsAskedFor) {
  for (const int asked : {6, 5, 4, 3, 2, 1}) {
    Given g = swinging(6, 4);
    CalmOptions options;
    options.band.tolerance = 5e-2;
    options.band.rms = 1e-6;
    options.most_rms = 2e-6;
    options.most_turns = asked;
    const Calmed calmed = calm(g.curve, g.points, options);
    EXPECT_TRUE(calmed.band.within) << asked;
    EXPECT_EQ(calmed.waves.turns, static_cast<int>(turns_of(g.curve).size()));
    EXPECT_LE(calmed.waves.turns, asked);
    EXPECT_GE(calmed.waves.turns, asked - 1);
  }
}

// A roof whose ridge stands elsewhere on the curve at hand than along the points: it moves there,
// and the variation is the least that any curve in the tolerance has, to what a trial may be off.
// With the ridge where it was it is a twentieth more.
TEST(Calm, TurnsMoveToWhereThePointsHaveThem) {
  const auto roof = [](double ridge) {
    return of_curvature([ridge](double t) { return 3 - 8 * std::abs(t - ridge); }, 100);
  };
  const Given g = roof(0.5);
  CalmOptions options;
  options.band.tolerance = 1e-5;
  DenseCurve least = g.curve;
  const double energy =
      least_variation(least, g.points, {.tolerance = 1e-5, .gap = 1e-4, .progress = {}}).energy;
  for (const double ridge : {0.47, 0.53}) {
    const DenseCurve elsewhere = roof(ridge).curve;
    DenseCurve curve = g.curve;
    for (std::size_t i = 0; i < curve.joints.size(); ++i)
      curve.joints[i].curvature = elsewhere.joints[i].curvature;
    set_free(curve);
    const BandReport found = calm_again(curve, g.points, 0, options);
    EXPECT_TRUE(found.within) << ridge;
    EXPECT_GE(found.energy, energy * (1 - 1e-3)) << ridge;
    EXPECT_LE(found.energy, energy * 1.03) << ridge;
  }
}

/// Whether a curve with these turns alone would have been better, by the rule.
bool worth_it(const Given& g, const std::vector<int>& extrema, const BandReport& now,
              const CalmOptions& options) {
  DenseCurve trial = g.curve;
  set_senses(trial, extrema);
  const BandReport found = least_variation(trial, g.points,
                                           {.tolerance = options.band.tolerance,
                                            .gap = 0.03,
                                            .warm = true,
                                            .spring = now.spring,
                                            .progress = {}});
  return found.within && found.rms <= options.most_rms &&
         found.energy <= options.worth * now.energy &&
         turns_of(trial).size() < turns_of(g.curve).size();
}

// By the definition: the curve has no swing left without which it would keep the tolerance and the
// mean square and cost no more than it may.
TEST(Calm, LeavesNoWaveThatMightGo) {
  int left = 0;
  for (const double height : {1e-3, 3e-3, 1e-2})
    for (const double rms : {2e-4, 4e-4}) {
      Given g = wavy(height, 80);
      for (std::size_t j = 0; j < g.points.size(); ++j)
        g.points[j].position.y += 3e-4 * std::sin(1.7 * static_cast<double>(j * j));
      g.curve = dense_curve(g.points, false, 120);
      CalmOptions options;
      options.band.tolerance = 1e-3;
      options.band.rms = rms;
      options.most_rms = 1.2 * rms;
      options.worth = 2;
      const Calmed calmed = calm(g.curve, g.points, options);
      EXPECT_TRUE(calmed.band.within);
      const std::vector<int> turns = turns_of(g.curve);
      for (const Removal& swing : removals(g.curve, turns))
        EXPECT_FALSE(worth_it(g, without(turns, {swing}), calmed.band, options))
            << height << ", " << rms << ": " << swing.first << " of " << turns.size();
      left += static_cast<int>(turns.size());
    }
  EXPECT_GT(left, 6);
}

}  // namespace
}  // namespace keyline::fairing::detail
