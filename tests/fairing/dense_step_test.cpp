#include "keyline/fairing/dense_step.h"

#include <cmath>

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

TEST(DenseStep, MeantRisesAreEndsLessStarts) {
  DenseStep step = step_of(4);
  step.state[2](4) = 9;
  EXPECT_EQ(meant_rises(three(), step), (std::vector<double>{1, 6}));
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

}  // namespace
}  // namespace keyline::fairing::detail
