#include "keyline/fairing/dense_places.h"

#include <cmath>

#include <gtest/gtest.h>

/// Gaps and feet of a dense curve.
namespace keyline::fairing::detail {
namespace {

/// A line of two cells along x, length 2, each of half of it.
DenseCurve line() {
  DenseCurve curve;
  curve.at = {0, 0.5, 1};
  curve.joints = {{{0, 0}, 0, 0}, {{1, 0}, 0, 0}, {{2, 0}, 0, 0}};
  curve.length = 2;
  set_free(curve);
  return curve;
}

TEST(Gaps, AreCellsEndsLessTheJointsBehindThem) {
  DenseCurve curve = line();
  curve.joints[1] = {{0.9, 0.2}, 0.3, 0};
  const Gaps gaps = gaps_of(curve, shapes_of(curve));
  ASSERT_EQ(gaps.cell.size(), 2U);
  EXPECT_NEAR(gaps.cell[0](0), 0.1, 1e-14);
  EXPECT_NEAR(gaps.cell[0](1), -0.2, 1e-14);
  EXPECT_NEAR(gaps.cell[0](2), -0.3, 1e-14);
  const double x = 0.9 + std::cos(0.3) - 2, y = 0.2 + std::sin(0.3);
  EXPECT_NEAR(gaps.cell[1](0), x, 1e-13);
  EXPECT_NEAR(gaps.cell[1](1), y, 1e-13);
  EXPECT_NEAR(gaps.cell[1](2), 0.3, 1e-14);
  EXPECT_NEAR(gaps.sum, 0.6 + std::abs(x) + y + 0.3, 1e-13);
  EXPECT_EQ(gaps.seam, Vector6::Zero());
}

// Of a free end none; of a held one as much as is held, a tenth of its curvature's gap in the sum.
TEST(Gaps, OfTheSeamAreThoseOfWhatIsHeld) {
  DenseCurve curve = line();
  curve.joints[2] = {{2, 0}, 0, 0};
  curve.held_end = {{1.5, 0.25}, -0.5, 3};
  const auto seam = [&] { return gaps_of(curve, shapes_of(curve)); };
  EXPECT_EQ(seam().sum, 0);
  curve.hold_end = Hold::position;
  EXPECT_EQ(seam().seam(0), 0.5);
  EXPECT_EQ(seam().seam(1), -0.25);
  EXPECT_EQ(seam().seam(2), 0);
  EXPECT_EQ(seam().sum, 0.75);
  curve.hold_end = Hold::direction;
  EXPECT_EQ(seam().seam(2), 0.5);
  EXPECT_EQ(seam().seam(3), 0);
  curve.hold_end = Hold::curvature;
  EXPECT_EQ(seam().seam(3), -6);  // curvatures are times the length
  EXPECT_NEAR(seam().sum, 0.5 + 0.25 + 0.5 + 0.6, 1e-14);
  curve.slides_end = true;
  EXPECT_EQ(seam().seam(0), 0);
  EXPECT_EQ(seam().seam(1), -0.25);
}

TEST(Gaps, OfAClosedCurveAreThoseOfItsEnds) {
  DenseCurve curve = line();
  curve.closed = true;
  curve.turning = 6;
  curve.value.back() = 0.5;
  curve.joints[2].direction = 6.25;
  const Gaps gaps = gaps_of(curve, shapes_of(curve));
  EXPECT_EQ(gaps.seam(0), 2);
  EXPECT_EQ(gaps.seam(1), 0);
  EXPECT_NEAR(gaps.seam(2), 0.25, 1e-14);
  EXPECT_NEAR(gaps.seam(3), 0.5, 1e-14);
}

TEST(Spots, AreFeetAndOffsets) {
  DenseCurve curve = line();
  const std::vector<FitPoint> points{{.position = {0.5, 0.2}},
                                     {.position = {1.9, -0.1}, .share = 2}};
  curve.feet = {{0, 0.5}, {1, 0.5}};
  const Spots spots = spots_of(curve, shapes_of(curve), points);
  EXPECT_NEAR(spots.place[1].at.x, 1.5, 1e-14);
  EXPECT_NEAR(spots.offset[0], 0.2, 1e-15);
  EXPECT_NEAR(spots.offset[1], -0.2, 1e-15);
  EXPECT_NEAR(along(spots, points, 0), 0, 1e-14);
  EXPECT_NEAR(along(spots, points, 1), -0.4, 1e-14);
}

// Two straight cells, the second a tenth to the left: a foot that has gone over finds its point a
// tenth nearer, which is the gap's doing.
TEST(Spots, WithoutGapsAreThoseOfACurveInOnePiece) {
  DenseCurve curve = line();
  curve.joints[1].position = {1.05, 0.1};
  const std::vector<FitPoint> points{
      {.position = {1.4, 0.3}, .share = 2}, {.position = {0.7, 0.3}}, {.position = {0.2, 0.3}}};
  curve.feet = {{1, 0.7}, {0, 0.7}, {0, 0.2}};
  const Shapes shapes = shapes_of(curve);
  const Gaps gaps = gaps_of(curve, shapes);
  const Spots spots = spots_of(curve, shapes, points);
  const std::vector<Foot> before{{0, 1}, {1, 0}, {0, 0.1}};
  const std::vector<double> offset = without_gaps(spots, before, curve, gaps, points);
  EXPECT_NEAR(spots.offset[0], 2 * 0.2, 1e-14);
  EXPECT_NEAR(offset[0], 2 * 0.3, 1e-14);  // as from the first cell, where it was
  EXPECT_NEAR(spots.offset[1], 0.3, 1e-14);
  EXPECT_NEAR(offset[1], 0.2, 1e-14);  // as from the second
  EXPECT_NEAR(offset[2], 0.3, 1e-14);
}

// Three cells around a square's corner and back over the seam: over the seam is the shorter way.
TEST(Spots, WithoutGapsGoOverTheSeamWhereThatIsShorter) {
  DenseCurve curve = line();
  curve.closed = true;
  curve.at = {0, 0.25, 0.5, 0.75, 1};
  curve.joints.assign(5, {});
  for (int i = 0; i < 5; ++i) curve.joints[static_cast<std::size_t>(i)].position = {0.5 * i, 0};
  set_free(curve);
  curve.joints[4].position.y = 0.1;  // the end of the last cell lies 0.1 beside it
  const std::vector<FitPoint> points{{.position = {0, 0.3}}, {.position = {2, 0.3}}};
  curve.feet = {{0, 0}, {3, 1}};
  const Shapes shapes = shapes_of(curve);
  const Spots spots = spots_of(curve, shapes, points);
  Gaps gaps = gaps_of(curve, shapes);
  gaps.seam(1) = 0.25;  // of the last joint beside the first
  const std::vector<Foot> before{{3, 1}, {0, 0}};
  const std::vector<double> offset = without_gaps(spots, before, curve, gaps, points);
  EXPECT_NEAR(offset[0], 0.3 - (0.25 - 0.1), 1e-14);
  EXPECT_NEAR(offset[1], 0.3 + (0.25 - 0.1), 1e-14);
}

// What a state (place, direction, the piece's end curvatures, length) moves a place by, against
// differences.
TEST(Derivative, IsThatOfThePlace) {
  DenseCurve curve = line();
  curve.cut = {0, 2};
  curve.alpha = {-0.5};
  curve.value = {0.5, 2};
  curve.joints[1] = {{0.95, 0.3}, 0.6, 0};
  const core::Vector2 way{0.6, 0.8};
  const auto at = [&](int k, double by) {
    DenseCurve other = curve;
    FitJoint& joint = other.joints[1];
    (k == 0 ? joint.position.x : k == 1 ? joint.position.y : joint.direction) += k < 3 ? by : 0;
    if (k == 3 || k == 4) other.value[k - 3] += by;
    if (k == 5) other.length += by;
    const auto shapes = shapes_of(other);
    const core::Point2 p = place_in_cell(other, shapes[1], 1, 0.7).at;
    return way.x * p.x + way.y * p.y;
  };
  const auto shapes = shapes_of(curve);
  const Vector6 d = derivative(curve, place_in_cell(curve, shapes[1], 1, 0.7), 1, way);
  constexpr double h = 1e-6;
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(d(k), (at(k, h) - at(k, -h)) / (2 * h), 1e-8) << k;
}

}  // namespace
}  // namespace keyline::fairing::detail
