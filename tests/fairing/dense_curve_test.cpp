#include "keyline/fairing/dense_curve.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "keyline/lac/segment/segment.h"

/// A curve in cells, against the pieces it stands for.
namespace keyline::fairing::detail {
namespace {

constexpr double kPi = std::numbers::pi;

/// One log-aesthetic piece of that length in even cells, laid out exactly.
DenseCurve of_piece(const lac::Segment& s, int cells) {
  DenseCurve curve;
  curve.length = s.length;
  for (int i = 0; i <= cells; ++i) {
    const double t = double(i) / cells;
    const core::Pose2 pose = lac::pose_at(s, t);
    curve.at.push_back(t);
    curve.joints.push_back({pose.position, pose.direction, lac::curvature(s, t) * s.length});
  }
  curve.cut = {0, cells};
  curve.alpha = {s.alpha};
  curve.value = {s.curvature_start * s.length, s.curvature_end * s.length};
  return curve;
}

const lac::Segment kPiece{{{1, 2}, 0.4}, -0.6, 2, 0.3, 1.1};

TEST(DenseCurve, PiecesOfItsCells) {
  DenseCurve curve = of_piece(kPiece, 5);
  curve.cut = {0, 2, 5};
  EXPECT_EQ(pieces_of(curve), (std::vector<int>{0, 0, 1, 1, 1}));
  set_free(curve);
  EXPECT_EQ(curve.cut, (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(curve.alpha, std::vector<double>(5, -1));
  ASSERT_EQ(curve.value.size(), 6U);
  for (int i = 0; i <= 5; ++i) EXPECT_EQ(curve.value[i], curve.joints[i].curvature);
}

TEST(DenseCurve, KindsTellWhatIsFlat) {
  DenseCurve curve = of_piece(kPiece, 2);
  EXPECT_FALSE(flat(curve, 0));
  curve.kind = {PieceKind::curve};
  EXPECT_FALSE(flat(curve, 0));
  curve.kind = {PieceKind::arc};
  EXPECT_TRUE(flat(curve, 0));
  curve.kind = {PieceKind::line};
  EXPECT_TRUE(flat(curve, 0));
}

// Curvature at a cell's ends and middle, and how it depends on the piece's ends by differences.
TEST(ShapesOf, AreTheCurvaturesOfThePiece) {
  for (const double alpha : {-1.0, -0.6, 0.8}) {
    lac::Segment s = kPiece;
    s.alpha = alpha;
    DenseCurve curve = of_piece(s, 4);
    for (FitJoint& joint : curve.joints) joint.curvature = 99;
    const auto shapes = shapes_of(curve);
    ASSERT_EQ(shapes.size(), 4U);
    for (int c = 0; c < 4; ++c) {
      const double h = 1e-6;
      for (int q = 0; q < 3; ++q) {
        const double t = (c + 0.5 * q) / 4;
        EXPECT_NEAR(shapes[c].curvature[q], 2 * lac::curvature(s, t), 1e-12);
        const auto at = [&](double da, double db) {
          lac::Segment moved = s;
          moved.curvature_start += da / 2;
          moved.curvature_end += db / 2;
          return 2 * lac::curvature(moved, t);
        };
        EXPECT_NEAR(shapes[c].by_start[q], (at(h, 0) - at(-h, 0)) / (2 * h), 1e-8);
        EXPECT_NEAR(shapes[c].by_end[q], (at(0, h) - at(0, -h)) / (2 * h), 1e-8);
      }
      const double direction = curve.joints[c].direction;
      EXPECT_NEAR(shapes[c].tangent.x, std::cos(direction), 1e-15);
      EXPECT_NEAR(shapes[c].tangent.y, std::sin(direction), 1e-15);
    }
    for (int i = 0; i <= 4; ++i)
      EXPECT_NEAR(curve.joints[i].curvature, 2 * lac::curvature(s, i / 4.0), 1e-12);
  }
}

// An arc has the curvature of its start, whatever stood at its end.
TEST(ShapesOf, ArcsAreOfOneCurvature) {
  DenseCurve curve = of_piece(kPiece, 4);
  curve.cut = {0, 2, 4};
  curve.alpha = {-1, -1};
  curve.value = {0.5, 0.7, 0.9};
  curve.kind = {PieceKind::arc, PieceKind::curve};
  const auto shapes = shapes_of(curve);
  EXPECT_EQ(curve.value, (std::vector<double>{0.5, 0.5, 0.9}));
  EXPECT_EQ(shapes[1].curvature[2], 0.5);
  EXPECT_EQ(shapes[1].by_start[2], 1);
  EXPECT_EQ(shapes[1].by_end[2], 0);
  EXPECT_NEAR(shapes[2].curvature[1], 0.6, 1e-15);
}

// Places in the cells of a clothoid, whose curvature a parabola is exactly.
TEST(PlaceInCell, IsWhereTheClothoidIs) {
  lac::Segment s = kPiece;
  s.alpha = -1;
  DenseCurve curve = of_piece(s, 5);
  const auto shapes = shapes_of(curve);
  for (int c = 0; c < 5; ++c)
    for (const double v : {0.0, 0.3, 1.0}) {
      const core::Pose2 pose = lac::pose_at(s, (c + v) / 5);
      const CellPlace place = place_in_cell(curve, shapes[c], c, v);
      EXPECT_NEAR(place.at.x, pose.position.x, 1e-11);
      EXPECT_NEAR(place.at.y, pose.position.y, 1e-11);
      EXPECT_NEAR(place.angle, pose.direction, 1e-12);
      EXPECT_NEAR(place.tangent.x, std::cos(pose.direction), 1e-12);
      EXPECT_NEAR(place.tangent.y, std::sin(pose.direction), 1e-12);
      const CellPlace same = place_of(curve, shapes, {c, v});
      EXPECT_EQ(same.at, place.at);
    }
}

// By the piece's end curvatures, the start of the cell held.
TEST(PlaceInCell, DependsOnThePiecesEndsAsDifferencesSay) {
  DenseCurve curve = of_piece(kPiece, 3);
  const auto shapes = shapes_of(curve);
  const double h = 1e-6;
  for (int c = 0; c < 3; ++c) {
    const CellPlace place = place_in_cell(curve, shapes[c], c, 0.7);
    for (const int end : {0, 1}) {
      const auto moved = [&](double by) {
        DenseCurve other = curve;
        other.value[end] += by;
        const auto own = shapes_of(other);
        return place_in_cell(other, own[c], c, 0.7);
      };
      const CellPlace up = moved(h), down = moved(-h);
      const core::Vector2 by = end == 0 ? place.by_start : place.by_end;
      EXPECT_NEAR(by.x, (up.at.x - down.at.x) / (2 * h), 1e-9);
      EXPECT_NEAR(by.y, (up.at.y - down.at.y) / (2 * h), 1e-9);
      EXPECT_NEAR(end == 0 ? place.angle_by_start : place.angle_by_end,
                  (up.angle - down.angle) / (2 * h), 1e-9);
    }
  }
}

// The first node of a closed curve is the last, a turn further.
TEST(BegunAt, IsTheSameCurveFromAnotherNode) {
  const lac::Segment circle{{{1, 0}, kPi / 2}, -1, 2 * kPi, 1, 1};
  DenseCurve curve = of_piece(circle, 8);
  curve.closed = true;
  curve.turning = 2 * kPi;
  curve.feet = {{0, 0.5}, {3, 0.25}, {7, 1}};
  curve.sense.assign(1, 1);
  curve.cut = {0, 2, 8};
  curve.alpha = {-1, -1};
  curve.value.assign(3, 2 * kPi);
  curve.side = {1, -1, 1};
  const DenseCurve next = begun_at(curve, 3);
  ASSERT_EQ(next.at.size(), 9U);
  for (int i = 0; i <= 8; ++i) {
    EXPECT_NEAR(next.at[i], i / 8.0, 1e-15);
    const double t = (3 + i) * kPi / 4;
    EXPECT_NEAR(next.joints[i].position.x, std::cos(t), 1e-12) << i;
    EXPECT_NEAR(next.joints[i].position.y, std::sin(t), 1e-12) << i;
    EXPECT_NEAR(next.joints[i].direction, t + kPi / 2, 1e-12) << i;
  }
  EXPECT_EQ(next.feet[0].piece, 5);
  EXPECT_EQ(next.feet[1].piece, 0);
  EXPECT_EQ(next.feet[2].piece, 4);
  EXPECT_EQ(next.feet[1].fraction, 0.25);
  EXPECT_TRUE(next.sense.empty());
  EXPECT_EQ(next.side, (std::vector<signed char>{0, 0, 0, 0, 0, 1, 0, -1, 0}));
  EXPECT_EQ(next.alpha.size(), 8U);
  const DenseCurve same = begun_at(curve, 0);
  EXPECT_EQ(same.alpha.size(), 2U);
  EXPECT_EQ(same.feet[1].piece, 3);
}

TEST(DenseCurve, PlacesAlongAreSharesOfTheLength) {
  DenseCurve curve = of_piece(kPiece, 4);
  curve.at = {0, 0.1, 0.3, 0.6, 1};
  EXPECT_NEAR(place_along(curve, {0, 0.5}), 0.05, 1e-15);
  EXPECT_NEAR(place_along(curve, {3, 0.25}), 0.7, 1e-15);
}

// A way of more than twice the gap and four tolerances, but less than half of all.
TEST(Wanders, TellsWaysFarLongerThanGaps) {
  DenseCurve curve = of_piece({{{0, 0}, 0}, -1, 1, 0, 0}, 10);
  curve.feet = {{0, 0}, {3, 0}};
  const auto with_gap = [&](double gap, double tolerance) {
    const std::vector<FitPoint> points{{.position = {0, 0}}, {.position = {gap, 0}}};
    return wanders(curve, points, tolerance);
  };
  EXPECT_FALSE(with_gap(0.151, 0));
  EXPECT_TRUE(with_gap(0.149, 0));
  EXPECT_FALSE(with_gap(0.1, 0.0251));
  EXPECT_TRUE(with_gap(0.1, 0.0249));
  curve.feet = {{0, 0}, {6, 0}};
  EXPECT_FALSE(with_gap(0.1, 0));
}

TEST(Wanders, OfClosedCurvesCountsAcrossTheSeam) {
  DenseCurve curve = of_piece({{{0, 0}, 0}, -1, 1, 0, 0}, 10);
  const std::vector<FitPoint> points{
      {.position = {0, 0}}, {.position = {0.3, 0}}, {.position = {0.6, 0}}};
  curve.feet = {{1, 0}, {4, 0}, {7, 0}};
  EXPECT_FALSE(wanders(curve, points, 0));
  curve.closed = true;
  EXPECT_FALSE(wanders(curve, points, 0));  // from 0.7 on to 1.1 a way of 0.4, a gap of 0.6
  const std::vector<FitPoint> near{
      {.position = {0, 0}}, {.position = {0.3, 0}}, {.position = {0.1, 0}}};
  EXPECT_TRUE(wanders(curve, near, 0));
}

TEST(OffsetOf, IsPositiveLeftOfTheCurve) {
  CellPlace place;
  place.at = {1, 1};
  place.tangent = {0, 1};
  EXPECT_EQ(offset_of({.position = {0, 5}}, place), 1);
  EXPECT_EQ(offset_of({.position = {3, 5}, .share = 0.5}, place), -1);
}

// Feet come home: to the point of the circle in the same direction from its centre, over joints and
// the seam.
TEST(MoveFoot, ComesToTheNearestPointOfACircle) {
  const lac::Segment circle{{{1, 0}, kPi / 2}, -1, 2 * kPi, 1, 1};
  DenseCurve curve = of_piece(circle, 24);
  curve.closed = true;
  curve.turning = 2 * kPi;
  const auto shapes = shapes_of(curve);
  for (const double angle : {0.1, 1.0, 3.0, 6.2})
    for (const double radius : {0.7, 1.0, 1.4})
      for (const double away : {-0.4, 0.3}) {
        double from = angle + away;
        from -= 2 * kPi * std::floor(from / (2 * kPi));
        const double cell = from / (2 * kPi) * 24;
        Foot foot{static_cast<int>(cell), cell - std::floor(cell)};
        const FitPoint point{.position = {radius * std::cos(angle), radius * std::sin(angle)}};
        for (int i = 0; i < 12; ++i) move_foot(curve, shapes, point, foot);
        EXPECT_NEAR(place_along(curve, foot) * 2 * kPi, angle, 1e-9) << angle << ' ' << radius;
      }
}

TEST(MoveFoot, StaysAtOpenEnds) {
  DenseCurve curve = of_piece({{{0, 0}, 0}, -1, 1, 0, 0}, 4);
  const auto shapes = shapes_of(curve);
  Foot foot{1, 0.5};
  for (int i = 0; i < 6; ++i) move_foot(curve, shapes, {.position = {-1, 0.1}}, foot);
  EXPECT_EQ(foot.piece, 0);
  EXPECT_EQ(foot.fraction, 0);
  for (int i = 0; i < 6; ++i) move_foot(curve, shapes, {.position = {2, 0.1}}, foot);
  EXPECT_EQ(foot.piece, 3);
  EXPECT_EQ(foot.fraction, 1);
}

// A line's foot is right at one step, however far it goes within one cell.
TEST(MoveFoot, OnALineIsExactAtOnce) {
  DenseCurve curve = of_piece({{{0, 0}, 0}, -1, 2, 0, 0}, 1);
  const auto shapes = shapes_of(curve);
  Foot foot{0, 0.1};
  move_foot(curve, shapes, {.position = {1.5, 3}}, foot);
  EXPECT_NEAR(foot.fraction, 0.75, 1e-14);
}

// Of clothoids curvature changes evenly: the change squared over the share of the length.
TEST(Variation, OfClothoidsIsTheSquareOfTheirRise) {
  DenseCurve curve = of_piece(kPiece, 4);
  curve.cut = {0, 1, 4};
  curve.alpha = {-1, -1};
  curve.value = {1, 3, 2.5};
  EXPECT_NEAR(variation(curve), 4 / 0.25 + 0.25 / 0.75, 1e-13);
  const PieceEnergy first = energy_of(curve, 0);
  EXPECT_NEAR(first.root, 2 / std::sqrt(0.25), 1e-14);
  EXPECT_NEAR(first.by_end, 1 / std::sqrt(0.25), 1e-14);
  EXPECT_NEAR(first.by_start, -1 / std::sqrt(0.25), 1e-14);
  EXPECT_NEAR(energy_of(curve, 1).root, -0.5 / std::sqrt(0.75), 1e-14);
  curve.kind = {PieceKind::curve, PieceKind::arc};
  EXPECT_NEAR(variation(curve), 4 / 0.25, 1e-13);
}

// A steep piece in one cell is parted; feet stay where they are along the curve and cells end where
// the piece does.
TEST(RefineCells, PartsWhatNoParabolaFollows) {
  const lac::Segment steep{{{0, 0}, 0}, -0.3, 1, 0.01, 6};
  DenseCurve curve = of_piece(steep, 2);
  curve.feet = {{0, 0.3}, {1, 0.9}, {1, 1}};
  const DenseCurve before = curve;
  refine_cells(curve);
  ASSERT_GT(curve.at.size(), before.at.size());
  EXPECT_EQ(curve.at.front(), 0);
  EXPECT_EQ(curve.at.back(), 1);
  EXPECT_EQ(curve.cut, (std::vector<int>{0, static_cast<int>(curve.at.size()) - 1}));
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_NEAR(place_along(curve, curve.feet[j]), place_along(before, before.feet[j]), 1e-14);
  for (std::size_t i = 0; i < curve.at.size(); ++i)
    EXPECT_NEAR(curve.joints[i].curvature, lac::curvature(steep, curve.at[i]), 1e-12);
  const std::size_t cells = curve.at.size();
  refine_cells(curve);
  EXPECT_EQ(curve.at.size(), cells);  // fine enough now
}

TEST(RefineCells, LeavesClothoidsAlone) {
  lac::Segment s = kPiece;
  s.alpha = -1;
  DenseCurve curve = of_piece(s, 3);
  refine_cells(curve);
  EXPECT_EQ(curve.at.size(), 4U);
}

// Of curvature that grows e-fold along a cell Simpson's rule tells the turn with one part and with
// two: farther apart than 1e-8 the cell is parted once, and then they are 15.6 times as near.
TEST(RefineCells, PartsWhereSumsAreFartherApartThanTheLimit) {
  const double e = std::exp(0.25);
  const double one = (1 + 4 * std::pow(e, 2) + std::pow(e, 4)) / 6;
  const double two = (1 + 4 * e + 2 * std::pow(e, 2) + 4 * std::pow(e, 3) + std::pow(e, 4)) / 12;
  for (const auto& [apart, nodes] :
       {std::pair{0.95e-8, 2U}, {1.05e-8, 3U}, {15e-8, 3U}, {17e-8, 5U}}) {
    const double from = apart / (one - two);
    DenseCurve curve = of_piece({{{0, 0}, 0}, 0, 1, from, from * std::exp(1.0)}, 1);
    refine_cells(curve);
    EXPECT_EQ(curve.at.size(), nodes) << apart;
  }
}

std::vector<FitPoint> circle(int n) {
  std::vector<FitPoint> points;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * kPi * i / n;
    points.push_back({.position = {std::cos(t), std::sin(t)}});
  }
  return points;
}

TEST(DenseCurveOf, StandsAtItsPointsAndEvenlyBetweenThem) {
  const auto points = circle(60);
  const DenseCurve curve = dense_curve(points, true, 120);
  EXPECT_TRUE(curve.closed);
  EXPECT_NEAR(curve.turning, 2 * kPi, 1e-12);
  EXPECT_NEAR(curve.length, 60 * 2 * std::sin(kPi / 60), 1e-12);
  // Cells turn by a tenth at most: a gap of 0.105 is parted in two, as 120 cells ask for too.
  ASSERT_EQ(curve.at.size(), 121U);
  ASSERT_EQ(curve.feet.size(), 60U);
  for (int j = 0; j < 60; ++j) {
    EXPECT_EQ(curve.feet[j].piece, 2 * j);
    EXPECT_EQ(curve.feet[j].fraction, 0);
  }
  for (int i = 0; i <= 120; ++i) EXPECT_NEAR(curve.at[i], i / 120.0, 1e-12);
  // Parabolas through five neighbours of a circle.
  for (int i = 0; i <= 120; i += 7) {
    const double t = 2 * kPi * i / 120;
    EXPECT_NEAR(curve.joints[i].position.x, std::cos(t), 2e-3);
    EXPECT_NEAR(curve.joints[i].direction, t + kPi / 2, 2e-3);
    EXPECT_NEAR(curve.joints[i].curvature, curve.length, 0.01 * curve.length);
  }
  EXPECT_EQ(curve.value.size(), 121U);
}

// Limaçons with an inner loop turn twice, figures of eight not at all.
TEST(DenseCurveOf, TurningIsOfWholeTurns) {
  for (const int turns : {-2, -1, 0, 1, 2}) {
    std::vector<FitPoint> points;
    for (int i = 0; i < 200; ++i) {
      const double t = 2 * kPi * i / 200, way = turns < 0 ? -t : t;
      const double r = std::abs(turns) == 2 ? 1 + 2 * std::cos(t) : 3;
      points.push_back({.position = {r * std::cos(way), r * std::sin(way)}});
      if (turns == 0) points.back().position = {std::sin(t), std::sin(2 * t)};
    }
    EXPECT_NEAR(dense_curve(points, true, 240).turning, 2 * kPi * turns, 1e-12) << turns;
  }
}

TEST(DenseCurveOf, BendsArePartedWhereGapsAreWide) {
  const DenseCurve coarse = dense_curve(circle(60), true, 1);
  EXPECT_EQ(coarse.at.size(), 121U);  // 0.105 of a turn each: two cells
  const DenseCurve wide = dense_curve(circle(20), true, 1);
  // 2 pi / 20 is 0.31; its parabolas are a little flatter: four cells a gap.
  EXPECT_EQ(wide.at.size(), 81U);
}

TEST(DenseCurveOf, OpenEndsAreFeetToo) {
  std::vector<FitPoint> points;
  for (const double x : {0.0, 0.2, 0.3, 1.0}) points.push_back({.position = {x, 0}});
  const DenseCurve curve = dense_curve(points, false, 10);
  EXPECT_FALSE(curve.closed);
  ASSERT_EQ(curve.at.size(), 11U);
  ASSERT_EQ(curve.feet.size(), 4U);
  EXPECT_EQ(curve.feet[1].piece, 2);
  EXPECT_EQ(curve.feet[2].piece, 3);
  EXPECT_EQ(curve.feet[3].piece, 9);
  EXPECT_EQ(curve.feet[3].fraction, 1);
}

}  // namespace
}  // namespace keyline::fairing::detail
