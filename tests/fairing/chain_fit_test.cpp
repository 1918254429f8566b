#include "keyline/fairing/chain_fit.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/lac/chain/chain.h"

/// Least squares over a chain: what comes back, what is held, what is told.
namespace keyline::fairing {
namespace {

constexpr double kPi = std::numbers::pi;

FitChain from(const lac::Chain& chain) {
  FitChain out;
  const auto poses = lac::joints(chain);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool last = i + 1 == poses.size();
    const lac::Piece& p = chain.pieces[last ? i - 1 : i];
    out.joints.push_back(
        {poses[i].position, poses[i].direction, last ? p.curvature_end : p.curvature_start});
  }
  for (const lac::Piece& p : chain.pieces)
    out.pieces.push_back({.length = p.length, .alpha = p.alpha});
  return out;
}

const lac::Chain kTruth{{{0, 0}, 0.1}, {{-0.7, 0.5, 0.5, 2}, {0.8, 0.5, 2, 4}}, false};
// Slopes that meet in an inflection.
const lac::Chain kInflected{{{0, 0}, 0.1}, {{-1.4, 0.4, -3, 0}, {-0.35, 0.6, 0, 4}}, false};

/// Points of the truth with feet where they stand.
struct Given {
  FitChain chain;
  std::vector<FitPoint> points;
};
Given given(int per_piece = 12, const lac::Chain& truth = kTruth) {
  Given g{from(truth), {}};
  const auto segments = lac::segments(truth);
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k <= per_piece; ++k) {
      if (i == 1 && k == 0) continue;
      const double t = double(k) / per_piece;
      g.points.push_back({.position = lac::evaluate(segments[i], t)});
      g.chain.feet.push_back({i, t});
    }
  g.chain.first_at_start = g.chain.last_at_end = true;
  return g;
}

ChainFitOptions fine() {
  ChainFitOptions options;
  options.fine = true;
  options.iterations = 200;
  options.slope_prior = 0;
  options.gradient_tolerance = 1e-9;
  return options;
}

TEST(FitChain, ComesBackToWhatThePointsWereTakenFrom) {
  Given g = given();
  g.chain.joints[1].position.x += 0.01;
  g.chain.joints[1].direction += 0.03;
  g.chain.joints[1].curvature *= 1.2;
  g.chain.pieces[0].alpha = -0.9;
  g.chain.pieces[1].length *= 1.05;
  const ChainFitReport report = fit_chain(g.chain, g.points, fine());
  EXPECT_TRUE(report.converged);
  EXPECT_GT(report.iterations, 1);
  EXPECT_LT(report.max_offset, 1e-8);
  EXPECT_LT(report.max_gap, 1e-8);
  EXPECT_NEAR(g.chain.pieces[0].alpha, -0.7, 1e-3);
  EXPECT_NEAR(g.chain.pieces[1].alpha, 0.8, 1e-3);
  EXPECT_NEAR(g.chain.pieces[1].length, 0.5, 1e-5);
  EXPECT_NEAR(g.chain.joints[1].curvature, 2, 1e-3);
}

// A slope of -0.35 lets the joint's curvature c change the chain as c^0.35 does: without bound
// towards zero, where the joint belongs.
TEST(FitChain, ComesBackToAJointThatIsAnInflection) {
  for (const double start : {0.02, -0.02}) {
    Given g = given(30, kInflected);
    g.chain.joints[1].curvature = start;
    g.chain.joints[1].position.x += 0.005;
    for (FitPiece& piece : g.chain.pieces) piece.alpha *= 1.1;
    const ChainFitReport report = fit_chain(g.chain, g.points, fine());
    EXPECT_TRUE(report.converged);
    EXPECT_LT(report.max_offset, 1e-10);
    EXPECT_NEAR(g.chain.joints[1].curvature, 0, 1e-20);
    EXPECT_NEAR(g.chain.pieces[0].alpha, -1.4, 1e-7);
    EXPECT_NEAR(g.chain.pieces[1].alpha, -0.35, 1e-7);
  }
}

TEST(FitChain, HeldEndsStayToTheBit) {
  for (const Hold hold : {Hold::position, Hold::direction, Hold::curvature}) {
    Given g = given();
    g.chain.hold_start = g.chain.hold_end = hold;
    g.chain.first_at_start = g.chain.last_at_end = false;
    FitJoint& first = g.chain.joints.front();
    FitJoint& last = g.chain.joints.back();
    first = {{0.003, -0.004}, 0.12, 0.6};
    last.position.x += 0.004;
    last.direction += 0.02;
    last.curvature += 0.3;
    const FitJoint start = first, end = last;
    ChainFitOptions options = fine();
    options.iterations = 30;
    fit_chain(g.chain, g.points, options);
    const FitJoint& now = g.chain.joints.front();
    const FitJoint& then = g.chain.joints.back();
    EXPECT_EQ(now.position, start.position);
    EXPECT_EQ(then.position, end.position);
    EXPECT_EQ(now.direction == start.direction, hold >= Hold::direction);
    EXPECT_EQ(then.direction == end.direction, hold >= Hold::direction);
    EXPECT_EQ(now.curvature == start.curvature, hold >= Hold::curvature);
    EXPECT_EQ(then.curvature == end.curvature, hold >= Hold::curvature);
  }
}

TEST(FitChain, SlopesStayWithinTheirRange) {
  Given g = given();
  g.chain.pieces[0].alpha = g.chain.pieces[1].alpha = -1;
  hold_slope(g.chain.pieces[0], -1);
  g.chain.pieces[1].alpha_high = 0.3;
  fit_chain(g.chain, g.points, fine());
  EXPECT_EQ(g.chain.pieces[0].alpha, -1);
  EXPECT_EQ(g.chain.pieces[1].alpha, 0.3);
}

// No step: the report is of the chain as it stands.
TEST(FitChain, ReportsTheChainThatItIsGiven) {
  FitChain chain;
  chain.joints = {{{0, 0}, 0, 0}, {{1, 0.003}, 0, 0}};
  chain.pieces = {{.length = 1, .alpha = -1, .kind = PieceKind::line}};
  chain.feet = {{0, 0.3}, {0, 0.6}};
  const std::vector<FitPoint> points{{.position = {0.3, 0.01}, .weight = 2},
                                     {.position = {0.6, -0.02}}};
  ChainFitOptions options;
  options.iterations = 0;
  const ChainFitReport report = fit_chain(chain, points, options);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_FALSE(report.converged);
  EXPECT_NEAR(report.cost, 2e-4 + 4e-4, 1e-12);
  EXPECT_NEAR(report.max_offset, 0.02, 1e-12);
  EXPECT_NEAR(report.max_gap, 0.003, 1e-12);
}

TEST(FitChain, GapsCloseToRounding) {
  Given g = given();
  g.chain.joints[1].position.y += 1e-4;
  g.chain.joints[2].direction += 1e-4;
  ChainFitOptions options = fine();
  options.close_gaps = true;
  const FitChain before = g.chain;
  const ChainFitReport report = fit_chain(g.chain, g.points, options);
  EXPECT_LT(report.max_gap, 1e-13);
  EXPECT_LT(core::distance(g.chain.joints[2].position, before.joints[2].position), 1e-3);
  EXPECT_EQ(g.chain.pieces[0].alpha, before.pieces[0].alpha);
}

// A circle in four pieces: a closed chain comes back to its start, a turn further.
TEST(FitChain, ClosedChainsMeet) {
  FitChain chain;
  const double r = 0.5 / kPi;
  for (int i = 0; i <= 4; ++i) {
    const double t = kPi / 2 * i;
    chain.joints.push_back(
        {{1.02 * r * std::cos(t), r * std::sin(t)}, t + kPi / 2, (1 + 0.05 * (i % 2)) / r});
    if (i < 4) chain.pieces.push_back({.length = 0.25, .alpha = -1});
  }
  chain.closed = true;
  chain.turning = 2 * kPi;
  std::vector<FitPoint> points;
  for (int k = 0; k < 40; ++k) {
    const double t = 2 * kPi * k / 40;
    points.push_back({.position = {r * std::cos(t), r * std::sin(t)}});
    chain.feet.push_back({k / 10, (k % 10) / 10.0});
  }
  const ChainFitReport report = fit_chain(chain, points, fine());
  EXPECT_LT(report.max_offset, 1e-7);
  const FitJoint& first = chain.joints.front();
  const FitJoint& last = chain.joints.back();
  EXPECT_LT(core::distance(first.position, last.position), 1e-7);
  EXPECT_NEAR(last.direction - first.direction, 2 * kPi, 1e-6);
  EXPECT_NEAR(last.curvature, first.curvature, 1e-5);
}

TEST(Offsets, AreOfFeetAsTheyStandOrBroughtHome) {
  FitChain chain;
  chain.joints = {{{0, 0}, 0, 0}, {{1, 0}, 0, 0}};
  chain.pieces = {{.length = 1, .alpha = -1, .kind = PieceKind::line}};
  chain.feet = {{0, 0}, {0, 0.5}};
  const std::vector<FitPoint> points{{.position = {0.3, 0.4}}, {.position = {0.6, -0.1}}};
  const auto standing = offsets(chain, points);
  EXPECT_NEAR(standing[0], 0.5, 1e-12);  // from the end, where its foot is
  EXPECT_NEAR(standing[1], -0.1, 1e-12);
  EXPECT_EQ(chain.feet[0].fraction, 0);
  const auto settled = settle_feet(chain, points, 3);
  EXPECT_NEAR(settled[0], 0.4, 1e-12);
  EXPECT_NEAR(chain.feet[0].fraction, 0.3, 1e-12);
  EXPECT_NEAR(chain.feet[1].fraction, 0.6, 1e-12);
}

}  // namespace
}  // namespace keyline::fairing
