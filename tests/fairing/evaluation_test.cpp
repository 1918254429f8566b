#include "keyline/fairing/evaluation.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/lac/segment/segment.h"

/// A chain evaluated: offsets, rows and the model, against the segments laid out and differences.
namespace keyline::fairing::detail {
namespace {

constexpr double kPi = std::numbers::pi;

/// Two pieces that do not quite meet.
FitChain gapped() {
  FitChain chain;
  chain.joints = {{{0, 0}, 0.2, 0.5}, {{0.45, 0.2}, 0.7, 1.2}, {{0.7, 0.6}, 1.5, 2.5}};
  chain.pieces = {{.length = 0.5, .alpha = -0.5}, {.length = 0.45, .alpha = 0.6}};
  return chain;
}

lac::Segment segment_of(const FitChain& chain, int i) {
  const FitJoint& from = chain.joints[i];
  return {{from.position, from.direction},
          chain.pieces[i].alpha,
          chain.pieces[i].length,
          from.curvature,
          chain.joints[i + 1].curvature};
}

ChainFitOptions fine() {
  ChainFitOptions options;
  options.fine = true;
  return options;
}

TEST(Evaluation, OffsetsArePositiveLeftOfTheChain) {
  FitChain chain = gapped();
  const core::Pose2 pose = lac::pose_at(segment_of(chain, 1), 0.4);
  const core::Vector2 left{-std::sin(pose.direction), std::cos(pose.direction)};
  const std::vector<FitPoint> points{{.position = pose.position + 0.03 * left},
                                     {.position = pose.position - 0.02 * left, .share = 0.5}};
  chain.feet = {{1, 0.4}, {1, 0.4}};
  const Evaluation evaluation(chain, points, fine());
  EXPECT_NEAR(evaluation.offset(0), 0.03, 1e-12);
  EXPECT_NEAR(evaluation.offset(1), -0.01, 1e-12);
}

// Beyond the ends of an open chain it is the distance from the end, with the side's sign.
TEST(Evaluation, BeyondItsEndsTheDistanceCounts) {
  FitChain chain = gapped();
  const core::Vector2 tangent{std::cos(0.2), std::sin(0.2)};
  const core::Vector2 left{-tangent.y, tangent.x};
  const std::vector<FitPoint> points{
      {.position = core::Point2{0, 0} + (-0.03) * tangent + 0.04 * left},
      {.position = core::Point2{0, 0} + (-0.03) * tangent - 0.04 * left}};
  chain.feet = {{0, 0}, {0, 0}};
  {
    const Evaluation evaluation(chain, points, fine());
    EXPECT_NEAR(evaluation.offset(0), 0.05, 1e-12);
    EXPECT_NEAR(evaluation.offset(1), -0.05, 1e-12);
  }
  chain.closed = true;
  const Evaluation round(chain, points, fine());
  EXPECT_NEAR(round.offset(0), 0.04, 1e-12);
}

TEST(Evaluation, OnlyTheOutermostFeetAreBeyondTheEnds) {
  FitChain chain = gapped();
  const core::Pose2 end = lac::end_pose(segment_of(chain, 1));
  const core::Pose2 joint = lac::end_pose(segment_of(chain, 0));
  const auto ahead = [](const core::Pose2& p) {
    return p.position + 0.03 * core::Vector2{std::cos(p.direction), std::sin(p.direction)};
  };
  const std::vector<FitPoint> points{{.position = ahead(end)}, {.position = ahead(joint)}};
  chain.feet = {{1, 1}, {0, 1}};
  const Evaluation evaluation(chain, points, fine());
  EXPECT_NEAR(std::abs(evaluation.offset(0)), 0.03, 1e-12);
  EXPECT_NEAR(evaluation.offset(1), 0, 1e-12);
}

/// The chain with one of the seven variables of its second piece changed.
FitChain changed(FitChain chain, int variable, double by) {
  FitJoint& joint = chain.joints[1];
  if (variable == kX) joint.position.x += by;
  if (variable == kY) joint.position.y += by;
  if (variable == kDirection) joint.direction += by;
  if (variable == kCurvature) joint.curvature += by;
  if (variable == kNextCurvature) chain.joints[2].curvature += by;
  if (variable == kLengthAt) chain.pieces[1].length += by;
  if (variable == kAlphaAt) chain.pieces[1].alpha += by;
  return chain;
}

TEST(Evaluation, RowsDependOnTheSevenVariablesAsDifferencesSay) {
  const FitChain chain = gapped();
  const std::vector<FitPoint> points{{.position = {0.6, 0.45}}};
  const auto row = [&](int k, double by) {
    FitChain other = changed(chain, k, by);
    other.feet = {{1, 0.35}};
    return Evaluation(other, points, fine()).row(0);
  };
  const auto here = row(0, 0);
  EXPECT_EQ(here.piece, 1);
  const core::Pose2 pose = lac::pose_at(segment_of(chain, 1), 0.35);
  const core::Vector2 miss = pose.position - points[0].position;
  const double c = std::cos(pose.direction), s = std::sin(pose.direction);
  EXPECT_NEAR(here.across, -s * miss.x + c * miss.y, 1e-12);
  EXPECT_NEAR(here.along, c * miss.x + s * miss.y, 1e-12);
  // Of the place alone, along the normal and tangent that stand now.
  constexpr double h = 1e-5;
  for (int k = 0; k < 7; ++k) {
    const auto place = [&](double by) {
      return lac::pose_at(segment_of(changed(chain, k, by), 1), 0.35).position;
    };
    const core::Vector2 d = (place(h) - place(-h)) / (2 * h);
    EXPECT_NEAR(here.by_across(k), -s * d.x + c * d.y, 1e-7) << k;
    EXPECT_NEAR(here.by_along(k), c * d.x + s * d.y, 1e-7) << k;
  }
}

// What the next joint misses by, and how that depends on the stage's variables.
TEST(Evaluation, GapsAreEndsLessJoints) {
  FitChain chain = gapped();
  const Model model = Evaluation(chain, {}, fine()).model();
  ASSERT_EQ(model.stages.size(), 2U);
  double largest = 0;
  for (int i = 0; i < 2; ++i) {
    const core::Pose2 end = lac::end_pose(segment_of(chain, i));
    const FitJoint& to = chain.joints[i + 1];
    const auto& gap = model.stages[i].gap;
    EXPECT_NEAR(gap(0), end.position.x - to.position.x, 1e-12);
    EXPECT_NEAR(gap(1), end.position.y - to.position.y, 1e-12);
    EXPECT_NEAR(gap(2), end.direction - to.direction, 1e-12);
    EXPECT_EQ(gap(3), 0);
    largest = std::max(largest, std::hypot(gap(0), gap(1), gap(2) * chain.pieces[i].length));
  }
  EXPECT_NEAR(model.max_gap, largest, 1e-12);
  const Model moved = [&] {
    FitChain other = chain;
    other.joints[0].direction += 1e-6;
    return Evaluation(other, {}, fine()).model();
  }();
  for (int r = 0; r < 3; ++r)
    EXPECT_NEAR((moved.stages[0].gap(r) - model.stages[0].gap(r)) / 1e-6,
                model.stages[0].step(r, kDirection), 1e-5);
}

TEST(Evaluation, StepsOfAStageAreThoseOfItsEnd) {
  FitChain chain = gapped();
  const Model model = Evaluation(chain, {}, fine()).model();
  constexpr double h = 1e-5;
  const auto end = [&](int k, double by) {
    FitChain other = chain;
    if (k == kCurvature) other.joints[0].curvature += by;
    if (k == kNextCurvature) other.joints[1].curvature += by;
    if (k == kLengthAt) other.pieces[0].length += by;
    if (k == kAlphaAt) other.pieces[0].alpha += by;
    return lac::end_pose(segment_of(other, 0));
  };
  for (const int k : {kCurvature, kNextCurvature, kLengthAt, kAlphaAt}) {
    const core::Pose2 up = end(k, h), down = end(k, -h);
    EXPECT_NEAR(model.stages[0].step(0, k), (up.position.x - down.position.x) / (2 * h), 1e-8);
    EXPECT_NEAR(model.stages[0].step(1, k), (up.position.y - down.position.y) / (2 * h), 1e-8);
    EXPECT_NEAR(model.stages[0].step(2, k), (up.direction - down.direction) / (2 * h), 1e-8);
  }
  EXPECT_EQ(model.stages[0].step(3, kNextCurvature), 1);
  EXPECT_EQ(model.stages[0].step(3, kCurvature), 0);
}

TEST(Evaluation, ArcsHaveOneCurvatureAndLinesNoChoice) {
  FitChain chain = gapped();
  chain.pieces[0].kind = PieceKind::arc;
  chain.joints[1].curvature = 0.5;
  const Model arc = Evaluation(chain, {}, fine()).model();
  const Stage& stage = arc.stages[0];
  EXPECT_EQ(stage.step(3, kCurvature), 1);
  for (int r = 0; r < 4; ++r) EXPECT_EQ(stage.step(r, kNextCurvature), 0);
  constexpr double h = 1e-5;
  const auto end = [&](double by) {
    lac::Segment s = segment_of(chain, 0);
    s.curvature_start += by;
    s.curvature_end += by;
    return lac::end_pose(s);
  };
  EXPECT_NEAR(stage.step(1, kCurvature), (end(h).position.y - end(-h).position.y) / (2 * h), 1e-7);
  EXPECT_TRUE(stage.fixed[1]);
  EXPECT_TRUE(stage.fixed[2]);
  EXPECT_FALSE(stage.fixed[0]);
  const Stage& curve = arc.stages[1];
  EXPECT_FALSE(curve.fixed[1]);
  EXPECT_FALSE(curve.fixed[2]);
  // Before a line the joint's curvature stays what it is.
  chain = gapped();
  chain.pieces[1].kind = PieceKind::line;
  EXPECT_TRUE(Evaluation(chain, {}, fine()).model().stages[0].fixed[2]);
  chain = gapped();
  chain.pieces[0].kind = PieceKind::line;
  EXPECT_FALSE(Evaluation(chain, {}, fine()).model().stages[1].fixed[2]);
  chain.closed = true;
  EXPECT_TRUE(Evaluation(chain, {}, fine()).model().stages[1].fixed[2]);
  chain = gapped();
  hold_slope(chain.pieces[0], -0.5);
  EXPECT_TRUE(Evaluation(chain, {}, fine()).model().stages[0].fixed[1]);
  EXPECT_FALSE(Evaluation(chain, {}, fine()).model().stages[0].fixed[2]);
}

// Cost: weights times the squares of what lies beside; a point's spread counts in the largest only.
TEST(Evaluation, CostIsTheWeightedSumOfSquares) {
  FitChain chain;
  chain.joints = {{{0, 0}, 0, 0}, {{1, 0}, 0, 0}};
  chain.pieces = {{.length = 1, .alpha = -1}};
  std::vector<FitPoint> points{{.position = {0.25, 0.1}, .weight = 3},
                               {.position = {0.75, -0.2}, .weight = 2, .share = 0.5}};
  points[0].high = 0.15;
  points[0].low = -0.3;
  chain.feet = {{0, 0.25}, {0, 0.75}};
  const Model model = Evaluation(chain, points, fine()).model();
  EXPECT_NEAR(model.cost, 3 * 0.01 + 2 * 0.25 * 0.04, 1e-14);
  EXPECT_NEAR(model.max_offset, 0.25, 1e-14);
  EXPECT_NEAR(model.merit, model.cost, 1e-14);
  points[0].low = -0.9;
  EXPECT_NEAR(Evaluation(chain, points, fine()).model().max_offset, 0.8, 1e-14);
  // A foot of a pinned point that it is not above costs along the chain too.
  chain.first_at_start = true;
  chain.feet[0] = {0, 0};
  EXPECT_NEAR(Evaluation(chain, points, fine()).model().cost, 3 * (0.01 + 0.0625) + 2 * 0.25 * 0.04,
              1e-14);
}

// The cost's slope and bend by the stage's variables are those of the sum of squares.
TEST(Evaluation, GradientIsHalfTheCostsSlope) {
  const FitChain chain = gapped();
  const std::vector<FitPoint> points{{.position = {0.6, 0.45}, .weight = 2}};
  const auto cost = [&](double by) {
    FitChain other = chain;
    other.joints[1].position.y += by;
    other.feet = {{1, 0.35}};
    return Evaluation(other, points, fine()).model();
  };
  constexpr double h = 1e-5;
  const Model here = cost(0);
  // The foot stays, so that the tangent does too.
  EXPECT_NEAR(2 * here.stages[1].gradient(kY), (cost(h).cost - cost(-h).cost) / (2 * h), 1e-8);
  EXPECT_NEAR(2 * here.stages[1].hessian(kY, kY),
              (cost(h).cost - 2 * here.cost + cost(-h).cost) / (h * h), 1e-4);
}

// Slopes are drawn to -1 and lengths to the usual one, in units of the tolerance.
TEST(Evaluation, PriorsDrawSlopesAndLengths) {
  FitChain chain = gapped();
  ChainFitOptions options = fine();
  options.scale = 0.1;
  options.slope_prior = 0.2;
  options.length_prior = 0.5;
  options.usual_length = 0.4;
  const Model model = Evaluation(chain, {}, options).model();
  const double w = 0.2 * 0.1, v = 0.5 * 0.1 / 0.4;
  EXPECT_NEAR(model.cost, w * w * (0.5 * 0.5 + 1.6 * 1.6) + v * v * (0.1 * 0.1 + 0.05 * 0.05),
              1e-14);
  EXPECT_NEAR(model.stages[1].gradient(kAlphaAt), w * w * 1.6, 1e-14);
  EXPECT_NEAR(model.stages[1].hessian(kAlphaAt, kAlphaAt), w * w, 1e-14);
  EXPECT_NEAR(model.stages[0].gradient(kLengthAt), v * v * 0.1, 1e-14);
  EXPECT_NEAR(model.stages[0].hessian(kLengthAt, kLengthAt), v * v, 1e-14);
}

// A closed chain's gap at its seam counts in units of length.
TEST(Evaluation, SeamsCountAsGaps) {
  FitChain chain;
  chain.closed = true;
  chain.turning = 2 * kPi;
  const double length = 2 * kPi;
  chain.joints = {{{1, 0}, kPi / 2, 1}, {{1.01, 0.02}, kPi / 2 + 2 * kPi + 0.001, 1.0005}};
  chain.pieces = {{.length = length, .alpha = -1}};
  const Model model = Evaluation(chain, {}, fine()).model();
  const double turn = 0.001 * length, bend = 0.0005 * length * length;
  const double seam = std::sqrt(0.01 * 0.01 + 0.02 * 0.02 + turn * turn + bend * bend);
  EXPECT_GE(model.max_gap, seam - 1e-12);
  const core::Pose2 end = lac::end_pose(segment_of(chain, 0));
  const double own = std::hypot(end.position.x - 1.01, end.position.y - 0.02,
                                (end.direction - chain.joints[1].direction) * length);
  EXPECT_NEAR(model.max_gap, std::max(seam, own), 1e-10);
}

TEST(Evaluation, FeetComeHomeOverJoints) {
  FitChain chain;
  for (int i = 0; i <= 8; ++i) {
    const double t = kPi / 4 * i;
    chain.joints.push_back({{std::cos(t), std::sin(t)}, t + kPi / 2, 1});
    if (i < 8) chain.pieces.push_back({.length = kPi / 4, .alpha = -1});
  }
  chain.closed = true;
  chain.turning = 2 * kPi;
  std::vector<FitPoint> points;
  for (const double t : {0.1, 2.0, 6.2})
    points.push_back({.position = {1.2 * std::cos(t), 1.2 * std::sin(t)}});
  chain.feet = {{7, 0.5}, {3, 0.2}, {0, 0.4}};
  Evaluation evaluation(chain, points, fine());
  for (int i = 0; i < 10; ++i) evaluation.move_feet();
  EXPECT_NEAR((chain.feet[0].piece + chain.feet[0].fraction) * kPi / 4, 0.1, 1e-9);
  EXPECT_NEAR((chain.feet[1].piece + chain.feet[1].fraction) * kPi / 4, 2.0, 1e-9);
  EXPECT_NEAR((chain.feet[2].piece + chain.feet[2].fraction) * kPi / 4, 6.2, 1e-9);
  EXPECT_NEAR(evaluation.offset(1), -0.2, 1e-9);
}

TEST(Evaluation, PinnedFeetStay) {
  FitChain chain = gapped();
  chain.first_at_start = chain.last_at_end = true;
  const std::vector<FitPoint> points(3, {.position = {0.4, 0.1}});
  chain.feet = {{0, 0}, {0, 0.1}, {1, 1}};
  Evaluation evaluation(chain, points, fine());
  evaluation.move_feet();
  EXPECT_EQ(chain.feet[0].fraction, 0);
  EXPECT_NE(chain.feet[1].fraction, 0.1);
  EXPECT_EQ(chain.feet[2].fraction, 1);
}

// Where gaps alone are closed every variable is held by what it moves the end by: a place by
// itself, a turn by the length, a curvature by a tenth of the length's square, a slope by what
// bends between the ends.
TEST(Evaluation, WhereGapsAreClosedVariablesStayByWhatTheyMove) {
  ChainFitOptions options = fine();
  options.close_gaps = true;
  FitChain chain = gapped();
  const Model model = Evaluation(chain, {}, options).model();
  const double length = 0.45, square = length * length, bend = 2.5 - 1.2;
  const double held[] = {1,           1, length, 0.1 * square, 0.3, 0.02 * bend * square + 1e-6,
                         0.1 * square};
  for (int k = 0; k < 7; ++k)
    EXPECT_NEAR(model.stages[1].hessian(k, k), held[k] * held[k], 1e-15) << k;
  EXPECT_EQ(model.stages[1].gradient.norm(), 0);
}

}  // namespace
}  // namespace keyline::fairing::detail
