#include "keyline/fairing/flat_pieces.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/lac/chain/chain.h"

/// Lines and arcs put into curves whose pieces are known.
namespace keyline::fairing::detail {
namespace {

/// A chain of length 1 in its pieces, so many cells each, and points on it at every node.
struct Given {
  DenseCurve curve;
  std::vector<FitPoint> points;
  BandReport band;
  FlatOptions options;
  explicit Given(const std::vector<lac::Piece>& pieces, int cells = 20, double tolerance = 1e-3) {
    const lac::Chain chain{{{0, 0}, 0.2}, pieces, false};
    double at = 0;
    int node = 0;
    curve.cut = {0};
    for (const lac::Segment& s : lac::segments(chain)) {
      for (int i = node == 0 ? 0 : 1; i <= cells; ++i) {
        const double t = double(i) / cells;
        const core::Pose2 pose = lac::pose_at(s, t);
        curve.at.push_back(at + t * s.length);
        curve.joints.push_back({pose.position, pose.direction, lac::curvature(s, t)});
        points.push_back({.position = pose.position});
      }
      at += s.length;
      node += cells;
      curve.cut.push_back(node);
      curve.alpha.push_back(s.alpha);
      curve.value.push_back(s.curvature_start);
    }
    curve.value.push_back(pieces.back().curvature_end);
    curve.at.back() = 1;
    for (int i = 0; i < node; ++i) curve.feet.push_back({i, 0});
    curve.feet.push_back({node - 1, 1});
    band.within = true;
    band.energy = variation(curve);
    options.band = {
        .tolerance = tolerance, .iterations = 40, .gap = 0.03, .warm = true, .progress = {}};
    options.noise = 1e-5;
    options.worth = 1.05;
  }
};

TEST(UnseenEnergy, IsOfATenthOfTheToleranceInUnitsOfTheLength) {
  DenseCurve curve;
  curve.length = 2;
  EXPECT_NEAR(unseen_energy(curve.length, 0.01), std::pow(32 * 0.1 * 0.01 / 2, 2), 1e-18);
}

/// Three clothoids, the one between rising by so much over 0.3.
std::vector<lac::Piece> level_between(double rise) {
  return {{-1, 0.3, 1, 3}, {-1, 0.3, 3, 3 + rise}, {-1, 0.4, 3 + rise, 6}};
}

// A piece that hardly varies becomes an arc, its neighbours stay what they are.
TEST(MakeArcs, PiecesOfNextToNoVariationBecomeArcs) {
  Given g(level_between(0.02));
  const double before = g.band.energy;
  make_arcs(g.curve, g.band, g.points, g.options);
  EXPECT_EQ(g.curve.kind, (std::vector{PieceKind::curve, PieceKind::arc, PieceKind::curve}));
  EXPECT_EQ(g.curve.value[1], g.curve.value[2]);
  EXPECT_NEAR(g.curve.value[1], 3, 0.5);
  EXPECT_EQ(g.curve.alpha[1], -1);
  EXPECT_TRUE(g.band.within);
  EXPECT_LE(g.band.energy, 1.05 * before);
  EXPECT_LE(g.band.max_offset, 1e-3);
}

// A hundredth of the energy is the most it may have: 0.3^2 / 0.3 of 31.9 is less, 0.32^2 / 0.3 of
// 31.6 more.
TEST(MakeArcs, AHundredthOfTheEnergyIsNextToNone) {
  Given less(level_between(0.3), 20, 3e-3);
  make_arcs(less.curve, less.band, less.points, less.options);
  EXPECT_EQ(less.curve.kind[1], PieceKind::arc);
  Given more(level_between(0.32), 20, 3e-3);
  make_arcs(more.curve, more.band, more.points, more.options);
  EXPECT_EQ(more.curve.kind[1], PieceKind::curve);
}

// Nothing is taken that the mean square, the energy or a neighbour's curvature forbids.
TEST(MakeArcs, StayCurvesWhereThatIsNotWorthIt) {
  const auto made = [](auto change) {
    Given g(level_between(0.02));
    change(g);
    const std::vector<double> before = g.curve.value;
    make_arcs(g.curve, g.band, g.points, g.options);
    const bool arc = g.curve.kind[1] == PieceKind::arc;
    if (!arc) {
      EXPECT_EQ(g.curve.value, before);
    }
    return arc;
  };
  EXPECT_TRUE(made([](Given&) {}));
  EXPECT_FALSE(made([](Given& g) { g.options.most_rms = 1e-9; }));
  EXPECT_FALSE(made([](Given& g) { g.options.worth = 1e-3; }));
  EXPECT_FALSE(
      made([](Given& g) { g.band.energy = 0.01; }));  // which it is more than a hundredth of
  EXPECT_FALSE(
      made([](Given& g) { g.curve.kind = {PieceKind::curve, PieceKind::curve, PieceKind::line}; }));
  EXPECT_FALSE(
      made([](Given& g) { g.curve.kind = {PieceKind::line, PieceKind::curve, PieceKind::curve}; }));
}

// Of two beside each other only the one that varies least: their curvatures would have to be one.
TEST(MakeArcs, NotTwoBesideEachOther) {
  for (const bool first : {false, true}) {
    const double a = first ? 0.005 : 0.02, b = first ? 0.02 : 0.005;
    Given g({{-1, 0.3, 1, 3},
             {-1, 0.2, 3, 3 + a},
             {-1, 0.2, 3 + a, 3 + a + b},
             {-1, 0.3, 3 + a + b, 6}});
    make_arcs(g.curve, g.band, g.points, g.options);
    EXPECT_EQ(g.curve.kind[1] == PieceKind::arc, first);
    EXPECT_EQ(g.curve.kind[2] == PieceKind::arc, !first);
  }
}

// Three that stand apart all do.
TEST(MakeArcs, SeveralAtOnce) {
  Given g({{-1, 0.15, 1, 1.01},
           {-1, 0.2, 1.01, 3},
           {-1, 0.2, 3, 3.01},
           {-1, 0.25, 3.01, 6},
           {-1, 0.2, 6, 6.01}});
  make_arcs(g.curve, g.band, g.points, g.options);
  using enum PieceKind;
  EXPECT_EQ(g.curve.kind, (std::vector{arc, curve, arc, curve, arc}));
}

// Where all of them have more energy than an answer may cost, the half that has least: the first
// here, 0.18^2 / 0.15 for 0.25^2 / 0.2.
TEST(MakeArcs, HalfOfThemWhereAllCostTooMuch) {
  const double least = 0.18 * 0.18 / 0.15, more = 0.25 * 0.25 / 0.2;
  for (const bool all : {false, true}) {
    Given g({{-1, 0.15, 1, 1.18}, {-1, 0.35, 1.18, 3}, {-1, 0.2, 3, 3.25}, {-1, 0.3, 3.25, 6}}, 20,
            3e-3);
    g.options.worth = 1 + (least + (all ? 1.5 : 0.5) * more) / g.band.energy;
    make_arcs(g.curve, g.band, g.points, g.options);
    EXPECT_EQ(g.curve.kind[0], PieceKind::arc);
    EXPECT_EQ(g.curve.kind[2], all ? PieceKind::arc : PieceKind::curve);
  }
}

/// The same as a free curve, as it is before pieces are chosen.
Given free(const std::vector<lac::Piece>& pieces) {
  Given g(pieces, 60);
  set_free(g.curve);
  g.band.energy = variation(g.curve);
  g.options.worth = 1.25;
  return g;
}

// A line of 0.4 before a bend: it becomes one from the curve's very start, short of the bend.
TEST(LayLines, PointsOnALineGetOne) {
  Given g = free({{-1, 0.4, 0, 0}, {-1, 0.3, 0, 5}, {-1, 0.3, 5, 5}});
  lay_lines(g.curve, g.band, g.points, g.options);
  ASSERT_FALSE(g.curve.kind.empty());
  EXPECT_EQ(g.curve.kind[0], PieceKind::line);
  EXPECT_EQ(g.curve.cut[0], 0);
  EXPECT_NEAR(g.curve.at[static_cast<std::size_t>(g.curve.cut[1])], 0.4, 0.09);
  EXPECT_EQ(g.curve.value[0], 0);
  EXPECT_EQ(g.curve.value[1], 0);
  for (std::size_t p = 1; p < g.curve.kind.size(); ++p)
    EXPECT_EQ(g.curve.kind[p], PieceKind::curve);
  EXPECT_TRUE(g.band.within);
}

TEST(LayLines, NotWhereItCostsTooMuch) {
  const auto laid = [](auto change) {
    Given g = free({{-1, 0.4, 0, 0}, {-1, 0.3, 0, 5}, {-1, 0.3, 5, 5}});
    change(g);
    lay_lines(g.curve, g.band, g.points, g.options);
    return !g.curve.kind.empty();
  };
  EXPECT_TRUE(laid([](Given&) {}));
  EXPECT_FALSE(laid([](Given& g) { g.options.most_rms = 1e-12; }));
  EXPECT_FALSE(laid([](Given& g) { g.options.worth = 1e-3; }));
  EXPECT_FALSE(laid([](Given& g) { g.options.noise = 1e-12; }));  // the points are not so exact
}

// A whole that is nearly an arc is one, of its mean curvature.
TEST(LayLines, NearlyAnArcIsOne) {
  Given g = free({{-1, 1, 2, 2.004}});
  lay_lines(g.curve, g.band, g.points, g.options);
  EXPECT_EQ(g.curve.kind, std::vector{PieceKind::arc});
  EXPECT_EQ(g.curve.cut, (std::vector<int>{0, 60}));
  ASSERT_EQ(g.curve.value.size(), 2U);
  EXPECT_NEAR(g.curve.value[0], 2.002, 5e-3);
  EXPECT_EQ(g.curve.value[0], g.curve.value[1]);
  EXPECT_TRUE(g.band.within);
  EXPECT_NEAR(g.band.energy, 0, 1e-12);
  // Where the bend is plain it stays as it is.
  Given bent = free({{-1, 1, 2, 3}});
  lay_lines(bent.curve, bent.band, bent.points, bent.options);
  EXPECT_TRUE(bent.curve.kind.empty());
}

TEST(LayLines, AllOnALineAreOneLine) {
  Given g = free({{-1, 1, 0, 0}});
  for (std::size_t j = 0; j < g.points.size(); ++j)
    g.points[j].position =
        g.points[j].position +
        (j % 2 == 0 ? 1e-5 : -1e-5) * core::perpendicular_left(core::unit_vector(0.2));
  g.options.noise = 2e-5;
  lay_lines(g.curve, g.band, g.points, g.options);
  EXPECT_EQ(g.curve.kind, std::vector{PieceKind::line});
  EXPECT_EQ(g.curve.value, (std::vector<double>{0, 0}));
}

}  // namespace
}  // namespace keyline::fairing::detail
