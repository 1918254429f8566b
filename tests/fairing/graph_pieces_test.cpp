#include "keyline/fairing/graph_pieces.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

/// Pieces read off a graph of curvature that is known.
namespace keyline::fairing::detail {
namespace {

DenseCurve graph(const std::function<double(double)>& k, int cells = 240) {
  DenseCurve curve;
  for (int i = 0; i <= cells; ++i) {
    const double t = double(i) / cells;
    curve.at.push_back(t);
    curve.joints.push_back({{}, 0, k(t)});
  }
  set_free(curve);
  return curve;
}

constexpr core::Interval kSlopes{-3, 3};

// A log-aesthetic piece is read as one, of its own slope.
TEST(GraphPieces, ReadsAPieceAsItself) {
  for (const double alpha : {-2.0, -0.5, 0.7, 2.0}) {
    const auto k = [&](double t) {
      return std::pow((1 - t) * std::pow(2, -alpha) + t * std::pow(7, -alpha), -1 / alpha);
    };
    const DenseCurve curve = graph(k);
    GraphPieces pieces(curve, {}, kSlopes, 25, 1e-3);
    const auto count = pieces.within(0.02, 40);
    EXPECT_EQ(count, std::vector<int>{1}) << alpha;
    const DenseCurve cut = pieces.cut_by(count);
    ASSERT_EQ(cut.alpha.size(), 1U);
    EXPECT_NEAR(cut.alpha[0], alpha, 0.02) << alpha;
    EXPECT_EQ(cut.value, (std::vector<double>{curve.value.front(), curve.value.back()}));
    EXPECT_EQ(cut.cut, (std::vector<int>{0, 240}));
    EXPECT_EQ(cut.sense, std::vector<signed char>{1});
  }
}

// Through zero curvature runs as a clothoid's: of steeper slopes its variation has no bound.
TEST(GraphPieces, ThroughAnInflectionSlopesAreFew) {
  const DenseCurve curve = graph([](double t) { return 5 * std::cbrt(t - 0.2); });
  GraphPieces pieces(curve, {}, kSlopes, 25, 1e-3);
  const DenseCurve cut = pieces.cut_by({1});
  EXPECT_EQ(cut.alpha[0], -1);  // of slope -3, which is not to be had there
  const DenseCurve falling = graph([](double t) { return 4 - 8 * t; });
  EXPECT_EQ(GraphPieces(falling, {}, kSlopes, 25, 1e-3).cut_by({1}).sense,
            std::vector<signed char>{-1});
}

// Kept on its side of zero, curvature may still sink to zero while pieces are solved for: from a
// twentieth on their slopes are those of inflections. Where nothing keeps it a hundredth counts.
TEST(GraphPieces, WhereCurvatureKeepsToItsSideItMaySink) {
  const auto k = [](double t) { return std::pow((1 - t) * std::pow(0.05, 3) + t, 1.0 / 3); };
  DenseCurve curve = graph(k);
  const auto slope = [&] { return GraphPieces(curve, {}, kSlopes, 1, 1e-3).cut_by({1}).alpha[0]; };
  EXPECT_NEAR(slope(), -3, 0.01);
  curve.side.assign(curve.value.size(), 1);
  EXPECT_GE(slope(), -1);
  EXPECT_LE(slope(), -0.3);
  // Where no such slope is asked for it does without.
  EXPECT_NEAR(GraphPieces(curve, {}, {-3, -2}, 1, 1e-3).cut_by({1}).alpha[0], -3, 0.01);
  curve.side.front() = 0;
  EXPECT_NEAR(slope(), -3, 0.01);
}

// Each end of a piece keeps the side of its node.
TEST(GraphPieces, PiecesKeepToTheSidesOfTheirEnds) {
  DenseCurve curve = graph([](double t) { return 2 - 4 * std::abs(t - 0.5); }, 100);
  curve.side.assign(101, 0);
  curve.side[0] = curve.side[50] = 1;
  GraphPieces pieces(curve, {50}, kSlopes, variation(curve), 1e-4);
  EXPECT_EQ(pieces.cut_by({1, 1}).side, (std::vector<signed char>{1, 1, 0}));
  curve.side.clear();
  EXPECT_TRUE(GraphPieces(curve, {50}, kSlopes, 1, 1e-4).cut_by({1, 1}).side.empty());
}

// A clothoid through its inflection, hardly uneven: what it turns tells little of the slope, and a
// slope of -0.3 that turns as far has nearly twice the variation (n^2 / (2n - 1) with n = 1 / 0.3).
TEST(GraphPieces, ThroughAnInflectionVariationTellsTheSlope) {
  const auto k = [](double t) { return 39.8 * t - 19.8 + 0.4 * (t + std::cos(2 * M_PI * t) - 1); };
  const DenseCurve curve = graph(k);
  const DenseCurve cut = GraphPieces(curve, {}, kSlopes, variation(curve), 1e-2).cut_by({1});
  EXPECT_LT(variation(cut), 1.1 * variation(curve));
  EXPECT_NEAR(cut.alpha[0], -1, 0.2);
}

// Steps of random height and width, joined by ramps: as many pieces as there are steps and ramps.
// Between the places that a run has at first, too far apart for so many, no pieces follow them.
TEST(GraphPieces, MoreOfThemFindTheirPlaces) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> cells(2, 12);
  std::uniform_real_distribution<double> power(0, 3);
  std::vector<double> value{1};
  int pieces = 0;
  for (; value.size() < 230; ++pieces) {
    const double rate = pieces % 2 == 0 ? 1e-3 : 1e-2 * std::pow(10, power(random));
    for (int i = cells(random); i > 0; --i) value.push_back(value.back() + rate);
  }
  const int last = static_cast<int>(value.size()) - 1;
  const DenseCurve curve = graph([&](double t) { return value[std::lround(t * last)]; }, last);
  GraphPieces graph_pieces(curve, {}, {-1, -1}, variation(curve), 1e-4);
  EXPECT_NEAR(graph_pieces.within(1e-4, last).front(), pieces, 2);
}

// Straight lines with a bend in the graph: two pieces, cut where it bends.
TEST(GraphPieces, CutsWhereTheGraphBends) {
  const auto k = [](double t) { return t < 0.4 ? 1 + t : 1.4 + 20 * (t - 0.4); };
  const DenseCurve curve = graph(k);
  GraphPieces pieces(curve, {}, kSlopes, variation(curve), 1e-4);
  const auto count = pieces.within(1e-3, 40);
  EXPECT_EQ(count, std::vector<int>{2});
  const DenseCurve cut = pieces.cut_by(count);
  ASSERT_EQ(cut.cut.size(), 3U);
  EXPECT_NEAR(curve.at[cut.cut[1]], 0.4, 0.01);
  EXPECT_NEAR(cut.value[1], 1.4, 0.2);
  EXPECT_EQ(pieces.within(1e-3, 1), std::vector<int>{1});  // no more than are allowed
}

// Nothing runs on across a turn, and each run has its sense.
TEST(GraphPieces, TurnsEndPieces) {
  const DenseCurve curve = graph([](double t) { return t < 0.5 ? 1 + 2 * t : 3 - 2 * t; });
  GraphPieces pieces(curve, {120}, kSlopes, variation(curve), 1e-4);
  const auto count = pieces.within(1e-3, 40);
  EXPECT_EQ(count, (std::vector<int>{1, 1}));
  const DenseCurve cut = pieces.cut_by(count);
  EXPECT_EQ(cut.cut, (std::vector<int>{0, 120, 240}));
  EXPECT_EQ(cut.sense, (std::vector<signed char>{1, -1}));
  EXPECT_NEAR(cut.value[1], 2, 1e-12);
}

// Lines stay as they are, with what is before and behind them.
TEST(GraphPieces, LinesStay) {
  DenseCurve curve = graph([](double t) { return t < 0.5 ? 0 : 4 * (t - 0.5); }, 100);
  curve.cut.clear();
  curve.cut = {0};
  curve.alpha.clear();
  curve.value = {0};
  curve.kind.clear();
  curve.cut.push_back(50);
  curve.alpha.push_back(-1);
  curve.kind.push_back(PieceKind::line);
  curve.value.push_back(0);
  for (int i = 51; i <= 100; ++i) {
    curve.cut.push_back(i);
    curve.alpha.push_back(-1);
    curve.kind.push_back(PieceKind::curve);
    curve.value.push_back(curve.joints[i].curvature);
  }
  GraphPieces pieces(curve, {}, kSlopes, variation(curve), 1e-4);
  const auto count = pieces.within(1e-3, 40);
  ASSERT_EQ(count, (std::vector<int>{1, 1}));
  const DenseCurve cut = pieces.cut_by(count);
  EXPECT_EQ(cut.cut, (std::vector<int>{0, 50, 100}));
  EXPECT_EQ(cut.kind, (std::vector<PieceKind>{PieceKind::line, PieceKind::curve}));
  EXPECT_EQ(cut.alpha[1], -1);
}

// A closed curve is begun at a turn.
TEST(GraphPieces, ClosedCurvesBeginAtATurn) {
  DenseCurve curve = graph([](double t) { return 5 + std::sin(2 * M_PI * t); }, 80);
  curve.closed = true;
  GraphPieces pieces(curve, {20, 60}, kSlopes, variation(curve), 1e-2);
  const DenseCurve cut = pieces.cut_by({1, 1});
  EXPECT_NEAR(cut.value[0], 6, 1e-12);
  EXPECT_NEAR(cut.value[1], 4, 1e-12);
  EXPECT_NEAR(cut.value[2], 6, 1e-12);
  EXPECT_EQ(cut.cut, (std::vector<int>{0, 40, 80}));
  EXPECT_EQ(cut.sense, (std::vector<signed char>{-1, 1}));
}

/// What one piece between two nodes loses, by this test's own sums: of slope -1 or of that, found
/// by halving, whose piece turns as far as the graph, both made of straight lines between the
/// nodes.
double own_loss(const DenseCurve& curve, int from, int to, double energy, double tolerance) {
  const double a = curve.value[from], b = curve.value[to];
  const double length = curve.at[to] - curve.at[from];
  const auto off = [&](double alpha, int i) {
    const double v = (curve.at[i] - curve.at[from]) / length;
    const double p = -alpha;
    const double k = p == 0 ? a * std::pow(b / a, v)
                            : std::pow((1 - v) * std::pow(a, p) + v * std::pow(b, p), 1 / p);
    return k - curve.value[i];
  };
  const auto turn = [&](double alpha) {
    double sum = 0;
    for (int i = from; i < to; ++i)
      sum += (curve.at[i + 1] - curve.at[i]) * 0.5 * (off(alpha, i) + off(alpha, i + 1));
    return sum;
  };
  double low = -3, high = 3;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (turn(middle) * turn(low) > 0 ? low : high) = middle;
  }
  const auto lost = [&](double alpha) {
    double excess = 0, along = 0, direction = 0, y = 0;
    std::vector<double> away{0};
    for (int i = from; i < to; ++i) {
      const double h = curve.at[i + 1] - curve.at[i], o = off(alpha, i), next = off(alpha, i + 1);
      excess += (next - o) * (next - o) / h;
      along += 2 * (next - o) * (curve.value[i + 1] - curve.value[i]) / h;
      y += h * direction + h * h * (2 * o + next) / 6;
      direction += 0.5 * h * (o + next);
      away.push_back(y);
    }
    double bow = 0.25 * std::abs(y);
    for (int i = from; i <= to; ++i)
      bow = std::max(bow, std::abs(away[static_cast<std::size_t>(i - from)] -
                                   y * (curve.at[i] - curve.at[from]) / length));
    return (excess + std::max(along, 0.0)) / energy + 0.1 * std::pow(bow / tolerance, 2);
  };
  return std::min(lost(0.5 * (low + high)), lost(-1));
}

double cubic(double t) { return 1 + t + 6 * t * t * t; }

// One piece does where the loss of that is let pass, and not where it is a little more: of its
// variation where the tolerance is wide, of its bow where that is narrow.
TEST(GraphPieces, WhatAPieceLosesIsVariationAndBow) {
  const DenseCurve curve = graph(cubic, 60);
  for (const auto& [energy, tolerance] : {std::pair{20.0, 10.0}, {1e9, 1e-3}, {40.0, 5e-3}}) {
    GraphPieces pieces(curve, {}, kSlopes, energy, tolerance);
    const double loss = own_loss(curve, 0, 60, energy, tolerance);
    EXPECT_EQ(pieces.within(1.03 * loss, 40), std::vector<int>{1}) << energy;
    EXPECT_GT(pieces.within(0.97 * loss, 40)[0], 1) << energy;
  }
  // A tolerance is of the length.
  DenseCurve longer = curve;
  longer.length = 3;
  GraphPieces pieces(longer, {}, kSlopes, 1e9, 3e-3);
  const double loss = own_loss(curve, 0, 60, 1e9, 1e-3);
  EXPECT_EQ(pieces.within(1.03 * loss, 40), std::vector<int>{1});
  EXPECT_GT(pieces.within(0.97 * loss, 40)[0], 1);
}

// Two pieces are cut where the sum of both losses is least: every node is tried here.
TEST(GraphPieces, CutsWhereTheLeastIsLost) {
  const DenseCurve curve = graph([](double t) { return 1 + 3 * std::pow(t, 5) + t; }, 30);
  const double energy = 20, tolerance = 5e-3;
  GraphPieces pieces(curve, {}, kSlopes, energy, tolerance);
  const DenseCurve cut = pieces.cut_by({2});
  ASSERT_EQ(cut.cut.size(), 3U);
  double least = HUGE_VAL;
  for (int i = 2; i <= 28; ++i)
    least = std::min(least, own_loss(curve, 0, i, energy, tolerance) +
                                own_loss(curve, i, 30, energy, tolerance));
  const double taken = own_loss(curve, 0, cut.cut[1], energy, tolerance) +
                       own_loss(curve, cut.cut[1], 30, energy, tolerance);
  EXPECT_LE(taken, 1.1 * least);
  EXPECT_EQ(pieces.within(1.03 * taken, 40), std::vector<int>{2});
  EXPECT_GT(pieces.within(0.9 * least, 40)[0], 2);
}

// The run that loses gets the pieces, and no more are made than are allowed.
TEST(GraphPieces, PiecesGoWhereTheyHelp) {
  const DenseCurve curve =
      graph([](double t) { return t < 0.5 ? 4 - 2 * t : 3 + 40 * std::pow(t - 0.5, 3); }, 60);
  GraphPieces pieces(curve, {30}, kSlopes, 20, 1e-3);
  const std::vector<int> count = pieces.within(1e-2, 40);
  ASSERT_EQ(count.size(), 2U);
  EXPECT_EQ(count[0], 1);
  EXPECT_GT(count[1], 1);
  int before = 2;
  for (const int most : {2, 3, 4, 6}) {
    const std::vector<int> few = pieces.within(0, most);
    const int sum = few[0] + few[1];
    EXPECT_GE(sum, before);
    EXPECT_LE(sum, most + 1);
    before = sum;
  }
  // At most one piece between any two of the forty places and the ends.
  EXPECT_LE(pieces.within(0, 1000)[1], 42);
}

}  // namespace
}  // namespace keyline::fairing::detail
