#include "keyline/surface/network.h"

#include <cmath>

#include <gtest/gtest.h>

#include "test_surfaces.h"

namespace keyline::surface {
namespace {

using classa::CavOptions;
using core::Point3;
using core::Vector3;

/// Edges of a cubic in the plane of (right, up): v, Mv, M^2 v.
std::vector<Vector3> matrix_edges(double alpha, double s, double length, Vector3 right,
                                  Vector3 up) {
  std::vector<Vector3> edges;
  for (int i = 0; i < 3; ++i)
    edges.push_back(length * std::pow(s, i) *
                    (std::cos(i * alpha) * right + std::sin(i * alpha) * up));
  return edges;
}

BezierSurface translational(const std::vector<Vector3>& row, const std::vector<Vector3>& column) {
  BezierSurface s{{4, 4, {}}, {}};
  Point3 start{10, 20, 5};
  for (int i = 0; i < 4; ++i) {
    Point3 p = start;
    for (int j = 0; j < 4; ++j) {
      s.net.points.push_back(p);
      if (j < 3) p = p + row[j];
    }
    if (i < 3) start = start + column[i];
  }
  return s;
}

/// All eight curves with the one matrix each.
BezierSurface one_matrix_patch(double alpha_row, double s_row, double alpha_column,
                               double s_column) {
  return translational(matrix_edges(alpha_row, s_row, 40, {1, 0, 0}, {0, 0, 1}),
                       matrix_edges(alpha_column, s_column, 30, {0, 1, 0}, {0, 0, 1}));
}

double sav_of(const BezierSurface& s, const CavOptions& options = {}) {
  const auto value = sav(s, options);
  EXPECT_TRUE(value) << value.error().message;
  return value ? value->sav : -1;
}

TEST(NetworkCurves, RowsThenColumns) {
  const auto curves = network_curves(wavy_net(4, 4));
  ASSERT_EQ(curves.size(), 8U);
  EXPECT_EQ(curves[0].name, "A1");
  EXPECT_EQ(curves[3].control, row_of(wavy_net(4, 4), 3));
  EXPECT_EQ(curves[4].name, "A5");
  EXPECT_FALSE(curves[4].is_row);
  EXPECT_EQ(curves[7].control, column_of(wavy_net(4, 4), 3));
  EXPECT_EQ(network_curves(wavy_net(2, 16)).size(), 18U);
}

TEST(SurfaceValue, TypesFourAndFiveGiveTheNumbersOfEquation10) {
  // Type 4 all over: every curve planar with ratios that are not one.
  const auto row = matrix_edges(0.2, 1.2, 40, {1, 0, 0}, {0, 0, 1});
  auto uneven = row;
  uneven[2] = 1.3 * uneven[2];
  const auto column = matrix_edges(0.3, 1.1, 30, {0, 1, 0}, {0, 0, 1});
  auto bent = column;
  bent[2] = 0.9 * bent[2];
  const double all_four = sav_of(translational(uneven, bent));
  EXPECT_EQ(std::round(all_four), 110);
  EXPECT_NEAR(all_four, 109.9, 0.05);
  // Type 5 all over: S-shaped rows and columns.
  auto s_row = row;
  s_row[2] = {row[2].x, 0, -row[2].z};
  auto s_column = column;
  s_column[2] = {0, column[2].y, -column[2].z};
  const double all_five = sav_of(translational(s_row, s_column));
  EXPECT_EQ(std::round(all_five), 407);
  EXPECT_NEAR(all_five, 407.3, 0.05);
}

TEST(SurfaceValue, TwoOfTypeFiveAndSixOfTypeThreeAddUpAsTab3Does) {
  // Rows and columns of type 3, each with one matrix outside Class A.
  BezierSurface s = one_matrix_patch(0.6, 1.1, 0.5, 1.05);
  const classa::Diagonals d = classa::diagonals(1.0982);
  const auto before = sav(s);
  ASSERT_TRUE(before);
  double six = 0;
  for (const auto& c : before->curves) EXPECT_EQ(c.value.type, 3) << c.name;
  // One point moved out of its row's and its column's plane makes one row and one column type 5.
  s.net.at(1, 2).x += 3;
  s.net.at(1, 2).y += 2;
  const auto after = sav(s);
  ASSERT_TRUE(after);
  int fives = 0;
  for (const auto& c : after->curves) {
    if (c.value.type == 5) {
      ++fives;
      continue;
    }
    EXPECT_EQ(c.value.type, 3) << c.name;
    const double l =
        classa::plane_distance(*c.value.matrix, {c.value.minimum->alpha, c.value.minimum->s});
    six += d.boundary * (1 + l);
  }
  EXPECT_EQ(fives, 2);
  EXPECT_NEAR(after->sav, 2 * std::pow(d.boundary * d.plane, 3) + six, 1e-9);
  EXPECT_EQ(after->curves[after->worst].name, "A2");
}

TEST(SurfaceValue, ClassAPatchesStayBelowTwelve) {
  double most = 0;
  for (const double a : {0.1, 0.4, 0.7, 0.95})
    for (const double more : {1.0, 1.2, 1.5}) {
      const BezierSurface s = one_matrix_patch(a, more / std::cos(a), 0.3, 1.3);
      const auto value = sav(s);
      ASSERT_TRUE(value);
      for (const auto& c : value->curves) EXPECT_LE(c.value.type, 2);
      most = std::max(most, value->sav);
    }
  EXPECT_LT(most, 12);
  EXPECT_GT(most, 0);
}

/// The matrix of least energy for its own end, held exactly.
classa::ControlMatrix best_matrix(double chord_angle) {
  classa::EnergyConditions c;
  c.chord = {std::cos(chord_angle), std::sin(chord_angle)};
  const auto m = classa::minimum_energy(c);
  EXPECT_TRUE(m);
  return {m->alpha, m->s};
}

TEST(SurfaceValue, TranslationalPatchAtMinimumEnergyHasNone) {
  const auto row = best_matrix(0.5);
  const auto column = best_matrix(0.3);
  const BezierSurface s = one_matrix_patch(row.alpha, row.s, column.alpha, column.s);
  CavOptions held;
  held.end_tolerance = 0;
  const auto value = sav(s, held);
  ASSERT_TRUE(value);
  EXPECT_EQ(value->sav, 0);
  for (const auto& c : value->curves) EXPECT_EQ(c.value.type, 1) << c.name;
  EXPECT_LT(sav_of(s), 1);  // an end free by 1 % of the chord leaves a little to gain
}

TEST(SurfaceValue, DoesNotDependOnPoseOrOnWhichCornerComesFirst) {
  BezierSurface s = one_matrix_patch(0.6, 1.1, 0.3, 1.3);
  s.net.at(3, 3).z += 4;
  const double value = sav_of(s);
  BezierSurface moved = s;
  const double c = std::cos(0.7);
  const double d = std::sin(0.7);
  for (Point3& p : moved.net.points)
    p = {3 * (c * p.x - d * p.z), 3 * p.y, 3 * (d * p.x + c * p.z)};
  EXPECT_NEAR(sav_of(moved), value, 1e-6);
  EXPECT_NEAR(sav_of(transposed(s)), value, 1e-9);
  EXPECT_NEAR(sav_of(reversed_u(s)), value, 1e-6);
}

TEST(SurfaceValue, OtherDegreesCountAllRowsAndColumns) {
  const auto value = sav(BezierSurface{wavy_net(2, 16), {}});
  ASSERT_TRUE(value) << value.error().message;
  EXPECT_EQ(value->curves.size(), 18U);
  const BezierSurface flat{wavy_net(2, 2), {}};
  EXPECT_EQ(sav_of(flat), 0);  // straight lines
}

TEST(SurfaceValue, DegenerateNetsScoreOrSayWhatIsWrong) {
  BezierSurface collapsed = one_matrix_patch(0.6, 1.1, 0.3, 1.3);
  for (int j = 0; j < 4; ++j) collapsed.net.at(3, j) = {1, 2, 3};
  const auto value = sav(collapsed);
  ASSERT_TRUE(value) << value.error().message;
  EXPECT_EQ(value->curves[3].value.type, 5);
  const BezierSurface point{{4, 4, std::vector<Point3>(16, {1, 2, 3})}, {}};
  EXPECT_EQ(std::round(sav_of(point)), 407);
  EXPECT_EQ(sav(sphere_octant(1)).error().code, core::ErrorCode::unsupported);
  BezierSurface bad = collapsed;
  bad.net.at(0, 1).z = INFINITY;
  EXPECT_EQ(sav(bad).error().path, "points[0][1]");
  CavOptions wide;
  wide.alpha_max = 1.6;
  EXPECT_EQ(sav(collapsed, wide).error().path, "alpha_max");
  CavOptions far;
  far.end_tolerance = 1000;
  const auto failed = sav(one_matrix_patch(0.6, 1.1, 0.3, 1.3), far);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().path, "end_tolerance");
  EXPECT_TRUE(failed.error().message.starts_with("A1: ")) << failed.error().message;
}

TEST(SurfaceValue, EveryPatchOfASplineHasItsOwn) {
  const BSplineSurface s{
      {3, 3}, {{{0, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 0, 0, 0.5, 1, 1, 1, 1}}}, wavy_net(4, 5), {}};
  const auto values = sav_by_patch(s, {}, 2);
  ASSERT_TRUE(values) << values.error().message;
  ASSERT_EQ(values->size(), 2U);
  const PatchGrid grid = to_beziers(s);
  EXPECT_EQ((*values)[1].column, 1);
  EXPECT_EQ((*values)[1].value.sav, sav_of(grid.patches[1]));
  core::Progress progress;
  progress.cancellation = core::CancellationToken::make();
  progress.cancellation.request_stop();
  EXPECT_EQ(sav_by_patch(s, {}, 1, progress).error().code, core::ErrorCode::cancelled);
}

TEST(SurfaceValue, NearestCurvesStandBesideTypesFourAndFive) {
  BezierSurface s = one_matrix_patch(0.3, 1.4, 0.2, 1.5);
  const Point3 kept = s.net.at(1, 2);
  s.net.at(1, 2) = kept + Vector3{0, 0, 0.5};
  auto values = sav_by_patch(s);
  ASSERT_TRUE(values);
  add_nearest(s, *values);
  for (const NetworkValue& c : values->front().value.curves) {
    SCOPED_TRACE(c.name);
    ASSERT_EQ(c.nearest.has_value(), c.value.type > 3);
    if (!c.nearest) continue;
    EXPECT_GT(c.nearest->nearest.distance, 0);
    EXPECT_LT(c.nearest->nearest.distance, 0.25);
    ASSERT_TRUE(c.nearest->value);
    EXPECT_LT(c.nearest->value->cav, 3);
  }
}

}  // namespace
}  // namespace keyline::surface
