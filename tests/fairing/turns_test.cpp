#include "keyline/fairing/turns.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

#include "evenly_bent.h"

/// Turns of curvature.
namespace keyline::fairing::detail {
namespace {

using Nodes = std::vector<int>;

TEST(Extrema, AreWhereCurvatureTurnsByEnough) {
  const DenseCurve wave = evenly_bent({0, 1, 3, 2, 2.5, 0, 1});
  EXPECT_EQ(extrema_of(wave, 0.6), (Nodes{2, 5}));
  EXPECT_EQ(extrema_of(wave, 0.4), (Nodes{2, 3, 4, 5}));
  EXPECT_EQ(extrema_of(wave, 2.9), Nodes{2});
  EXPECT_EQ(extrema_of(wave, 3.1), Nodes{});
}

// A swing of exactly the least is none; the last way is to be gone as far as all others.
TEST(Extrema, SwingsAreLargerThanTheLeast) {
  EXPECT_EQ(extrema_of(evenly_bent({0, 1, 0}), 1), Nodes{});
  EXPECT_EQ(extrema_of(evenly_bent({0, 1, 0}), 0.99), Nodes{1});
  EXPECT_EQ(extrema_of(evenly_bent({1, 0, 1}), 0.99), Nodes{1});
  EXPECT_EQ(extrema_of(evenly_bent({1, 0, 0.5}), 0.6), Nodes{});
  EXPECT_EQ(extrema_of(evenly_bent({0, 2, 1}), 1), Nodes{});
  EXPECT_EQ(extrema_of(evenly_bent({2, 0, 1}), 1), Nodes{});
}

// However slowly curvature comes to them: each step is less than what counts.
TEST(Extrema, AreSeenFromGentleSlopesToo) {
  EXPECT_EQ(extrema_of(evenly_bent({3, 2.5, 2, 1.5, 1, 1.5, 2, 2.5}), 1), Nodes{4});
  EXPECT_EQ(extrema_of(evenly_bent({0, 0.5, 1, 1.5, 2, 1.5, 1, 0.5}), 1), Nodes{4});
}

TEST(Extrema, OfMonotoneCurvatureAreNone) {
  EXPECT_EQ(extrema_of(evenly_bent({0, 1, 2, 3}), 0.1), Nodes{});
  EXPECT_EQ(extrema_of(evenly_bent({3, 2, 1, 0}), 0.1), Nodes{});
  EXPECT_EQ(extrema_of(evenly_bent({1, 1, 1}), 0.1), Nodes{});
}

// Of equal ones the first.
TEST(Extrema, StandAtTheFirstOfEquals) {
  EXPECT_EQ(extrema_of(evenly_bent({0, 2, 2, 0}), 0.5), Nodes{1});
  EXPECT_EQ(extrema_of(evenly_bent({2, 0, 0, 2}), 0.5), Nodes{1});
}

// Of a closed curve the highest node is one, and they come in pairs.
TEST(Extrema, OfClosedCurvesGoRound) {
  EXPECT_EQ(extrema_of(evenly_bent({1, 3, 1, -1, 1}, true), 0.5), (Nodes{1, 3}));
  EXPECT_EQ(extrema_of(evenly_bent({3, 1, 2, 0, 3}, true), 0.5), (Nodes{0, 1, 2, 3}));
  EXPECT_EQ(extrema_of(evenly_bent({1, 2, 0, 3, 1}, true), 0.5), (Nodes{0, 1, 2, 3}));
  EXPECT_EQ(extrema_of(evenly_bent({1, 1, 1, 1}, true), 0.5), Nodes{});
}

TEST(Turns, CountFromAThousandthOfTheRange) {
  EXPECT_EQ(turns_of(evenly_bent({0, 10, 9.989, 10, 0})).size(), 3U);
  EXPECT_EQ(turns_of(evenly_bent({0, 10, 9.991, 10, 0})).size(), 1U);
}

TEST(MovedOn, ExtremaStandAtTheFarEndOfWhatIsLevel) {
  const DenseCurve hill = evenly_bent({0, 5, 10, 10, 10, 5, 0, 0, 0, 0, 0});
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
    return moved_on(evenly_bent({0, 5, 10, next, 5, 0, 1, 2, 3, 4, 5}), {2});
  };
  EXPECT_EQ(moved(9.9901), Nodes{3});
  EXPECT_EQ(moved(9.9899), Nodes{2});
  EXPECT_EQ(moved_on(evenly_bent({0, -5, -10, -9.9901, -5, 0, 1, 2, 3, 4, 0}, true), {2}),
            Nodes{3});
}

TEST(Turns, AreSeenFromAFiftiethOfTheRange) {
  EXPECT_EQ(seen_turns_of(evenly_bent({0, 10, 9.79, 10, 0})).size(), 3U);
  EXPECT_EQ(seen_turns_of(evenly_bent({0, 10, 9.81, 10, 0})).size(), 1U);
}

/// The nearest values (mean squares) that rise, by the formula of greatest and least means
/// ([Barlow 1972], theorem 1.9): of cells of one width.
std::vector<double> rising(const std::vector<double>& value) {
  const std::size_t n = value.size();
  std::vector<double> sum{0};
  for (const double v : value) sum.push_back(sum.back() + v);
  std::vector<double> nearest(n, -HUGE_VAL);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double least = HUGE_VAL;
      for (std::size_t k = i; k < n; ++k)
        least = std::min(least, (sum[k + 1] - sum[j]) / double(k + 1 - j));
      nearest[i] = std::max(nearest[i], least);
    }
  return nearest;
}

/// How far a curve departs whose curvature, of cells of width h, becomes the nearest that rises: of
/// each stretch that changes half the range of what it departs from its chord.
double departure(const std::vector<double>& value, double h) {
  const std::vector<double> nearest = rising(value);
  double most = 0;
  for (std::size_t from = 0, to = 0; from < value.size(); from = to) {
    while (to < value.size() && nearest[to] == nearest[from]) ++to;
    const auto off = [&](double s) {  // of (s - t) (value - nearest) dt, cell by cell
      double sum = 0;
      for (std::size_t c = from; c < to; ++c) {
        const double a = h * double(c - from), b = std::min(a + h, s);
        if (b > a) sum += (value[c] - nearest[c]) * (b - a) * (s - (a + b) / 2);
      }
      return sum;
    };
    const double whole = h * double(to - from);
    double low = 0, high = 0;
    for (double s = 0; s < whole + h / 2; s += h) {
      const double away = off(s) - off(whole) * s / whole;
      low = std::min(low, away);
      high = std::max(high, away);
    }
    most = std::max(most, (high - low) / 2);
  }
  return most;
}

/// A curve whose curvature at the shares of its length i / cells this is.
DenseCurve with(const std::function<double(double)>& curvature, int cells, double length) {
  std::vector<double> k;
  for (int i = 0; i <= cells; ++i) k.push_back(curvature(double(i) / cells));
  DenseCurve curve = evenly_bent(k);
  curve.length = length;
  return curve;
}

// A sine of three waves: without a swing between its ends the curve goes straight on, and departs
// by the amplitude that a sine of curvature has in the plane.
TEST(Removals, OfASineDepartByItsAmplitude) {
  const double swing = 0.8, length = 3;  // curvature is times the length
  const double wave = 2 * core::kPi * 3;
  const auto sine = [&](double s) { return 2 + swing * std::sin(wave * s); };
  const DenseCurve curve = with(sine, 360, length);
  const double amplitude = length * swing / (wave * wave);
  int inside = 0;
  for (const Removal& r : removals(curve, {30, 90, 150, 210, 270, 330})) {
    EXPECT_NEAR(r.share, r.count == 2 ? 1. / 6 : 1. / 12, 1e-12);
    if (r.count != 2) continue;
    ++inside;
    EXPECT_NEAR(r.sideways, amplitude, 2e-3 * amplitude) << r.first;
  }
  EXPECT_EQ(inside, 5);
}

// Straight, a little to the other side, and into a bend, as where a fillet begins: the swing is as
// wide as the straight, and departs no farther than what is not straight in it.
TEST(Removals, DepartNowhereWhereCurvatureIsLevel) {
  const auto fillet = [](double s) {
    if (s < 0.4) return 0.0;
    if (s < 0.5) return -4 * std::pow(std::sin(5 * core::kPi * (s - 0.4)), 2);
    return std::min(30.0, 300 * (s - 0.5) - 4);
  };
  const DenseCurve curve = with(fillet, 200, 2);
  const std::vector<Removal> all = removals(curve, {100, 199});
  std::vector<double> cells;
  for (int i = 0; i < 199; ++i)
    cells.push_back((curve.joints[i].curvature + curve.joints[i + 1].curvature) / 2);
  const double away = 2 * departure(cells, 1. / 200);
  const auto first = std::find_if(all.begin(), all.end(),
                                  [](const Removal& r) { return r.first == 0 && r.count == 1; });
  ASSERT_NE(first, all.end());
  EXPECT_NEAR(first->sideways, away, 1e-9 * away);
  EXPECT_LT(first->sideways, 0.1 * 2 * 4 * 0.5 * 0.5 / (core::kPi * core::kPi));  // as if of a wave
}

// Least first, by the nearest curvature that only runs one way; falling ones as rising ones.
TEST(Removals, DepartAsTheNearestCurvatureThatRunsOneWay) {
  const auto waves = [](double s) {
    return 5 * s + 2 * std::sin(19 * s) + std::sin(41 * s + 1) + 0.5 * std::cos(67 * s);
  };
  for (const double sign : {1., -1.}) {
    const DenseCurve curve = with([&](double s) { return sign * waves(s); }, 120, 1.5);
    const std::vector<int> turns = turns_of(curve);
    const std::vector<Removal> all = removals(curve, turns);
    ASSERT_GT(all.size(), 6U);
    EXPECT_EQ(all.size(), turns.size() + 1);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Removal& r = all[i];
      EXPECT_GE(r.sideways, all[i > 0 ? i - 1 : 0].sideways);
      const bool at_start = r.count == 1 && r.first == 0;
      const bool at_end = r.count == 1 && !at_start;
      const std::size_t last = r.first + r.count;
      const int from = at_start || r.first == 0 ? 0 : turns[r.first - 1];
      const int to = at_end || last >= turns.size() ? 120 : turns[last];
      const int a = at_start ? 0 : turns[r.first];
      const int b = at_start ? turns[0] : at_end ? 120 : turns[r.first + 1];
      const double way = curve.joints[a].curvature > curve.joints[b].curvature ? 1 : -1;
      std::vector<double> cells;
      for (int c = from; c < to; ++c)
        cells.push_back(way * (curve.joints[c].curvature + curve.joints[c + 1].curvature) / 2);
      const double away = 1.5 * departure(cells, 1. / 120);
      EXPECT_NEAR(r.sideways, away, 1e-9 * away + 1e-15) << sign << ", " << r.first;
    }
  }
}

// Of a closed curve the last swing goes on over the seam; two extrema alone are not to go, for a
// closed curve has two.
TEST(Removals, KnowThePointsTheyStandOn) {
  DenseCurve curve = evenly_bent({1, 6, 4, 2, 3});
  curve.at = {0, 0.1, 0.2, 0.5, 1};
  for (const int cell : {0, 0, 1, 2, 3, 3, 3}) curve.feet.push_back({cell, 0.5});
  std::vector<std::size_t> points(3);
  for (const Removal& r : removals(curve, {1, 3}))
    points[r.count == 2 ? 1 : 2 * r.first] = r.points;
  EXPECT_EQ(points, (std::vector<std::size_t>{2, 2, 3}));
  DenseCurve closed = evenly_bent({3, 1, 2, 0.5, 2.5, 3}, true);
  for (const int cell : {0, 1, 2, 2, 3, 4, 4}) closed.feet.push_back({cell, 0.5});
  for (const Removal& r : removals(closed, {0, 1, 2, 3}))
    EXPECT_EQ(r.points, (std::vector<std::size_t>{1, 1, 2, 3})[r.first]);
}

TEST(Removals, OfClosedCurvesGoOnOverTheSeam) {
  const DenseCurve curve =
      evenly_bent({3, 1, 2, 0.5, 2.5, 3}, true);  // nodes a fifth of the length apart
  const std::vector<Removal> all = removals(curve, {0, 1, 2, 3});
  ASSERT_EQ(all.size(), 4U);
  for (const Removal& r : all) {
    EXPECT_EQ(r.count, 2U);
    EXPECT_NEAR(r.share, r.first == 3 ? 0.4 : 0.2, 1e-12);
  }
  EXPECT_EQ(removals(curve, {0, 3}).size(), 1U);
  EXPECT_TRUE(removals(curve, {}).empty());
}

// Wherever a closed curve begins, its swings are the same.
TEST(Removals, OfClosedCurvesDoNotDependOnTheSeam) {
  const auto waves = [](double s) {
    const double t = 2 * core::kPi * s;
    return std::cos(2 * t) + 0.6 * std::sin(3 * t + 1) + 0.3 * std::cos(7 * t);
  };
  std::vector<double> first;
  for (const int start : {0, 13, 44, 91}) {
    DenseCurve curve = with([&](double s) { return waves(s + start / 120.); }, 120, 1);
    curve.closed = true;
    std::vector<double> sideways;
    for (const Removal& r : removals(curve, turns_of(curve))) sideways.push_back(r.sideways);
    if (first.empty()) first = sideways;
    ASSERT_EQ(sideways.size(), first.size()) << start;
    ASSERT_GT(sideways.size(), 5U);
    for (std::size_t i = 0; i < first.size(); ++i)
      EXPECT_NEAR(sideways[i], first[i], 1e-12) << start << ", " << i;
  }
}

TEST(Removals, OfAnOpenCurveWithoutTurnsAreNone) {
  EXPECT_TRUE(removals(evenly_bent({0, 1, 2}), {}).empty());
  EXPECT_EQ(removals(evenly_bent({0, 2, 1}), {1}).size(), 2U);
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
  const DenseCurve wave = evenly_bent({2, 4, 5, 3, 1, 2, 3});
  EXPECT_EQ(senses(wave, {2, 4}), (Nodes{1, 1, -1, -1, 1, 1}));
  EXPECT_EQ(senses(wave, {}), (Nodes{1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(senses(evenly_bent({3, 4, 5, 3, 1, 2, 2}), {}), (Nodes{-1, -1, -1, -1, -1, -1}));
  EXPECT_EQ(senses(evenly_bent({5, 1, 4, 2}), {1, 2}), (Nodes{-1, 1, -1}));
  EXPECT_EQ(senses(evenly_bent({5, 1, 4, 2}), {0, 2}),
            (Nodes{-1, -1, 1}));  // down to it, so up behind it
  EXPECT_EQ(senses(evenly_bent({0, 2, 4, 1, 3, 5, 0}), {2, 3, 5}), (Nodes{1, 1, -1, 1, 1, -1}));
}

// One turn is a hill where it is above the ends' mean, though one end may be as high, else a
// valley.
TEST(Senses, OfOneTurnAreToldByTheEndsMean) {
  EXPECT_EQ(senses(evenly_bent({0, 3, 2}), {1}), (Nodes{1, -1}));
  EXPECT_EQ(senses(evenly_bent({0, 1.5, 2}), {1}), (Nodes{1, -1}));
  EXPECT_EQ(senses(evenly_bent({0, 0.5, 2}), {1}), (Nodes{-1, 1}));
  EXPECT_EQ(senses(evenly_bent({2, 1.5, 0, 0}), {1}), (Nodes{1, -1, -1}));
  EXPECT_EQ(senses(evenly_bent({2, 0.5, 0, 0}), {1}), (Nodes{-1, 1, 1}));
}

// Round a closed curve cells before the first and behind the last extremum run alike; none keeps
// either way open.
TEST(Senses, OfClosedCurvesGoRound) {
  EXPECT_EQ(senses(evenly_bent({2, 3, 2, 1, 2}, true), {1, 3}), (Nodes{1, -1, -1, 1}));
  EXPECT_EQ(senses(evenly_bent({2, 1, 2, 3, 2}, true), {1, 3}), (Nodes{-1, 1, 1, -1}));
  EXPECT_EQ(senses(evenly_bent({2, 1, 2, 3, 2}, true), {}), (Nodes{0, 0, 0, 0}));
}

}  // namespace
}  // namespace keyline::fairing::detail
