#include "keyline/fairing/dense_step.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

/// Steps of a dense curve's solver, by hand.
namespace keyline::fairing::detail {
namespace {

DenseCurve three() {
  DenseCurve curve;
  curve.at = {0, 0.2, 0.5, 1};
  curve.joints.assign(4, {});
  curve.cut = {0, 2, 3};
  curve.value = {1, -2, 4};
  curve.alpha = {-1, 0.5};
  curve.length = 3;
  return curve;
}

DenseStep step_of(int nodes) {
  DenseStep step;
  for (int i = 0; i < nodes; ++i) {
    Vector6 s;
    s << 0.1 * i, 0.2, 0.3, 1.0 + i, 2.0 + i, 0.5;
    step.state.push_back(s);
  }
  return step;
}

TEST(DenseStep, MovesNodesValuesAndLength) {
  const DenseCurve next = moved(three(), step_of(4), 0.5);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(next.joints[i].position.x, 0.05 * i, 1e-15);
    EXPECT_NEAR(next.joints[i].position.y, 0.1, 1e-15);
    EXPECT_NEAR(next.joints[i].direction, 0.15, 1e-15);
  }
  // The start of the piece at node 0, of that at node 2, the end of the last.
  EXPECT_NEAR(next.value[0], 1 + 0.5 * 1, 1e-15);
  EXPECT_NEAR(next.value[1], -2 + 0.5 * 3, 1e-15);
  EXPECT_NEAR(next.value[2], 4 + 0.5 * 4, 1e-15);
  EXPECT_EQ(next.length, 3.25);
}

TEST(DenseStep, MeantEndsAreThoseWherePiecesBegin) {
  DenseStep step = step_of(4);
  step.state[2](4) = 9;
  EXPECT_EQ(meant_ends(three(), step), (std::vector<std::array<double, 2>>{{1, 2}, {3, 9}}));
}

// Poses and curvatures each by themselves: sums of squares over all nodes.
TEST(DenseStep, AlikeIsWithinAShare) {
  const DenseStep b = step_of(4);
  const auto off = [&](int k, double by) {
    DenseStep a = b;
    a.state[1](k) += by;
    return a;
  };
  double poses = 0, bends = 0;
  for (const Vector6& s : b.state) {
    poses += s.head<3>().squaredNorm();
    bends += s.segment<2>(3).squaredNorm();
  }
  EXPECT_TRUE(alike(b, b, 0.1));
  for (const int k : {0, 2}) {
    EXPECT_TRUE(alike(off(k, 0.099 * std::sqrt(poses)), b, 0.1));
    EXPECT_FALSE(alike(off(k, 0.101 * std::sqrt(poses)), b, 0.1));
  }
  for (const int k : {3, 4}) {
    EXPECT_TRUE(alike(off(k, 0.099 * std::sqrt(bends)), b, 0.1));
    EXPECT_FALSE(alike(off(k, 0.101 * std::sqrt(bends)), b, 0.1));
  }
  EXPECT_TRUE(alike(off(5, 100), b, 0.1));
}

// Where the slope allows no inflection a curvature keeps its side: a step takes 0.8 of it at most.
TEST(DenseStep, KeepsCurvaturesOnTheirSide) {
  DenseCurve curve = three();
  DenseStep step = step_of(4);
  for (Vector6& s : step.state) s.setZero();
  step.state[0](3) = -100;  // of the clothoid, which may pass
  EXPECT_EQ(keeps_side(curve, step), 1);
  step.state[2](3) = 1.5;  // the second piece's start, -2: less than 0.8 of it
  EXPECT_EQ(keeps_side(curve, step), 1);
  step.state[2](3) = 4;
  EXPECT_NEAR(keeps_side(curve, step), 0.8 * 2 / 4, 1e-15);
  step.state[2](4) = -16;  // its end, 4
  EXPECT_NEAR(keeps_side(curve, step), 0.8 * 4 / 16, 1e-15);
  step.state[2] << 0, 0, 0, -4, 16, 0;  // away from zero
  EXPECT_EQ(keeps_side(curve, step), 1);
}

TEST(DenseStep, KnowsWhereLinesEnd) {
  DenseCurve curve = three();
  EXPECT_FALSE(end_of_line(curve, 0));
  curve.kind = {PieceKind::line, PieceKind::curve};
  EXPECT_TRUE(end_of_line(curve, 0));
  EXPECT_TRUE(end_of_line(curve, 1));
  EXPECT_FALSE(end_of_line(curve, 2));
  curve.closed = true;
  EXPECT_TRUE(end_of_line(curve, 2));
  curve.kind = {PieceKind::curve, PieceKind::line};
  EXPECT_TRUE(end_of_line(curve, 0));
  curve.closed = false;
  EXPECT_FALSE(end_of_line(curve, 0));
  EXPECT_TRUE(end_of_line(curve, 2));
  curve.kind = {PieceKind::arc, PieceKind::arc};
  EXPECT_FALSE(end_of_line(curve, 1));
}

std::vector<bool> fixed(const DenseBoundary& b) {
  return std::vector<bool>(b.fixed_start, b.fixed_start + 6);
}

TEST(DenseStep, StartsAreHeldAsAsked) {
  DenseCurve curve = three();
  const auto start = [&] { return fixed(boundary_of(curve, Vector6::Zero(), Vector6::Zero(), 1)); };
  using Held = std::vector<bool>;
  EXPECT_EQ(start(), (Held{false, false, false, false, false, false}));
  curve.hold_start = Hold::position;
  EXPECT_EQ(start(), (Held{true, true, false, false, false, false}));
  curve.slides_start = true;
  EXPECT_EQ(start(), (Held{false, true, false, false, false, false}));
  curve.slides_start = false;
  curve.hold_start = Hold::direction;
  EXPECT_EQ(start(), (Held{true, true, true, false, false, false}));
  curve.hold_start = Hold::curvature;
  EXPECT_EQ(start(), (Held{true, true, true, true, false, false}));
  curve.hold_start = Hold::free;
  curve.kind = {PieceKind::line, PieceKind::curve};
  EXPECT_EQ(start(), (Held{false, false, false, true, true, false}));
  curve.kind = {PieceKind::curve, PieceKind::line};
  EXPECT_EQ(start(), (Held{false, false, false, false, true, false}));
  curve.kind = {PieceKind::arc, PieceKind::curve};
  EXPECT_EQ(start(), (Held{false, false, false, false, true, false}));
}

TEST(DenseStep, EndsAreDrawnToWhereTheyBelong) {
  DenseCurve curve = three();
  Vector6 seam, multiplier;
  seam << 1, 2, 3, 4, 5, 6;
  multiplier << 6, 5, 4, 3, 2, 1;
  const auto end = [&] { return boundary_of(curve, seam, multiplier, 10); };
  EXPECT_TRUE(end().end_hessian.isZero());
  curve.hold_end = Hold::direction;
  Vector6 weight;
  weight << 10, 10, 10, 0, 0, 0;
  EXPECT_EQ(end().end_hessian.diagonal(), weight);
  EXPECT_EQ(end().end_gradient, Vector6(weight.cwiseProduct(seam) + multiplier));
  curve.slides_end = true;
  weight(0) = 0;
  EXPECT_EQ(end().end_hessian.diagonal(), weight);
  curve.closed = true;
  curve.hold_end = Hold::free;
  weight << 10, 10, 10, 0.1, 0, 0;
  EXPECT_EQ(end().end_hessian.diagonal(), weight);
  EXPECT_TRUE(end().closed);
}

// One cell whose end goes where its start does, pulled along x with 1000 against a weight of 10,000
// that wants it at -0.2: alone that gives way by (1000 - 0.2) / 10001.
TEST(DenseStep, HeldEndsComeToWhereTheyAreHeldWhateverPulls) {
  Cell cell;
  cell.hessian = Matrix6::Identity();
  cell.gradient(0) = 1000;
  cell.step.leftCols<3>() = Eigen::Matrix3d::Identity();
  cell.passage.ends_piece = cell.passage.ends_curve = true;
  DenseBoundary boundary;
  boundary.end_hessian(0, 0) = 1e4;
  Vector6 seam = Vector6::Zero();
  seam(0) = 0.2;
  boundary.end_gradient = boundary.end_hessian * seam;
  EXPECT_NEAR(solve_cells({cell}, boundary).state.back()(0), -0.2 - 999.8 / 10001, 1e-9);
  EXPECT_NEAR(solve_held({cell}, boundary, seam).state.back()(0), -0.2, 1e-5);
  boundary.closed = true;  // then the end's way from the start, which is none, counts
  EXPECT_NEAR(solve_held({cell}, boundary, seam).state.back()(0), -1000, 1e-6);
}

// What is missing behind a cell and how that moves with the state before it, against differences.
TEST(DenseStep, StepsOfACellAreThoseOfItsEnd) {
  DenseCurve curve = three();
  curve.alpha = {-0.5, 0.5};
  curve.value = {1, 2, 4};
  curve.joints = {{{0.1, 0.2}, 0.3, 0}, {{0.7, 0.4}, 0.6, 0}, {{1.5, 1}, 1, 0}, {{2, 2}, 2, 0}};
  const auto end_of = [](DenseCurve c, int k, double by) {
    FitJoint& joint = c.joints[1];
    if (k == 0) joint.position.x += by;
    if (k == 1) joint.position.y += by;
    if (k == 2) joint.direction += by;
    if (k == 3 || k == 4) c.value[static_cast<std::size_t>(k - 3)] += by;
    if (k == 5) c.length += by;
    const auto shapes = shapes_of(c);
    return place_in_cell(c, shapes[1], 1, 1);
  };
  const Shapes shapes = shapes_of(curve);
  Cell cell;
  set_step(cell, curve, gaps_of(curve, shapes), 1);
  const CellPlace here = end_of(curve, 0, 0);
  EXPECT_NEAR(cell.gap(0), here.at.x - 1.5, 1e-14);
  EXPECT_NEAR(cell.gap(1), here.at.y - 1, 1e-14);
  EXPECT_NEAR(cell.gap(2), here.angle - 1, 1e-14);
  constexpr double h = 1e-6;
  for (int k = 0; k < 6; ++k) {
    const CellPlace up = end_of(curve, k, h), down = end_of(curve, k, -h);
    EXPECT_NEAR(cell.step(0, k), (up.at.x - down.at.x) / (2 * h), 1e-8) << k;
    EXPECT_NEAR(cell.step(1, k), (up.at.y - down.at.y) / (2 * h), 1e-8) << k;
    EXPECT_NEAR(cell.step(2, k), (up.angle - down.angle) / (2 * h), 1e-8) << k;
  }
}

TEST(DenseStep, SquaresAndSlopesAddUp) {
  Cell cell;
  Vector6 d, e;
  d << 1, 2, 0, -1, 3, 0.5;
  e << 0, 1, 1, 0, 0, 2;
  add(cell, d, 2, 7);
  add(cell, e, 0.5, -3);
  EXPECT_EQ(cell.hessian, Matrix6(2 * d * d.transpose() + 0.5 * e * e.transpose()));
  EXPECT_EQ(cell.gradient, Vector6(7 * d - 3 * e));
}

// Of places and directions alone, each as much as its cell is of the length.
TEST(DenseStep, DampingWeighsPosesByTheirCells) {
  const DenseCurve curve = three();
  std::vector<Cell> cells(3);
  damp(cells, curve, 10);
  const double share[] = {0.2, 0.3, 0.5};
  for (std::size_t i = 0; i < 3; ++i)
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(cells[i].hessian(k, k), k < 3 ? 10 * share[i] : 0, 1e-15) << i << ' ' << k;
  EXPECT_EQ(cells[0].hessian(0, 1), 0);
}

}  // namespace
}  // namespace keyline::fairing::detail
