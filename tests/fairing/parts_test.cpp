#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "keyline/fairing/chain_edit.h"
#include "keyline/fairing/chain_search.h"
#include "keyline/fairing/condense.h"
#include "keyline/fairing/guides.h"
#include "keyline/fairing/meet.h"
#include "keyline/fairing/riccati.h"
#include "keyline/fairing/settle.h"
#include "keyline/lac/segment/segment.h"
#include "keyline/lac/segment/sensitivity.h"
#include "keyline/numeric/random.h"

/// The parts that the chain fit is made of, each against something plain.
namespace keyline::fairing::detail {
namespace {

Stage random_stage(numeric::Random& random) {
  Stage stage;
  Matrix7 root;
  for (double& x : root.reshaped()) x = random.normal();
  stage.hessian = root * root.transpose() + 0.1 * Matrix7::Identity();
  for (double& x : stage.gradient) x = random.normal();
  for (double& x : stage.step.reshaped()) x = random.normal();
  for (double& x : stage.gap) x = random.normal();
  return stage;
}

/// Multipliers and unknowns in one dense system: states 0 … n, then controls.
Eigen::VectorXd dense_solution(const std::vector<Stage>& stages, const Matrix4& end_hessian,
                               const Vector4& end_gradient) {
  const int n = static_cast<int>(stages.size());
  const int states = 4 * (n + 1);
  const int unknowns = states + 3 * n;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(unknowns + 4 * n, unknowns + 4 * n);
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(k.rows());
  for (int i = 0; i < n; ++i) {
    const auto at = [&](int v) { return v < 4 ? 4 * i + v : states + 3 * i + v - 4; };
    for (int r = 0; r < 7; ++r) {
      rhs(at(r)) -= stages[i].gradient(r);
      for (int c = 0; c < 7; ++c) k(at(r), at(c)) += stages[i].hessian(r, c);
    }
    for (int r = 0; r < 4; ++r) {
      const int row = unknowns + 4 * i + r;
      rhs(row) = -stages[i].gap(r);
      for (int c = 0; c < 7; ++c) k(row, at(c)) = k(at(c), row) = stages[i].step(r, c);
      k(row, 4 * (i + 1) + r) = k(4 * (i + 1) + r, row) = -1;
    }
  }
  k.block<4, 4>(4 * n, 4 * n) += end_hessian;
  rhs.segment<4>(4 * n) -= end_gradient;
  return k.fullPivLu().solve(rhs);
}

TEST(Riccati, AgreesWithTheDenseSystem) {
  numeric::Random random(5);
  std::vector<Stage> stages;
  for (int i = 0; i < 6; ++i) stages.push_back(random_stage(random));
  Boundary boundary;
  boundary.end_hessian = 3 * Matrix4::Identity();
  boundary.end_gradient = Vector4(1, -2, 0.5, 4);
  const Step step = solve_stages(stages, boundary);
  ASSERT_TRUE(step.sound);
  const Eigen::VectorXd dense = dense_solution(stages, boundary.end_hessian, boundary.end_gradient);
  for (int i = 0; i <= 6; ++i)
    EXPECT_LE((step.state[i] - dense.segment<4>(4 * i)).norm(), 1e-8 * dense.norm());
  for (int i = 0; i < 6; ++i)
    EXPECT_LE((step.control[i] - dense.segment<3>(28 + 3 * i)).norm(), 1e-8 * dense.norm());
}

TEST(Riccati, ClosedChainsMeetAndHeldControlsStay) {
  numeric::Random random(6);
  std::vector<Stage> stages;
  for (int i = 0; i < 5; ++i) stages.push_back(random_stage(random));
  stages[2].fixed[1] = true;
  Boundary boundary;
  boundary.closed = true;
  boundary.end_hessian = 1e9 * Matrix4::Identity();
  const Step step = solve_stages(stages, boundary);
  ASSERT_TRUE(step.sound);
  EXPECT_LE((step.state.back() - step.state.front()).norm(), 1e-6);
  EXPECT_EQ(step.control[2](1), 0);
}

/// The same with what is held added as equations: controls that are fixed, a fixed start, and the
/// end tied to the start where the chain is closed.
Eigen::VectorXd held_solution(const std::vector<Stage>& stages, const Boundary& boundary) {
  const int n = static_cast<int>(stages.size());
  const int states = 4 * (n + 1), unknowns = states + 3 * n;
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> right;
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(unknowns);
  const auto equation = [&](double value) -> Eigen::VectorXd& {
    right.push_back(value);
    return rows.emplace_back(Eigen::VectorXd::Zero(unknowns));
  };
  for (int i = 0; i < n; ++i) {
    const Stage& stage = stages[static_cast<std::size_t>(i)];
    const auto at = [&](int v) { return v < 4 ? 4 * i + v : states + 3 * i + v - 4; };
    for (int r = 0; r < 7; ++r) {
      g(at(r)) += stage.gradient(r);
      for (int c = 0; c < 7; ++c) h(at(r), at(c)) += stage.hessian(r, c);
    }
    for (int r = 0; r < 4; ++r) {
      auto& row = equation(-stage.gap(r));
      for (int c = 0; c < 7; ++c) row(at(c)) = stage.step(r, c);
      row(4 * (i + 1) + r) = -1;
    }
    for (int k = 0; k < 3; ++k)
      if (stage.fixed[k]) equation(0)(at(4 + k)) = 1;
  }
  for (int k = 0; k < 4; ++k)
    if (boundary.fixed_start[k]) equation(0)(k) = 1;
  h.block<4, 4>(4 * n, 4 * n) += boundary.end_hessian;
  g.segment<4>(4 * n) += boundary.end_gradient;
  if (boundary.closed) {
    h.block<4, 4>(0, 0) += boundary.end_hessian;
    h.block<4, 4>(0, 4 * n) -= boundary.end_hessian;
    h.block<4, 4>(4 * n, 0) -= boundary.end_hessian;
    g.segment<4>(0) -= boundary.end_gradient;
  }
  const int m = static_cast<int>(rows.size());
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(unknowns + m, unknowns + m);
  Eigen::VectorXd rhs(unknowns + m);
  k.topLeftCorner(unknowns, unknowns) = h;
  rhs.head(unknowns) = -g;
  for (int r = 0; r < m; ++r) {
    k.row(unknowns + r).head(unknowns) = rows[static_cast<std::size_t>(r)].transpose();
    k.col(unknowns + r).head(unknowns) = rows[static_cast<std::size_t>(r)];
    rhs(unknowns + r) = right[static_cast<std::size_t>(r)];
  }
  return k.fullPivLu().solve(rhs);
}

TEST(Riccati, AgreesWithTheDenseSystemWhereThingsAreHeld) {
  numeric::Random random(9);
  for (const bool closed : {false, true}) {
    std::vector<Stage> stages;
    for (int i = 0; i < 5; ++i) stages.push_back(random_stage(random));
    stages[1].fixed[1] = stages[3].fixed[0] = stages[3].fixed[2] = true;
    Boundary boundary;
    boundary.closed = closed;
    boundary.end_hessian.diagonal() << 40, 30, 20, 5;
    boundary.end_gradient << 1, -2, 0.5, 4;
    boundary.fixed_start[1] = boundary.fixed_start[3] = true;
    const Step step = solve_stages(stages, boundary);
    ASSERT_TRUE(step.sound);
    const Eigen::VectorXd dense = held_solution(stages, boundary);
    const double size = dense.head(24 + 15).norm();
    for (int i = 0; i <= 5; ++i)
      EXPECT_LE((step.state[i] - dense.segment<4>(4 * i)).norm(), 1e-7 * size) << closed << i;
    for (int i = 0; i < 5; ++i)
      EXPECT_LE((step.control[i] - dense.segment<3>(24 + 3 * i)).norm(), 1e-7 * size) << closed;
  }
}

TEST(Riccati, WhatHasNoMinimumIsNotSound) {
  numeric::Random random(9);
  std::vector<Stage> stages;
  for (int i = 0; i < 3; ++i) stages.push_back(random_stage(random));
  EXPECT_TRUE(solve_stages(stages, {}).sound);
  stages[1].hessian = -1e9 * Matrix7::Identity();
  EXPECT_FALSE(solve_stages(stages, {}).sound);
  stages[1].hessian = Matrix7::Identity();
  stages[0].hessian.topLeftCorner<4, 4>() = -1e6 * Matrix4::Identity();  // of the start
  EXPECT_FALSE(solve_stages(stages, {}).sound);
}

TEST(PieceTable, AgreesWithSegmentsAndDifferences) {
  struct Case {
    double k0, k1, length, alpha;
  };
  for (const Case& c : {Case{1, 3, 0.8, 0.7}, Case{2, -1.5, 1, -0.6}, Case{0.5, 2, 1, -2},
                        Case{3, 0.4, 0.7, 0}, Case{1, 1, 1, -1}}) {
    lac::PieceTable table;
    table.build(c.k0, c.k1, c.length, c.alpha, true);
    const lac::Piece piece{c.alpha, c.length, c.k0, c.k1};
    for (const double v : {0.0, 0.3, 0.77, 1.0}) {
      const auto value = table.at(v);
      const core::Vector2 exact = lac::displacement(piece, v);
      EXPECT_NEAR(value.x, exact.x, 1e-10);
      EXPECT_NEAR(value.y, exact.y, 1e-10);
      EXPECT_NEAR(value.angle, lac::turning(piece, v), 1e-10);
    }
    const double h = 1e-6;
    lac::PieceTable up;
    lac::PieceTable down;
    up.build(c.k0, c.k1, c.length, c.alpha + h, true);
    down.build(c.k0, c.k1, c.length, c.alpha - h, true);
    EXPECT_NEAR(table.end().dy[lac::kAlpha], (up.end().y - down.end().y) / (2 * h), 1e-6);
    if (c.k0 == c.k1) continue;  // beside equal curvatures tables are built otherwise
    up.build(c.k0 + h, c.k1, c.length, c.alpha, true);
    down.build(c.k0 - h, c.k1, c.length, c.alpha, true);
    EXPECT_NEAR(table.end().dy[lac::kCurvatureStart], (up.end().y - down.end().y) / (2 * h), 1e-6);
  }
}

TEST(Condense, KeepsEndsCountsAndWeights) {
  std::vector<core::Point2> points;
  for (int i = 0; i < 1000; ++i) points.push_back({0.001 * i, i % 2 == 0 ? 1e-3 : -1e-3});
  const auto fit = condense(points, {}, 100);
  ASSERT_EQ(fit.size(), 100U);
  double count = 0;
  for (const FitPoint& p : fit) count += p.count;
  EXPECT_EQ(count, 1000);
  EXPECT_EQ(fit.front().position, points.front());
  EXPECT_EQ(fit.back().position, points.back());
  EXPECT_NEAR(fit[50].high, 1e-3, 2e-4);
  std::vector<double> seen(100, 0);
  for (std::size_t j = 0; j < 1000; ++j) ++seen[condensed_index(j, 1000, 100)];
  for (std::size_t b = 0; b < 100; ++b) EXPECT_EQ(seen[b], fit[b].count);
}

// A mean of weighted points is sum(w p) / sum(w): by hand, runs of two between the ends.
TEST(Condense, HeavyPointsDrawTheMean) {
  const std::vector<core::Point2> points{{0, 0}, {1, 0}, {2, 4}, {3, 0}, {4, 8}, {5, 0}};
  const std::vector<double> weights{1, 3, 1, 1, 7, 2};
  const auto fit = condense(points, weights, 4);
  ASSERT_EQ(fit.size(), 4U);
  EXPECT_NEAR(fit[1].position.x, (3 * 1 + 1 * 2) / 4.0, 1e-15);
  EXPECT_NEAR(fit[1].position.y, 1, 1e-15);
  EXPECT_NEAR(fit[2].position.x, (1 * 3 + 7 * 4) / 8.0, 1e-15);
  EXPECT_NEAR(fit[2].position.y, 7, 1e-15);
  EXPECT_EQ(fit[1].weight, 4);
  EXPECT_EQ(fit[2].weight, 8);
  EXPECT_EQ(fit[3].weight, 2);
}

/// Steps of a single point's width: too narrow for a few equal pieces, not for one a point.
TEST(ChainSearch, StartsFromTheSplineThroughThePointsWhereNothingElseServes) {
  std::vector<FitPoint> points;
  for (int i = 0; i <= 60; ++i) {
    const double step = i >= 20 && i < 24 ? 0.01 : 0;
    points.push_back({.position = {i / 60.0, step + 0.02 * std::sin(i / 10.0)}});
  }
  ChainSearchOptions options;
  options.accept.tolerance = 1e-3;
  options.start_pieces = options.most_pieces = 12;
  options.spline_start = false;
  EXPECT_FALSE(search_chain(points, false, options).within_tolerance);
  options.spline_start = true;
  const ChainSearchResult found = search_chain(points, false, options);
  EXPECT_TRUE(found.within_tolerance);
  EXPECT_EQ(found.start_pieces, 60);
  EXPECT_LT(found.chain.pieces.size(), 20U);
}

TEST(Guides, StandOnlyInWideGaps) {
  std::vector<FitPoint> points;
  for (const double x : {0.0, 0.001, 0.002, 0.4, 0.401}) points.push_back({.position = {x, 0}});
  const auto guided = with_guides(points, false, 5e-4);
  ASSERT_EQ(guided.size(), 7U);
  EXPECT_EQ(guided[3].count, 0);
  EXPECT_LT(guided[3].share, 0.1);
  EXPECT_NEAR(guided[3].position.y, 0, 1e-12);
}

FitChain two_clothoids() {
  FitChain chain;
  chain.joints = {{{0, 0}, 0, 0}, {{0.5, 0.02}, 0.25, 1}, {{0.9, 0.2}, 0.75, 2}};
  chain.pieces = {{.length = 0.5}, {.length = 0.5}};
  chain.feet = {{0, 0.0}, {0, 0.5}, {1, 0.5}, {1, 1.0}};
  return chain;
}

TEST(ChainEdit, MergedPieceHasBothLengthsAndTheTurning) {
  const FitChain merged = without_joint(two_clothoids(), 1);
  ASSERT_EQ(merged.pieces.size(), 1U);
  EXPECT_DOUBLE_EQ(merged.pieces[0].length, 1);
  EXPECT_DOUBLE_EQ(merged.feet[1].fraction, 0.25);
  EXPECT_DOUBLE_EQ(merged.feet[2].fraction, 0.75);
}

// Where no slope between the end curvatures turns as far, a clothoid between higher or lower ones
// does: by its length times the mean of both.
TEST(ChainEdit, MergedPiecesOfABumpTurnAsFarAsBoth) {
  FitChain chain = two_clothoids();
  chain.joints[1].curvature = 4;
  chain.joints[2].direction = 2.1;
  const FitChain merged = without_joint(chain, 1);
  const double a = merged.joints.front().curvature;
  const double b = merged.joints.back().curvature;
  EXPECT_EQ(merged.pieces[0].alpha, -1);
  EXPECT_NEAR(merged.pieces[0].length * (a + b) / 2, 2.1, 1e-12);
}

TEST(ChainEdit, HeldCurvaturesStayWhenPiecesMerge) {
  FitChain chain = two_clothoids();
  chain.joints[2].direction = 3;  // more than any piece between these curvatures turns
  chain.hold_start = Hold::curvature;
  const FitChain merged = without_joint(chain, 1);
  EXPECT_EQ(merged.joints.front().curvature, 0);
  EXPECT_NE(merged.joints.back().curvature, 2);
}

TEST(ChainEdit, WindowsComeBackWhereTheyWereCut) {
  const FitChain chain = two_clothoids();
  const std::vector<FitPoint> points(4);
  const Window w = cut_window(chain, points, 1, 1);
  EXPECT_EQ(w.points.size(), 2U);
  EXPECT_EQ(w.chain.hold_start, Hold::curvature);
  EXPECT_EQ(w.chain.hold_end, Hold::free);
  const FitChain back = paste_window(chain, w, 1);
  ASSERT_EQ(back.pieces.size(), 2U);
  EXPECT_EQ(back.feet[3].piece, 1);
  EXPECT_EQ(back.joints[1].position, chain.joints[1].position);
}

// A solve leaves the two ends of an arc what rounding makes of one curvature; who reads the chain
// asks whether they are one.
TEST(LayOut, ArcsAndLinesAreThatToTheLastDigit) {
  FitChain chain;
  chain.joints = {{{0, 0}, 0, 1},     {{0, 0}, 0, 0.5}, {{0, 0}, 0, 0.5 * (1 + 4e-14)},
                  {{0, 0}, 0, 1e-15}, {{0, 0}, 0, 0},   {{0, 0}, 0, 2}};
  chain.pieces.assign(5, {.length = 0.2, .alpha = -1});
  chain.pieces[1].kind = PieceKind::arc;
  chain.pieces[3].kind = PieceKind::line;
  const lac::Chain laid = lay_out(chain, {1, 0, {}}, false);
  EXPECT_EQ(laid.pieces[1].curvature_start, laid.pieces[1].curvature_end);
  EXPECT_NEAR(laid.pieces[1].curvature_start, 0.5, 1e-13);
  EXPECT_EQ(laid.pieces[3].curvature_start, 0);
  EXPECT_EQ(laid.pieces[3].curvature_end, 0);
  for (std::size_t i = 0; i + 1 < laid.pieces.size(); ++i)
    EXPECT_EQ(laid.pieces[i].curvature_end, laid.pieces[i + 1].curvature_start) << i;
}

TEST(MeetTarget, EndComesToThePlace) {
  lac::Chain chain{{{0, 0}, 0}, {{-1, 1, 0.5, 1}, {0.5, 1, 1, 3}, {-2, 1, 3, 0.5}}, false};
  core::Pose2 wanted = lac::end_pose(chain);
  wanted.position.x += 1e-4;
  wanted.direction -= 1e-4;
  EXPECT_LE(meet_target(chain, {.pose = wanted, .direction = true}), 1e-14);
  EXPECT_LE(core::distance(lac::end_pose(chain).position, wanted.position), 1e-14);
  EXPECT_EQ(chain.pieces.front().curvature_start, 0.5);
  EXPECT_EQ(chain.pieces.back().curvature_end, 0.5);
  EXPECT_EQ(chain.pieces[0].curvature_end, chain.pieces[1].curvature_start);
}

}  // namespace
}  // namespace keyline::fairing::detail
