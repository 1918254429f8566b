#include "keyline/fairing/graph_pieces.h"

#include <cmath>
#include <functional>

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
    const GraphPieces pieces(curve, {}, kSlopes, 25, 1e-3);
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
  const GraphPieces pieces(curve, {}, kSlopes, 25, 1e-3);
  const DenseCurve cut = pieces.cut_by({1});
  EXPECT_EQ(cut.alpha[0], -1);  // of slope -3, which is not to be had there
  const DenseCurve falling = graph([](double t) { return 4 - 8 * t; });
  EXPECT_EQ(GraphPieces(falling, {}, kSlopes, 25, 1e-3).cut_by({1}).sense,
            std::vector<signed char>{-1});
}

// Straight lines with a bend in the graph: two pieces, cut where it bends.
TEST(GraphPieces, CutsWhereTheGraphBends) {
  const auto k = [](double t) { return t < 0.4 ? 1 + t : 1.4 + 20 * (t - 0.4); };
  const DenseCurve curve = graph(k);
  const GraphPieces pieces(curve, {}, kSlopes, variation(curve), 1e-4);
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
  const GraphPieces pieces(curve, {120}, kSlopes, variation(curve), 1e-4);
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
  const GraphPieces pieces(curve, {}, kSlopes, variation(curve), 1e-4);
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
  const GraphPieces pieces(curve, {20, 60}, kSlopes, variation(curve), 1e-2);
  const DenseCurve cut = pieces.cut_by({1, 1});
  EXPECT_NEAR(cut.value[0], 6, 1e-12);
  EXPECT_NEAR(cut.value[1], 4, 1e-12);
  EXPECT_NEAR(cut.value[2], 6, 1e-12);
  EXPECT_EQ(cut.cut, (std::vector<int>{0, 40, 80}));
  EXPECT_EQ(cut.sense, (std::vector<signed char>{-1, 1}));
}

}  // namespace
}  // namespace keyline::fairing::detail
